#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the tables and plots of the documentation from the raw data in docs/results.

    benchmark/report.py              puts them into the pages
    benchmark/report.py --check      fails where a page has something else than the raw data gives, and where a figure
                                     in a sentence looks measured and no marker makes it
    benchmark/report.py --unused     raw data that no page names
    benchmark/report.py --run BUILD  runs the benchmarks of a build, for a GPU or for CPUs, into out/benchmark:
                                     raw data, and a page of tables and plots of it, report.md

A page says between which markers what of which file stands; reporting/pages.py says how. To measure again: put
the new file where the old one was, or name it in the marker, and run this. It needs Python 3.11 and nothing else.
"""
import argparse
import pathlib
import sys

from reporting import prose, running
from reporting.pages import Pages, Stale, first_difference
from reporting.views import PLOTS, VIEWS

ROOT = pathlib.Path(__file__).resolve().parent.parent


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--check", action="store_true")
    what.add_argument("--unused", action="store_true")
    what.add_argument("--run", metavar="BUILD", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true", help="with --run: a few sizes alone")
    parser.add_argument("--filter", help="with --run: a regular expression that names of cells match")
    parser.add_argument("--repetitions", type=int, default=3, help="with --run; their spread is reported")
    arguments = parser.parse_args()

    if arguments.run:
        return sys.exit(running.run(arguments.run, ROOT / "out/benchmark", ROOT, arguments))
    pages = Pages([ROOT / "README.md", *sorted(ROOT.glob("docs/**/*.md"))], ROOT / "docs/results", VIEWS, PLOTS)
    if arguments.unused:
        return print("\n".join(pages.unused()))
    try:
        stale = list(pages.stale())
    except Stale as error:
        sys.exit(str(error))
    for path, text in stale:
        name = path.relative_to(ROOT)
        if arguments.check:
            print(f"{name}: {first_difference(path, text)}")
        else:
            path.write_text(text, encoding="utf-8")
            print(f"{name} is new")
    if unfounded := list(prose.unfounded(ROOT)):
        sys.exit("\n".join(unfounded))
    if pages.count == 0 or (arguments.check and stale):
        sys.exit("not what the raw data gives; benchmark/report.py puts it in")
    print(f"{pages.count} tables, plots and figures are what the raw data gives")


if __name__ == "__main__":
    main()
