#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether the functions of math.hpp become vectors in record shaders, and whether scripts/vectors names the shaders
that do and says of the others why not: by g++ and by clang++, as far as they are there.

    test/vectors.py INCLUDE...     the folders of Thrust and of libcu++
"""
import pathlib
import platform
import re
import json
import shutil
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent

FUNCTIONS = ("exp_of", "log_of", "pow_of", "sin_of", "cos_of")
ARGUMENTS = ("any", "positive", "small", "bounded")
YES = r"vectors of \d+ (floats|requests)"
EXPECTED = {
    "math.cpp": {**{f"{f}<{x}>": YES for f in FUNCTIONS for x in ARGUMENTS}, "glossy": YES, "attenuated": YES},
    "some.cpp": {
        "materials::matte": YES,
        "materials::fog": "no, calls expf",
        "materials::glass": "no, calls of_another_file",
        "materials::metal": "no, calls materials::rough<float>",
        "materials::lacquer<3>": YES,
        "materials::marching": "no, (control flow in loop|has a loop of its own.*)",
        r"shade_all(": YES,
    },
}


def tool(*words):
    """Whether the script succeeds, and its lines as a dictionary, or all that it says."""
    done = subprocess.run([sys.executable, str(root / "scripts/vectors"), *words], capture_output=True, text=True,
                          check=False)
    if done.returncode:
        return False, done.stderr
    lines = [line.rpartition(": vectors") if ": vectors" in line else line.partition(": no")
             for line in done.stdout.splitlines()]
    return True, {("shade_all(" if name.startswith("shade_all(") else name): sign[2:] + rest
                  for name, sign, rest in lines}


def differences(source, found):
    """What the script should have said of a source."""
    expected = EXPECTED[source]
    for name in sorted({*expected, *found}):
        if not re.fullmatch(expected.get(name, "nothing"), found.get(name, "nothing")):
            yield f"{source}, {name}: expected {expected.get(name, 'nothing')}, and it says {found.get(name, 'nothing')}"


def main():
    flags = ["-std=c++17", "-O3", "-fno-math-errno", "-fno-trapping-math", f"-I{root / 'include'}",
             *(word for folder in sys.argv[1:] for word in ("-isystem", folder))]
    if platform.machine() in ("x86_64", "AMD64"):
        flags.append("-march=x86-64-v3")
    failed, tried = [], []
    for compiler, own in (("g++", []), ("clang++", ["-mllvm", "-inline-threshold=5000"])):
        if not shutil.which(compiler):
            print(f"NOT TRIED: there is no {compiler}")
            continue
        tried.append(compiler)
        for source in EXPECTED:
            command = [compiler, *flags, *own, "-c", str(root / "test/vectors" / source), "-o", "nowhere/at/all.o"]
            passed, said = tool("--", *command)
            if not passed:
                failed.append(f"{compiler}, {source}: {said}")
                continue
            failed += [f"{compiler}: {what}" for what in differences(source, said)]
        # The same by a database, and what is said of mistakes.
        with tempfile.TemporaryDirectory() as folder:
            entry = {"directory": folder, "file": command[-3], "command": "ccache " + " ".join(command)}
            pathlib.Path(folder, "compile_commands.json").write_text(json.dumps([entry]), encoding="utf-8")
            passed, said = tool("-p", folder, command[-3])
            failed += [f"{compiler}, by a database: {what}" for what in
                       (differences(source, said) if passed else [said])]
            passed, said = tool("-p", folder, "other.cpp")
            if passed or "has no command for other.cpp" not in said:
                failed.append(f"of a source that the database lacks: {said}")
        passed, said = tool("--", compiler, *flags, "-c", str(root / "test/main.cpp"), "-fsyntax-error")
        if passed or "the command failed" not in said:
            failed.append(f"of a command that fails: {said}")
    if failed:
        sys.exit("\n".join(failed))
    if not tried:
        sys.exit(77)
    print(f"{sum(map(len, EXPECTED.values()))} shaders, by {' and '.join(tried)}")


if __name__ == "__main__":
    main()
