# SPDX-License-Identifier: Apache-2.0
"""Checks that each code block of the README and docs/ that names an example is that example, line
by line, and that each block that names two files and a limit is their diff, with fewer lines added
and removed than that. `readme.py --write` puts the examples and diffs in. The README keeps to 110 lines, and the glossary
has every term that it and the pictures' page define in bold."""
import difflib
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parent.parent
example_pattern = re.compile(r"(<!-- example: (\S+) -->\n```cpp\n)(.*?)(```\n)", re.DOTALL)
diff_pattern = re.compile(
    r"(<!-- diff: (\S+) (\S+), fewer than (\d+) lines -->\n```diff\n)(.*?)(```\n)", re.DOTALL)
wrong_length = []


def example(match):
    source = (root / match[2]).read_text(encoding="utf-8")
    return match[1] + re.sub(r"\A// SPDX.*\n", "", source) + match[4]


def diff(match):
    old, new = ((root / name).read_text(encoding="utf-8").splitlines(keepends=True)
                for name in (match[2], match[3]))
    lines = list(difflib.unified_diff(old, new, match[2], match[3], n=2))
    changed = sum(line[0] in "+-" for line in lines[2:])  # the first two name the files
    if not 0 < changed < int(match[4]):
        wrong_length.append(f"{match[2]} and {match[3]} differ by {changed} lines, not by 1 to {int(match[4]) - 1}")
    return match[1] + "".join(lines) + match[6]


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
