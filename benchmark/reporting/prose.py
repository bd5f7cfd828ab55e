# SPDX-License-Identifier: Apache-2.0
"""Finds figures in sentences that look measured and that no marker makes from raw data.

A figure looks measured if it is a number beside a unit of time, size, speed or share, or beside "times"; a decimal; or
a multiple or a part in words. Code, versions, addresses of links and what stands between markers are left out:
pages.py checks the last.
"""
import re

from .pages import PLOT, REPORT

NUMBER = r"(?<![\w.])\d[\d,]*(?:\.\d+)?(?:e[+-]?\d+)?"
COUNT = r"(?:two|three|four|five|six|seven|eight|nine|ten|twenty|fifty|a hundred|a thousand)"
PART = r"(?:third|quarter|fifth|sixth|seventh|eighth|tenth|twelfth|twentieth|hundredth)s?"
UNIT = (r"(?:%|per cent|percent|times|ns|µs|us|ms|seconds?|milliseconds?|microseconds?|minutes|[TGMK]i?B(?:/s)?|"
        r"[GM]Hz|cycles|million|thousand million|points?)(?![\w-])")
FIGURE = re.compile("|".join([
    rf"{NUMBER}(?: (?:to|and|or) {NUMBER})?[ -]?{UNIT}",
    rf"{NUMBER}(?:x|×|-fold)(?!\w)|\bfactor of {NUMBER}|{NUMBER} of {NUMBER}",
    rf"{COUNT}(?: (?:to|and|or) {COUNT})? (?:times|per cent|percent)\b",
    rf"\b(?:a|an|one|two|three|four|five|nine)[ -]{PART}\b",
    r"\b(?:half (?:of|the|as|again|more)|twice (?:as|the)|doubles?d? (?:the|its)|(?:by|in) half|(?:three|four|ten)fold)\b",
    rf"(?<![\w.:])\d+\.\d+(?![\w.])"]), re.IGNORECASE)
VERSION = re.compile(r"\b(?:CCCL|CMake|nvcc|CUDA|Apache|g\+\+|clang|capabilit(?:y|ies)) [\d.]+(?:(?:,| to| and) [\d.]+)*"
                     rf"(?! ?{UNIT})")
FENCE = re.compile(r"^ *(```|~~~).*?^ *\1[^\n]*$", re.DOTALL | re.MULTILINE)
CODE = re.compile(r"`+[^`]+?`+")
ADDRESS = re.compile(r"\]\([^()\s]+\)|https?://\S+")


def sentences(text):
    """The text with spaces in place of all that is no sentence, every position kept."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match[0])
    for pattern in (REPORT, PLOT, FENCE, CODE, ADDRESS, VERSION):
        text = pattern.sub(blank, text)
    return text


def figures(text):
    """(line from 1, words, the line's words) of every figure that looks measured."""
    text = sentences(text)
    for match in FIGURE.finditer(text):
        begin = text.rfind("\n", 0, match.start()) + 1
        end = text.find("\n", match.end())
        yield text.count("\n", 0, match.start()) + 1, match[0], text[begin:end if end >= 0 else len(text)].strip()


# Pages that say what was measured. The others say how the library is used and built; their figures are limits and settings.
PAGES = ("README.md", "docs/accuracy.md", "docs/concepts.md", "docs/glossary.md", "docs/paper.md", "docs/schedules.md",
         "docs/results/")

# (page, words of the line, why no measurement of ours stands behind it)
ALLOWED = [
    ("docs/paper.md", "it is within 25 per cent of the law", "a threshold of summary.grows"),
    ("docs/results/h200-own-kernels.md", "geometric mean where 30 or 70 of 100 paths survive a", "a setting"),
    ("docs/results/h200-own-kernels.md", "shader 0 has 95 of 100 requests", "a setting"),
    ("docs/paper.md", "they move bytes at 50 per cent of a copy's rate", "a threshold of summary.share_of_copy"),
]


def unfounded(root):
    """What is wrong with the sentences of all pages: figures without a marker, and exceptions that nothing needs."""
    used = set()
    for page in sorted([root / "README.md", *root.glob("docs/**/*.md")]):
        name = page.relative_to(root).as_posix()
        if not name.startswith(PAGES):
            continue
        for line, figure, words in figures(page.read_text(encoding="utf-8")):
            allowed = [entry for entry in ALLOWED if entry[0] == name and entry[1] in words and figure in entry[1]]
            used.update(allowed)
            if not allowed:
                yield f"{name}:{line}: '{figure}' looks measured, and no marker makes it: {words}"
    for entry in ALLOWED:
        if entry not in used:
            yield f"benchmark/reporting/prose.py allows '{entry[1]}', which {entry[0]} does not have"
