# SPDX-License-Identifier: Apache-2.0
"""What schedules gain over unsorted implicit serialisation in many cells at a time: what a choice goes by."""
from .google_benchmark import Report, geometric_mean
from .markdown import size, table
from .paper import unsorted
from .schedules import Cells

SCHEDULES = ("sort+explicit", "bucket+explicit", "local", "window")


def speedups(cells, schedule, kind, wanted=lambda shaders, n, run: True):
    return [unsorted(kinds[kind]) / kinds[kind][schedule] for cell, kinds in cells.rows.items() if wanted(*cell)]


def means(path):
    """Geometric means, and in brackets the least and the most, of short shaders and of others, with ids at random and in
    stretches."""
    cells, rows = Cells(Report(path).times), []
    first, *longer = cells.runs
    for kind in ("index", "record"):
        for short in (True, False):
            for runs in ((first,), longer):
                for n in cells.sizes:
                    def wanted(shaders, count, run, n=n, runs=runs, short=short):
                        return count == n and run in runs and shaders.endswith(" simple") == short
                    row = [kind, "simple" if short else "others", ", ".join(map(str, runs)), size(n)]
                    for schedule in SCHEDULES:
                        found = speedups(cells, schedule, kind, wanted)
                        row.append(f"{geometric_mean(found):.2f} ({min(found):.2f} to {max(found):.2f})")
                    rows.append(row)
    return table(["shaders", "sets", "runs", "n", *SCHEDULES], rows)


def span(*paths, schedule, kind="record"):
    """From the least to the most that a schedule gains in any cell of some reports, for a sentence."""
    found = [value for path in paths for value in speedups(Cells(Report(path).times), schedule, kind)]
    return f"{min(found):.1f} to {max(found):.1f}"


def apart(path, one, other):
    """How far apart the times of two schedules lie that are one and the same, for a sentence."""
    cells = Cells(Report(path).times)
    off = sorted(max(a / b, b / a) - 1 for kinds in cells.rows.values() for times in kinds.values()
                 for a, b in [(times[one], times[other])])
    return f"{100 * off[len(off) // 2]:.0f} % in the median cell, {100 * off[-1]:.0f} % in the worst"


def against(*paths, one, other, n="", shaders=""):
    """From the least to the most that one way to group takes next to another, for a sentence: with the sizes and the
    tables named, or with all."""
    sizes, tables = (set(filter(None, words.split(","))) for words in (n, shaders))
    found = [time / times[(name, other), count, run] for path in paths for times in [Report(path).times]
             for ((name, way), count, run), time in times.items()
             if way == one and (not sizes or str(count) in sizes) and (not tables or name.split()[0] in tables)]
    return f"{min(found):.1f} to {max(found):.1f}"
