# SPDX-License-Identifier: Apache-2.0
"""Checks that each code block of the README that names an example is that example, line by line.

`readme.py --write` puts the examples in."""
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parent.parent
readme = root / "README.md"
pattern = re.compile(r"(<!-- example: (\S+) -->\n```cpp\n)(.*?)(```\n)", re.DOTALL)


def example(match):
    source = (root / match[2]).read_text(encoding="utf-8")
    return match[1] + re.sub(r"\A// SPDX.*\n", "", source) + match[4]


text = readme.read_text(encoding="utf-8")
blocks = pattern.findall(text)
wanted = pattern.sub(example, text)
if "--write" in sys.argv[1:]:
    readme.write_text(wanted, encoding="utf-8")
elif not blocks or wanted != text:
    sys.exit("README.md does not show the examples as they are: run test/readme.py --write")
print(f"{len(blocks)} examples in README.md")
