#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether links lead anywhere.

    test/links.py              # those of the README, CONTRIBUTING, CHANGELOG and docs/, as they stand on GitHub
    test/links.py --html DIR   # those of a built site, and whether each page of it is reached from index.html

Checks that files exist and that they have the anchors named; addresses outside are left alone. Before that, the
same checks have to find what is wrong with a few pages made for it.
"""
import argparse
import html.parser
import pathlib
import re
import sys
import tempfile
import urllib.parse

root = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(root / "docs" / "site"))
import markdown  # noqa: E402


def pages_of(folder):
    return [p for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md") if (p := folder / name).exists()] \
        + sorted((folder / "docs").glob("**/*.md"))


def outside(target):
    return re.match(r"[a-z][a-z0-9+.-]*:", target) or target.startswith("//")


def line_range(anchor, text):
    """Whether an anchor such as L10 or L10-L20 names lines that a file of code has."""
    lines = re.fullmatch(r"L(\d+)(?:-L(\d+))?", anchor)
    return lines and int(lines[2] or lines[1]) <= text.count("\n")


def wrong_in_markdown(folder):
    """(number of links, what is wrong) below a folder."""
    count, wrong = 0, []
    for page in pages_of(folder):
        text = page.read_text(encoding="utf-8")
        for position, _, _, _, target in markdown.links(text):
            if outside(target):
                continue
            count += 1
            path, _, anchor = urllib.parse.unquote(target).partition("#")
            file = (page.parent / path).resolve() if path else page
            where = f"{page.relative_to(folder)}:{text.count(chr(10), 0, position) + 1}: {target}"
            if not file.exists() or folder not in [file, *file.parents]:
                wrong.append(f"{where}: no such file")
            elif {"build", "out"} & set(file.relative_to(folder).parts[:1]):
                wrong.append(f"{where}: not in the repository")
            elif anchor and (file.is_dir() or not has_anchor(file, anchor)):
                wrong.append(f"{where}: no such anchor")
    return count, wrong


def has_anchor(file, anchor):
    text = file.read_text(encoding="utf-8")
    return anchor in markdown.anchors(text) if file.suffix == ".md" else line_range(anchor, text)


class Page(html.parser.HTMLParser):
    """The ids and the links of a page."""

    def __init__(self, path):
        super().__init__()
        self.ids, self.links, self.twice = set(), [], []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        for name in {attrs.get("id"), attrs.get("name") if tag == "a" else None} - {None}:
            if name in self.ids:
                self.twice.append(name)
            self.ids.add(name)
        self.links += [attrs[name] for name in ("href", "src", "data") if attrs.get(name)]


def wrong_in_html(folder):
    pages = {path: Page(path) for path in sorted(folder.glob("**/*.html"))}
    count, wrong, reached, queue = 0, [], set(), [folder / "index.html"]
    if folder / "index.html" not in pages:
        return 0, ["there is no index.html"]
    for path, page in pages.items():
        wrong += [f"{path.name}: two elements have the id {name}" for name in page.twice]
        for target in page.links:
            if outside(target):
                continue
            count += 1
            name, _, anchor = urllib.parse.unquote(target).partition("#")
            file = (path.parent / name).resolve() if name else path
            if not file.is_file() or folder not in file.parents:
                wrong.append(f"{path.name}: {target}: no such file")
            elif anchor and (file not in pages or anchor not in pages[file].ids):
                wrong.append(f"{path.name}: {target}: no such anchor")
    while queue:
        path = queue.pop()
        if path in reached or path not in pages:
            continue
        reached.add(path)
        queue += [(path.parent / urllib.parse.unquote(t).partition("#")[0]).resolve()
                  for t in pages[path].links if not outside(t)]
    return count, wrong + [f"{path.name}: not reached from index.html" for path in pages if path not in reached]


def control(check, files, expected):
    """Stops unless a check finds exactly what is expected in files made for it."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        for path, text in files.items():
            (folder / path).parent.mkdir(exist_ok=True)
            (folder / path).write_text(text, encoding="utf-8")
        found = sorted(line.split(": ", 1)[1] for line in check(folder)[1])
        if found != sorted(expected):
            sys.exit(f"the check of links itself is wrong: found {found}, expected {expected}")


def controls():
    control(wrong_in_markdown, {
        "README.md": "# A `b`, c\n[good](docs/a.md#two-1) [good](#a-b-c) `[x](y)` [bad](docs/none.md)\n"
                     "```\n[x](y)\n# no heading\n```\n[bad](#no-heading) ![bad](a.png) [out](https://example.org/)\n",
        "docs/a.md": "# Two\n## two\n[good](../README.md) [bad](../README.md#gone) [`bad`](../../README.md)\n"},
        ["docs/none.md: no such file", "#no-heading: no such anchor", "a.png: no such file",
         "../README.md#gone: no such anchor", "../../README.md: no such file"])
    control(wrong_in_html, {
        "index.html": '<a id="x" href="a.html#y">good</a><a href="#z">bad</a><img src="a.png">',
        "a.html": '<p id="y"><p id="y"><a href="index.html#x">good</a><a href="b.html">bad</a>',
        "c.html": "<p>"},
        ["#z: no such anchor", "a.png: no such file", "two elements have the id y", "b.html: no such file",
         "not reached from index.html"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--html", metavar="DIR", type=pathlib.Path, help="check a built site")
    folder = parser.parse_args().html
    controls()
    count, wrong = wrong_in_html(folder.resolve()) if folder else wrong_in_markdown(root)
    if wrong or count == 0:
        sys.exit("\n".join(["links that lead nowhere:" if count else "no links", *wrong]))
    print(f"{count} links lead somewhere")


if __name__ == "__main__":
    main()
