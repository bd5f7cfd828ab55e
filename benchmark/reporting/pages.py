# SPDX-License-Identifier: Apache-2.0
"""Finds what a page has from raw data, and makes it anew.

    <!-- report: VIEW FILE... OPTION=VALUE... -->
    what the view gives of these files of docs/results
    <!-- end of report -->

    <!-- plot: PLOT FILE... OPTION=VALUE... -->
    ![what is to be seen](plot.svg)

A report that stands in the middle of a line has no line breaks around it. A figure in a sentence that looks measured
stands in one: prose.py finds others. Besides these and the examples that
test/readme.py puts in, a page has no comments: what looks like one is a marker gone wrong.
"""
import os
import pathlib
import re
import shlex

REPORT = re.compile(r"(<!-- report: (.+?) -->)(\n?)(.*?)(<!-- end of report -->)", re.DOTALL)
PLOT = re.compile(r"<!-- plot: (.+?) -->\n!\[[^\]]*\]\(([^)]+\.svg)\)")
EXAMPLE = re.compile(r"<!-- (?:example|diff): [^\n]+ -->")  # test/readme.py checks those
FIRST = re.compile(r"^[ \t]*(?:[-*] +)?<!-- report: [^\n]+?-->[^\n]", re.MULTILINE)  # HTML to Markdown, not text


class Stale(ValueError):
    """A marker that says nothing that can be made."""


def in_full(value):
    """8Mi and 128Ki as numbers, also in a list; all else as it is."""
    units = {"K": 1 << 10, "M": 1 << 20}
    return re.sub(r"\b(\d+)([KM])i\b", lambda m: str(int(m[1]) * units[m[2]]), value)


def parse(words, raw):
    """The name of a view, its files, which a * may stand for, and its options."""
    name, *rest = shlex.split(words)
    options = {word.split("=", 1)[0]: in_full(word.split("=", 1)[1]) for word in rest if "=" in word}
    files = [file for word in rest if "=" not in word
             for file in (sorted(raw.glob(word)) if "*" in word else []) or [raw / word]]
    missing = [file.name for file in files if not file.is_file()]
    if missing:
        raise Stale(f"{words}: there is no raw data {', '.join(missing)}")
    return name, files, options


class Pages:
    """All pages below a folder, and `raw`, the folder of the data. `views` and `plots` are functions by name, of
    files and options."""

    def __init__(self, pages, raw, views, plots):
        self.pages, self.raw, self.views, self.plots = pages, raw, views, plots
        self.count = 0

    def make(self, words, functions):
        name, files, options = parse(words, self.raw)
        if name not in functions:
            raise Stale(f"{words}: there is no {name}, but {', '.join(functions)}")
        try:
            return functions[name](*files, **options)
        except LookupError as error:
            raise Stale(f"{words}: the raw data has no {error}") from error
        except (ArithmeticError, AttributeError, StopIteration, TypeError, ValueError) as error:
            raise Stale(f"{words}: {type(error).__name__}: {error}") from error

    def wanted(self, page):
        """{path: text} of a page and its plots as they should be."""
        text = page.read_text(encoding="utf-8")

        def place(position):
            return f"{page.name}:{text.count(chr(10), 0, position) + 1}"

        def made(match, words, functions):
            try:
                return self.make(words, functions)
            except Stale as error:
                raise Stale(f"{place(match.start())}: {error}") from error

        rest = text
        for pattern in (REPORT, PLOT, EXAMPLE):
            rest = pattern.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), rest)
        if "<!--" in rest:
            raise Stale(f"{place(rest.index('<!--'))}: a marker that is none, one without its end, or a plot without "
                        "its picture")
        if first := FIRST.search(text):
            raise Stale(f"{place(first.start())}: a report in the middle of a line begins it, which makes HTML of the line")
        self.count += len(REPORT.findall(text)) + len(PLOT.findall(text))
        found = {page: REPORT.sub(lambda m: f"{m[1]}{m[3]}{made(m, m[2], self.views)}{m[3]}{m[5]}", text)}
        for match in PLOT.finditer(text):
            found[pathlib.Path(os.path.normpath(page.parent / match[2]))] = made(match, match[1], self.plots)
        return found

    def stale(self):
        """(path, its text as it should be) of each file that differs."""
        for page in self.pages:
            for path, text in self.wanted(page).items():
                if not path.is_file() or path.read_text(encoding="utf-8") != text:
                    yield path, text

    def unused(self):
        """Raw data that no marker names."""
        named = set()
        for page in self.pages:
            text = page.read_text(encoding="utf-8")
            for words in [m[1] for m in REPORT.findall(text)] + [m[0] for m in PLOT.findall(text)]:
                named.update(parse(words, self.raw)[1])
        return sorted(file.name for file in self.raw.iterdir()
                      if file.suffix in (".json", ".jsonl") and file not in named)


def first_difference(path, wanted):
    """The first line of a file that is not as it should be, and that line."""
    if not path.is_file():
        return "there is no such file"
    lines = path.read_text(encoding="utf-8").split("\n")
    for number, (has, should) in enumerate(zip(lines + [None], wanted.split("\n") + [None]), start=1):
        if has != should:
            return f"line {number} is\n    {has}\n  and the raw data gives\n    {should}"
    return "its end differs"
