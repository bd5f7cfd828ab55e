#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Programs that must not compile, and what the compiler must say of each.

    test/compile_fail.py FILE HEADER COMPILER [FLAG...]        # one file of test/compile_fail
    test/compile_fail.py --precompile HEADER COMPILER [FLAG...]
    test/compile_fail.py --complete                            # does every static_assert have a file?

HEADER is a file outside the sources, which --precompile writes: it includes program.hpp, and compilers read it in a tenth
of the time. Without it, and for files that do not begin with program.hpp, everything is read as usual.

A comment `// error: REGEX` of a file, of one line or more, says what the compiler's first error says; `// errors: N`
says how many there are at most, 1 if there is no such line; `// by every schedule: TEXT`, that for each schedule an error
has the text, with the schedule's type in place of SCHEDULE. With -DRIGHT, the file compiles: the fault is the one that it shows, and no other.
"""
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent

# Of constants in the library alone: no program makes these fail.
CONSTANT = {"a count must hold the requests of a warp", "the counts of all warps must fit in a byte"}


def errors_of(command):
    """The lines with errors that a compiler prints, of one that has failed."""
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if result.returncode == 0:
        return []
    found = [line for line in result.stdout.splitlines() if re.search(r"[):] (fatal )?error( #\d+-D)?: ", line)]
    return found or ["no error, but exit code %d: %s" % (result.returncode, result.stdout[-300:])]


def expected_of(text):
    """The expression for the first error that the comment of a file has."""
    lines = re.search(r"^// error: (.+(?:\n// (?!errors: ).+)*)$", text, re.MULTILINE).group(1)
    return lines.replace("\n// ", " ")


def schedules():
    """The types of all schedules, as compilers print them: from the library's own list."""
    text = (HERE.parent / "include/deferred_shade/schedule.hpp").read_text()
    found = re.findall(r'^  f\("[^"]+", ([^;]*)\{\}\);$', text, re.MULTILINE)
    return [plain(re.sub(r"\b(?=[a-z])", "deferred_shade::", name)) for name in found]


def plain(text):
    """Names as every compiler prints them: without spaces, and without a :: in front."""
    return re.sub(r"(?<![\w>])::", "", re.sub(r"\s", "", text))


def precompile(header, command):
    """Writes a header that includes program.hpp, and what the compiler makes of it beside it."""
    header.write_text('#include "%s"\n' % (HERE / "compile_fail/program.hpp"))
    command = [word for word in command if word != "-fsyntax-only"]
    return subprocess.run([*command, "-x", "c++-header", header, "-o", f"{header}.gch"], check=False).returncode


def check(file, header, command):
    text = Path(file).read_text()
    first = re.search(r"^#include (.*)$", text, re.MULTILINE)
    if header.is_file() and first and first[1] == '"program.hpp"':
        command = [*command, "-include", str(header)]
    expected = expected_of(text)
    most = int((re.search(r"^// errors: (\d+)$", text, re.MULTILINE) or [0, 1])[1])
    wrong = errors_of(command + [file])
    if not wrong:
        return "it compiles"
    if not re.search(expected, wrong[0]):
        return "the first error is\n  %s\nand not\n  %s" % (wrong[0], expected)
    if len(wrong) > most:
        return "%d errors, at most %d expected:\n  %s" % (len(wrong), most, "\n  ".join(wrong))
    by_every_schedule = re.search(r"^// by every schedule: (.+)$", text, re.MULTILINE)
    for schedule in schedules() if by_every_schedule else []:
        what = by_every_schedule[1].replace("SCHEDULE", schedule)
        if not any(plain(what) in plain(line) for line in wrong):
            return "no error says %s" % what
    right = errors_of(command + ["-DRIGHT", file])
    if right:
        return "with -DRIGHT, it does not compile:\n  " + right[0]
    return ""


def without_file():
    """The messages of static_asserts and #errors of the library that no file expects."""
    expected = [expected_of(f.read_text())
                for f in sorted((HERE / "compile_fail").iterdir()) if f.suffix in (".cpp", ".cu")]
    missing = []
    for header in sorted((HERE.parent / "include").rglob("*.hpp")):
        text = header.read_text()
        messages = re.findall(r"^#error[ \\\n]*\"(.*)\"$", text, re.MULTILINE)
        for assertion in re.finditer(r"\bstatic_assert\s*\((.*?\"\s*)\);", text, re.DOTALL):
            parts = re.search(r',\s*((?:"[^"]*"\s*)+)$', assertion.group(1))
            messages.append("".join(re.findall(r'"([^"]*)"', parts.group(1))) if parts else "(none)")
        for message in messages:
            if not message.startswith("deferred_shade: "):
                missing.append("%s: does not begin with 'deferred_shade: ': %s" % (header.name, message))
            elif message.removeprefix("deferred_shade: ") not in CONSTANT and not any(
                    re.search(e, message) for e in expected):
                missing.append("%s: %s" % (header.name, message))
    return missing


def main():
    if sys.argv[1] == "--complete":
        missing = without_file()
        print("\n".join(missing) or "every static_assert has a file")
        return 1 if missing else 0
    if sys.argv[1] == "--precompile":
        return precompile(Path(sys.argv[2]), sys.argv[3:])
    fault = check(sys.argv[1], Path(sys.argv[2]), sys.argv[3:])
    print(fault or "refused as it should be")
    return 1 if fault else 0


if __name__ == "__main__":
    sys.exit(main())
