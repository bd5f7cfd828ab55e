# SPDX-License-Identifier: Apache-2.0
"""The paper's claims next to the raw data, a table for each."""
import statistics
from collections import defaultdict

from .google_benchmark import Report, geometric_mean
from .markdown import size, table
from .paper import GROUPINGS, LATER, SCENES, SCHEDULES, unsorted
from .scaling import NAMES, growth, series
from .schedules import Cells

WARP = 32


def verdict(held):
    """Of whether a claim held, case by case."""
    if all(held):
        return "holds"
    return f"depends: {sum(held)} of {len(held)}" if any(held) else "no longer holds"


def scenes(path, n, kind="index", schedules="paper"):
    """The best of some schedules over unsorted implicit serialisation, scene by scene, and whether it pays, or does
    not, as in the paper."""
    cells, n = Cells(Report(path).times), int(n)
    names = SCHEDULES if schedules == "paper" else SCHEDULES + LATER
    rows = []
    for scene in SCENES:
        row, held = [scene.name, scene.words()], []
        for run in cells.runs:
            times = cells.rows[scene.name, n, run][kind]
            best = min(names, key=lambda name, times=times: times[name])
            speedup = unsorted(times) / times[best]
            held.append((speedup > 1) == scene.pays())
            row.append(f"{speedup:.2f} {best}")
        rows.append(row + [verdict(held)])
    return table(["shaders", "paper"] + [f"run {run}" for run in cells.runs] + ["whether it pays, as in the paper"], rows)


def mixed(x):
    """As benchmark/shaders.hpp mixes bits."""
    x ^= x >> 16
    x = x * 0x85ebca6b & 0xffffffff
    x ^= x >> 13
    x = x * 0xc2b2ae35 & 0xffffffff
    return x ^ x >> 16


def ids_of(n, shaders, run):
    """As benchmark/batch.hpp makes ids."""
    def bits(i, dimension):
        return mixed(mixed(i + 1) + dimension * 0x9e3779b1 & 0xffffffff)
    begin = 0
    for i in range(n):
        begin = i if bits(i, 0) % run == 0 else begin
        yield bits(begin, 1) % shaders


def coherence(path, requests="16384"):
    """The heterogeneous efficiency, with shaders of one cost, of the first ids of every set and run of a report."""
    cells, n = Cells(Report(path).times), int(requests)
    rows = []
    for scene in SCENES:
        shaders = sum(int(word) for word in scene.name.split() if word.isdigit())
        row = [scene.name]
        for run in cells.runs:
            ids = list(ids_of(n, shaders, run))
            row.append(f"{100 * n / sum(WARP * len(set(ids[k:k + WARP])) for k in range(0, n, WARP)):.0f} %")
        rows.append(row)
    return table(["shaders"] + [f"run {run}" for run in cells.runs], rows)


def dispatches(*paths):
    """After a grouping: in how many cells explicit dispatch is faster than implicit, and in brackets the geometric mean
    of implicit over explicit."""
    rows = []
    for path in paths:
        report = Report(path)
        cells = Cells(report.times)
        for kind in ("index", "record"):
            for n in cells.sizes:
                row = [report.context["machine"], kind, size(n)]
                for grouping in GROUPINGS:
                    ratios = [times[f"{grouping}+implicit"] / times[f"{grouping}+explicit"]
                              for cell, kinds in cells.rows.items() if cell[1] == n for times in [kinds[kind]]]
                    row.append(f"{sum(r > 1 for r in ratios)} of {len(ratios)} ({geometric_mean(ratios):.2f})")
                rows.append(row)
    return table(["machine", "shaders", "n", *GROUPINGS], rows)


def dispatches_by_set(path, n):
    """After a grouping, set by set: the geometric mean of implicit over explicit dispatch."""
    cells, n = Cells(Report(path).times), int(n)
    rows = [[kind, shaders] + [f"{geometric_mean([t[f'{g}+implicit'] / t[f'{g}+explicit'] for t in found]):.2f}"
                               for g in GROUPINGS]
            for kind in ("index", "record") for shaders in cells.sets
            for found in [[cells.rows[shaders, n, run][kind] for run in cells.runs]]]
    return table(["shaders", "set", *GROUPINGS], rows)


def unordered(path, n, kind="index"):
    """Explicit serialisation over requests as they come: over the switch, and over the same after the best grouping of
    the paper."""
    cells, n = Cells(Report(path).times), int(n)
    rows = []
    for shaders in cells.sets:
        row = [shaders]
        for run in cells.runs:
            times = cells.rows[shaders, n, run][kind]
            grouped = min(times["compact+explicit"], times["sort+explicit"])
            row.append(f"{times['explicit'] / unsorted(times):.2f} ({times['explicit'] / grouped:.2f})")
        rows.append(row)
    return table(["shaders"] + [f"run {run}" for run in cells.runs], rows)


def local(*paths, kind="index"):
    """How often schedules that sort inside blocks win, and what the paper's one gains."""
    rows = []
    for path in paths:
        report = Report(path)
        cells = Cells(report.times)
        for n in cells.sizes:
            won, gains = defaultdict(int), []
            here = [cells.rows[cell][kind] for cell in cells.rows if cell[1] == n]
            for times in here:
                won[min(["implicit", *SCHEDULES, *LATER], key=lambda name, times=times: times[name])] += 1
                gains.append(unsorted(times) / times["local-bitonic"])
            rows.append([report.context["machine"], size(n), f"{sum(g > 1 for g in gains)} of {len(here)}",
                         f"{geometric_mean(gains):.2f}"] +
                        [won[name] for name in ("local-bitonic", "local", "window")] +
                        [sum(won[name] for name in won if name not in ("local-bitonic", "local", "window"))])
    return table(["machine", "n", "`local-bitonic` beats unsorted implicit in", "its speedup, geometric mean",
                  "best is `local-bitonic`", "`local`", "`window`", "another"], rows)


def scaling(*paths, n):
    """What grouping takes from the smallest table to the largest, and from a number of requests to the most."""
    found, _ = series(*paths)
    n, rows = int(n), []
    for way, times in found.items():
        if way == "copy-5-bytes":
            continue
        sets, most = sorted({m for m, _ in times}), max(count for _, count in times)
        row = [NAMES[way]]
        for m in (32, 256):
            factor = growth(times, (4, n), (m, n), lambda cell: cell[0])[0] if m in sets else None
            row.append(f"{factor:.2f}" if factor else "")
        begin = 8 << 20
        powers = [growth(times, (m, begin), (m, most), lambda cell: cell[1])[1] for m in sets]
        rows.append(row + [f"{statistics.median(powers):.2f}"])
    return table(["way", f"32 shaders over 4, {size(n)}", "256 over 4", f"power of N, {size(begin)} to {size(most)}"],
                 rows + [["*× M*", "8", "64", "1"], ["*× log M*", "2.5", "4", "1"]])
