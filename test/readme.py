# SPDX-License-Identifier: Apache-2.0
"""Checks that each code block of the README and docs/ that names an example is that example, line
by line. `readme.py --write` puts the examples in."""
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parent.parent
pattern = re.compile(r"(<!-- example: (\S+) -->\n```cpp\n)(.*?)(```\n)", re.DOTALL)


def example(match):
    source = (root / match[2]).read_text(encoding="utf-8")
    return match[1] + re.sub(r"\A// SPDX.*\n", "", source) + match[4]


stale = []
count = 0
for page in [root / "README.md", *sorted(root.glob("docs/**/*.md"))]:
    text = page.read_text(encoding="utf-8")
    wanted = pattern.sub(example, text)
    count += len(pattern.findall(text))
    if wanted != text and "--write" in sys.argv[1:]:
        page.write_text(wanted, encoding="utf-8")
    elif wanted != text:
        stale.append(page.name)
if stale or count == 0:
    sys.exit(f"not the examples as they are: {stale}; test/readme.py --write puts them in")
print(f"{count} code blocks are the examples that they name")
