# SPDX-License-Identifier: Apache-2.0
"""Whether a page of the site has all the words of its Markdown, code included: Doxygen drops what it takes for
something else without a warning."""
import html
import re

import markdown


def words_of_markdown(text):
    result = list(text)
    for start, end, image, words, _ in markdown.links(text):
        if image is not None:
            result[start:end] = ("" if image else f"[{words}]").ljust(end - start)
    tags = re.finditer(r"</?[a-z]+\d?(?: [^<>\n]*)?/?>", markdown.without_code(text))
    for tag in [*tags, *markdown.COMMENT.finditer(markdown.without_code(text, comments=True))]:
        result[tag.start():tag.end()] = " " * len(tag[0])
    text = "".join(result)
    text = re.sub(r"(?m)^ *(?:```|~~~).*$|^ *\d+\. |^\[[^\]]+\]: .*$", " ", text)
    return re.findall(r"\w+", html.unescape(text))


def words_of_html(text):
    text = text[text.index("<main>"):]
    text = re.sub(r'<div class="toc">.*?</div>|<!--.*?-->|<wbr>', "", text, flags=re.DOTALL)
    return re.findall(r"\w+", html.unescape(re.sub(r"<[^>]*>", " ", text)))


def difference(text, page):
    """Where the words of a page of the site begin to differ from those of its Markdown, or an empty text."""
    wanted, found = words_of_markdown(text), words_of_html(page)
    for i, word in enumerate(wanted):
        if i >= len(found) or found[i] != word:
            return f"'{' '.join(wanted[i:i + 8])}' is '{' '.join(found[i:i + 8])}'"
    return ""
