# SPDX-License-Identifier: Apache-2.0
"""Checks that each code block of the README and docs/ that names an example is that example, line
by line, or, if it also names the text that a line begins with, the part from that line to its closing brace. Each block
that names two files and a limit is their diff, with fewer lines added
and removed than that. `readme.py --write` puts the examples and diffs in. The README keeps to 110 lines, and the glossary
has every term that it and the pictures' page define in bold."""
import difflib
import pathlib
import re
import sys
import textwrap

root = pathlib.Path(__file__).resolve().parent.parent
example_pattern = re.compile(r"(<!-- example: (\S+?)(?:, from '([^'\n]+)')? -->\n```cpp\n)(.*?)(```\n)",
                             re.DOTALL)
diff_pattern = re.compile(
    r"(<!-- diff: (\S+) (\S+), fewer than (\d+) lines -->\n```diff\n)(.*?)(```\n)", re.DOTALL)
wrong_length = []


def part(source, begin):
    """The lines from the one that begins with a text to the first closing brace that is indented as it is."""
    found = re.findall(rf"^( *)({re.escape(begin)}.*?^)\1(}}[^\n]*\n)", source, re.DOTALL | re.MULTILINE)
    if len(found) != 1:
        sys.exit(f"{len(found)} parts of an example begin with '{begin}'")
    return textwrap.dedent("".join(found[0][i] for i in (0, 1, 0, 2)))


def example(match):
    source = (root / match[2]).read_text(encoding="utf-8")
    shown = part(source, match[3]) if match[3] else re.sub(r"\A// SPDX.*\n", "", source)
    return match[1] + shown + match[5]


def diff(match):
    old, new = ((root / name).read_text(encoding="utf-8").splitlines(keepends=True)
                for name in (match[2], match[3]))
    lines = list(difflib.unified_diff(old, new, match[2], match[3], n=2))
    changed = sum(line[0] in "+-" for line in lines[2:])  # the first two name the files
    if not 0 < changed < int(match[4]):
        wrong_length.append(f"{match[2]} and {match[3]} differ by {changed} lines, not by 1 to {int(match[4]) - 1}")
    return match[1] + "".join(lines) + match[6]


if part("a;\n  b {\n    c {\n    }\n  };\n  }\n", "b") != "b {\n  c {\n  }\n};\n":
    sys.exit("the check of parts itself is wrong")
stale = []
count = 0
for page in [root / "README.md", *sorted(root.glob("docs/**/*.md"))]:
    text = page.read_text(encoding="utf-8")
    wanted = diff_pattern.sub(diff, example_pattern.sub(example, text))
    found = len(example_pattern.findall(text)) + len(diff_pattern.findall(text))
    if found != len(re.findall(r"<!-- (?:example|diff):", text)):
        sys.exit(f"{page.name} has a comment that is not followed by the block that it announces")
    count += found
    if wanted != text and "--write" in sys.argv[1:]:
        page.write_text(wanted, encoding="utf-8")
    elif wanted != text:
        stale.append(page.name)
if stale or count == 0:
    sys.exit(f"not the examples and diffs as they are: {stale}; test/readme.py --write puts them in")
if wrong_length:
    sys.exit("; ".join(wrong_length))
readme, glossary, pictures = ((root / name).read_text(encoding="utf-8")
                              for name in ("README.md", "docs/glossary.md", "docs/concepts.md"))
if readme.count("\n") > 110:
    sys.exit(f"the README has {readme.count(chr(10))} lines instead of 110 at most")
bold = re.compile(r"\*\*([a-z ]+?)s?\*\*")
terms = set(bold.findall(readme + pictures))
if not terms or terms - set(bold.findall(glossary)):
    sys.exit(f"terms that the glossary lacks: {sorted(terms - set(bold.findall(glossary)))}")
print(f"{count} code blocks are the examples and diffs that they name")
