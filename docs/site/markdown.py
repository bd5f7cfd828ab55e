# SPDX-License-Identifier: Apache-2.0
"""What the site and the check of links need to know of Markdown: headings, their anchors on GitHub, links, and
where code is."""
import re

FENCE = re.compile(r"^ *(```|~~~)")
LINK = re.compile(r'(!?)\[((?:[^\[\]]|\[[^\[\]]*\])*)\]\(([^()\s]+)(?:\s+"[^"]*")?\)')
HTML_LINK = re.compile(r'<(?:a|img)\b[^>]*\b(?:href|src)="([^"]+)"')


COMMENT = re.compile(r"<!--.*?-->", flags=re.DOTALL)


def without_code(text, comments=False):
    """The text with spaces in place of code, and of comments too unless they are wanted, so that every position
    stays what it is."""
    lines, fence = [], None
    for line in text.split("\n"):
        mark = FENCE.match(line)
        if mark and fence in (None, mark[1]):
            fence = mark[1] if fence is None else None
            line = " " * len(line)
        lines.append(" " * len(line) if fence else line)
    blank = lambda match: re.sub(r"[^\n]", " ", match[0])
    text = "\n".join(lines) if comments else COMMENT.sub(blank, "\n".join(lines))
    return re.sub(r"(?<!`)(`+)(?!`)(?:(?!\n\n).)+?(?<!`)\1(?!`)", blank, text, flags=re.DOTALL)


def headings(text):
    """(line number from 0, level, words, anchor) of every heading. Anchors are those of GitHub: lower case,
    hyphens for spaces, no punctuation, and a number for what has occurred before."""
    seen, lines, result = {}, text.split("\n"), []
    for number, line in enumerate(without_code(text).split("\n")):
        mark = re.match(r"(#{1,6}) +\S?", line)
        if not mark:
            continue
        words = lines[number][len(mark[1]):].strip()
        plain = LINK.sub(r"\2", words).replace("`", "").replace("*", "")
        anchor = re.sub(r"[^\w\- ]", "", plain.lower()).replace(" ", "-")
        count = seen[anchor] = seen.get(anchor, -1) + 1
        result.append((number, len(mark[1]), words, f"{anchor}-{count}" if count else anchor))
    return result


def anchors(text):
    return {heading[3] for heading in headings(text)} | set(re.findall(r'<a (?:id|name)="([^"]+)"', text))


def links(text):
    """(position, end, whether it is an image, words, target) of every link outside of code."""
    masked = without_code(text)
    found = [(m.start(), m.end(), m[1] == "!", text[m.start(2):m.end(2)], m[3]) for m in LINK.finditer(masked)]
    return found + [(m.start(), m.end(), None, "", m[1]) for m in HTML_LINK.finditer(masked)]
