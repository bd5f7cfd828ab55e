#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tables of ratios, as Markdown, from the reports of the benchmarks.

    benchmark_schedules --benchmark_out=schedules.json
    benchmark_grouping --benchmark_out=grouping.json
    benchmark/ratios.py schedules.json grouping.json

and of benchmark_vectors and benchmark_simd alike.

Every ratio is of two medians of one report, and of its repetitions where it has several
(--benchmark_repetitions). Exits with 1 where a cell of a report has an error.
"""
import sys
from collections import defaultdict

from reporting.google_benchmark import Report
from reporting.markdown import size, table
from reporting.schedules import over_controls, over_switch


def grouping(times):
    cells = defaultdict(dict)
    for ((shaders, way), n, run), time in times.items():
        cells[run, int(shaders.split()[0]), n][way] = time
    ways = list(dict.fromkeys(way for ways in cells.values() for way in ways))
    has_cub = "cub-radix-sort" in ways
    head = (["run", "shaders", "n"] + ways + ["CUB / bucket"] * has_cub + ["bucket / 5 bytes"])
    rows = []
    for (run, shaders, n), row in sorted(cells.items()):
        def ratio(above, below, factor, row=row):
            return f"{factor * row[above] / row[below]:.2f}" if {above, below} <= set(row) else ""
        rows.append([run, shaders, size(n)] + [f"{row[w]:.1f}" if w in row else "" for w in ways] +
                    [ratio("cub-radix-sort", "bucket", 1)] * has_cub +
                    [ratio("bucket", "copy-5-bytes", 2)])
    return [("Grouping alone, µs",
             "5 bytes: what an id and an index per request take at the rate of the copy, which moves 10.\n\n" +
             table(head, rows))]


def ways(times):
    """Ways to run one shader over packed records."""
    found = {way: 1000 * time / n for ((_, way), n, _), time in times.items()}
    return [("Ways to vectors, ns per request",
             table(["way", "ns", "faster than scalar"],
                   [[way, f"{time:.2f}", f"{found['scalar'] / time:.1f}" if "scalar" in found else ""]
                    for way, time in found.items()]))]


def sections(report):
    """(title, text) of every table that there is of a report."""
    if not report.times:
        return []
    names = next(iter(report.times))[0]
    if names[0] == "stone":
        return ways(report.times)
    if len(names) == 2:
        return grouping(report.times)
    return (over_controls if "cuda_driver" in report.context else over_switch)(report.times)


def text(report, level=2):
    """All that there is to say of a report; its titles are headings of a level, or lines of the text with level 0."""
    parts = [report.provenance()]
    for title, body in sections(report):
        parts += [f"{'#' * level} {title}" if level > 0 else f"{title}:", body]
    return "\n\n".join(parts)


def main(paths):
    if not paths:
        sys.exit(__doc__)
    reports = [Report(path) for path in paths]
    for report in reports:
        print(text(report) + "\n")
    return 1 if any(report.errors for report in reports) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
