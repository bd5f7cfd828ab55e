#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the site of the documentation: build.py OUTPUT. scripts/site calls it.

Doxygen reads the public headers and the Markdown pages. Pages come to it with an anchor at every heading and with
links that lead inside the site: pages.txt names them, in the order of the navigation, and those that it does not
name but that are there come last. Files of the repository that pages link to are in the site as well.
"""
import html
import os
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

import compare
import markdown

here = pathlib.Path(__file__).resolve().parent
root = here.parent.parent
SHOWN = {".hpp", ".cpp", ".cu", ".py", ".txt", ".cmake", ".patch", ".md", ".gltf"}  # as pages, not as files


def page_name(path):
    """The page of a Markdown file of the repository: docs/results/cpu.md is results-cpu."""
    if path == "README.md":
        return "index"
    return re.sub(r"^docs-|-md$", "", re.sub(r"[/.]", "-", path)).lower()


def read_pages():
    """[(section, [(page name, title, path or None)])] of what is there."""
    sections, known = [], set()
    for line in (here / "pages.txt").read_text(encoding="utf-8").splitlines():
        if not line.startswith(" "):
            sections.append((line, []))
            continue
        path, title = line.split(None, 1)
        known.add(path)
        if path.endswith(".html"):
            sections[-1][1].append((path[:-5], title, None))
        elif (root / path).exists():
            sections[-1][1].append((page_name(path), title, path))
    others = [str(p.relative_to(root)) for p in sorted((root / "docs").glob("**/*.md"))]
    more = [(page_name(path), markdown.headings((root / path).read_text(encoding="utf-8"))[0][2], path)
            for path in others if path not in known]
    return sections + ([("More", more)] if more else [])


def heading(match):
    """The title of a page as a heading: without a link to itself and without what kind of thing it names."""
    words = re.sub(r"</?a\b[^>]*>", "", match[1]).strip()
    words = re.sub(r"^deferred_shade::|\s+(?:Class|Struct|Namespace)(?: Template)? Reference$", "", words)
    words = re.sub(r"(::|_)", r"\1<wbr>", words)
    return f'<h1 class="title">{words}</h1>'


def scrolling(match):
    """A table in a frame that it scrolls in, with room for text where it has some."""
    cells = re.findall(r"<t[dh][^>]*>(.*?)</t[dh]>", match[0], flags=re.DOTALL)
    prose = any(len(re.sub(r"<[^>]*>", "", cell)) > 40 for cell in cells)
    return f'<div class="scroll{" prose" if prose else ""}">{match[0]}</div>'


def named(match):
    """A link to a class where its words name it, else the words: Doxygen 1.9.8 takes keywords for a class."""
    name = match[1].split("_1_1")[-1].replace("__", "_")
    return match[0] if name in match[2] else match[2]


def tidied(text, in_reference):
    """A page of Doxygen's with headings, tables that scroll, and without tooltips and lists of all."""
    text = re.sub(r'<div class="title">(.*?)</div>', heading, text, flags=re.DOTALL)
    text = re.sub(r'<table class="(?:markdownTable|doxtable)".*?</table>', scrolling, text, flags=re.DOTALL)
    text = re.sub(r'<div class="ttc".*?</div></div>\n?|<div class="summary">.*?</div>', "", text, flags=re.DOTALL)
    text = re.sub(r'<a class="el" href="(?:struct|class)([^".#]+)\.html"[^>]*>([^<]*)</a>', named, text)
    # No links where the library is named in prose, and where a parameter has the name of a type.
    text = re.sub(r'(\bIds (?:const &amp;)?)<a [^>]*>ids</a>', r"\1ids", text)
    if not in_reference:
        text = re.sub(r'<a [^>]*href="namespacedeferred__shade\.html"[^>]*>(deferred_shade)</a>', r"\1", text)
    return text


class Site:
    def __init__(self, output, stage):
        self.output, self.stage = output, stage
        self.sections = read_pages()
        self.pages = {path: name for _, entries in self.sections for name, _, path in entries if path}
        self.files = {}  # of the repository, by path: the address in the site

    def address(self, page, target):
        """Where a link of a page leads in the site."""
        if re.match(r"[a-z]+:", target):
            return target
        path, _, anchor = target.partition("#")
        path = os.path.normpath(os.path.join(os.path.dirname(page), urllib.parse.unquote(path))) if path else page
        if path in self.pages:
            name = self.pages[path]
            return f"{name}.html#{name}-{anchor}" if anchor else f"{name}.html"
        return self.file(path)

    def file(self, path):
        """The address of a file or folder of the repository, which the site gets."""
        if path not in self.files:
            source = root / path
            if not source.exists():
                sys.exit(f"{path} does not exist, and a page links to it")
            shown = source.is_dir() or source.suffix in SHOWN
            self.files[path] = f"source-{path.replace('/', '-')}.html" if shown else f"files/{path}"
        return self.files[path]

    @staticmethod
    def wide(page, target):
        """A class for drawings whose text would be too small where they are shrunk: those scroll."""
        path = root / os.path.dirname(page) / target
        width = re.search(r'<svg [^>]*width="(\d+)', path.read_text(encoding="utf-8")) if path.suffix == ".svg" else None
        return " wide" if width and int(width[1]) > 600 else ""

    def staged(self, page, name):
        """A Markdown page as Doxygen gets it."""
        text = (root / page).read_text(encoding="utf-8")
        for comment in reversed(list(markdown.COMMENT.finditer(markdown.without_code(text, comments=True)))):
            text = text[:comment.start()] + text[comment.end():]  # Doxygen takes what follows with them
        for start, end, image, words, target in reversed(markdown.links(text)):
            if image is None:
                continue
            address = self.address(page, target)
            link = f"[{words}]({address})"
            if image:
                link = f'@htmlonly[block]<p class="figure{self.wide(page, target)}"><img src="{address}" ' \
                       f'alt="{html.escape(words)}"></p>@endhtmlonly'
            text = text[:start] + link + text[end:]
        # Doxygen sees no ** beside code, and takes code that begins with :: for something to link to.
        text = re.sub(r"\*\*(`[^`\n]+`)\*\*", r"<strong>\1</strong>", text)
        text = re.sub(r"(?<!`)`::(\w+)`(?!`)", r"<code>\::\1</code>", text)
        lines = text.split("\n")
        headings = markdown.headings(text)
        for number, level, words, anchor in headings:
            if level > 1:
                lines[number] = f"{'#' * level} {words} {{#{name}-{anchor}}}"
            elif name != "index":  # Doxygen's name for it already
                lines[number] = f"# {words} {{#{name}}}"
        if sum(level == 2 for _, level, _, _ in headings) > 3:
            lines.insert(headings[0][0] + 1, "\n[TOC]\n")
        return "\n".join(lines)

    def run_doxygen(self):
        for page, name in self.pages.items():
            (self.stage / f"{name}.md").write_text(self.staged(page, name), encoding="utf-8")
        version = re.findall(r"VERSION_(?:MAJOR|MINOR|PATCH) +(\d+)",
                             (root / "include/deferred_shade/version.hpp").read_text(encoding="utf-8"))
        public = [p for p in (root / "include").glob("**/*.hpp")
                  if "cuda" not in p.parts or p.name == "tuning.hpp"]
        settings = (here / "Doxyfile").read_text(encoding="utf-8") + "\n".join([
            f"PROJECT_NUMBER = {'.'.join(version)}", f'OUTPUT_DIRECTORY = "{self.output}"',
            f'USE_MDFILE_AS_MAINPAGE = "{self.stage / "index.md"}"',
            "INPUT = " + " ".join(f'"{p}"' for p in [*sorted(public), self.stage, here / "reference.dox"])])
        done = subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=root, check=False)
        if done.returncode:
            sys.exit("doxygen has warnings")
        listed = (self.output / "reference.html").read_text(encoding="utf-8")
        missing = [p.name for kind in ("class", "struct") for p in self.output.glob(f"{kind}*_1_1*.html")
                   if not re.search("_3_01|-members", p.name) and f'"{p.name}"' not in listed]
        if missing:
            sys.exit(f"docs/site/reference.dox does not name what these pages are of: {', '.join(missing)}")

    def navigation(self, current):
        out = []
        for section, entries in self.sections:
            out.append(f"<h2>{html.escape(section)}</h2>\n<ul>")
            for name, title, _ in entries:
                here_ = ' aria-current="page"' if name == current else ""
                out.append(f'<li><a href="{name}.html"{here_}>{html.escape(title)}</a></li>')
            out.append("</ul>")
        return "\n".join(out)

    def copy_files(self):
        """The files and folders that pages link to; a folder brings what is in it."""
        header, footer = ((here / name).read_text(encoding="utf-8") for name in ("header.html", "footer.html"))
        done = set()
        while done != set(self.files):
            for path in set(self.files) - done:
                done.add(path)
                source, target = root / path, self.output / self.files[path]
                if source.is_dir():
                    inside = [p for p in sorted(source.iterdir()) if p.name[0] not in "._"]
                    links = (f'<li><a href="{self.file(f"{path}/{p.name}")}">{html.escape(p.name)}</a></li>'
                             for p in inside)
                    body = "<ul>\n" + "\n".join(links) + "\n</ul>"
                elif source.suffix in SHOWN:
                    body = f'<pre class="source">{html.escape(source.read_text(encoding="utf-8"))}</pre>'
                else:
                    target.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy(source, target)
                    continue
                target.write_text(f'{header.replace("$title", html.escape(path))}</div>\n<div class="contents">'
                                  f'<h1 class="title">{html.escape(path)}</h1>\n{body}</div>\n{footer}', encoding="utf-8")

    def finish(self):
        """What Doxygen's pages need, and no file that nothing refers to."""
        texts = {}
        for path in sorted(self.output.glob("*.html")):
            name = path.stem
            if name.startswith(("class", "struct", "namespace")):
                name = "reference"
            text = tidied(path.read_text(encoding="utf-8"), name == "reference")
            if name == "reference":  # comments name pages as files
                text = re.sub(r"docs/[\w/-]+\.md", lambda m: f'<a href="{self.pages[m[0]]}.html">{m[0]}</a>', text)
            texts[path] = text.replace("<!-- navigation -->", self.navigation(name))
            path.write_text(texts[path], encoding="utf-8")
        for page, name in self.pages.items():
            wrong = compare.difference((root / page).read_text(encoding="utf-8"), texts[self.output / f"{name}.html"])
            if wrong:
                sys.exit(f"{page} has lost or gained words: {wrong}")
        reached, queue = set(), ["index.html"]
        while queue:
            name = queue.pop()
            if name not in reached:
                reached.add(name)
                found = re.findall(r'(?:href|src)="([^":#]+)', texts.get(self.output / name, ""))
                queue += [urllib.parse.unquote(target) for target in found]
        for path in [p for p in self.output.glob("**/*") if p.is_file()]:
            if str(path.relative_to(self.output)) not in reached:
                path.unlink()


def main():
    output = pathlib.Path(sys.argv[1]).resolve()
    stage = output.with_name(output.name + ".stage")
    for folder in (output, stage):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
    site = Site(output, stage)
    site.run_doxygen()
    site.copy_files()
    site.finish()
    shutil.rmtree(stage)
    print(f"{len(list(output.glob('*.html')))} pages")


if __name__ == "__main__":
    main()
