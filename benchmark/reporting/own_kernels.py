# SPDX-License-Identifier: Apache-2.0
"""Renderers with kernels of their own: tables and figures of benchmark_renderer, benchmark_gather, benchmark_shared and
benchmark_uneven, and of the two renderers of docs/integrating.md."""
import re
import statistics
from collections import defaultdict

from .google_benchmark import Report
from .markdown import size, table
from .sentences import listed, words

OWN = ("unsorted", "thrust", "queues")  # without the library


def cells(path):
    """{(the names but the last, n): {the last name: time}}, in the order of the file."""
    found = defaultdict(dict)
    for (names, n, _), time in Report(path).times.items():
        found[names[:-1], n][names[-1]] = time
    return found


def gain(ways, way):
    """How many times as fast as the best way without the library."""
    return min(ways[own] for own in OWN) / ways[way]


def renderer(path):
    """Times of the bounces of a frame."""
    rows = []
    for ((materials, survival), n), ways in sorted(cells(path).items(), key=lambda cell: (cell[0][1], -percent(cell[0]))):
        rows.append([size(n), survival, materials.split()[0]] + [f"{time:.0f}" for time in ways.values()] +
                    [f"{gain(ways, 'group'):.2f}", f"{gain(ways, 'gather'):.2f}"])
    head = ["paths", "survive a bounce", "materials", *next(iter(cells(path).values())), "best of own / group",
            "best of own / gather"]
    return table(head, rows)


def percent(cell):
    return int(cell[0][1].split()[0])


def renderer_gain(path, way="group", survival="", form="hundredths", pick=""):
    """`way` over the best way without the library; `survival`: the cells with these shares, all if it is empty."""
    return words([gain(ways, way) for (names, _), ways in cells(path).items()
                  if not survival or names[1].split()[0] in listed(survival)], form, pick)


def gathers(path):
    """Shares of a copy's rate."""
    rows = [[size(n), order, bytes_.split()[0]] +
            [f"{ways['copy'] / ways[way]:.2f}" for way in ("thrust", "gather", "scatter")]
            for ((bytes_, order), n), ways in cells(path).items()]
    return table(["structs", "order", "bytes", "thrust::gather", "gather", "scatter"], rows)


def times(path):
    """Times of ways to run the same requests."""
    found = cells(path)
    ways = list(next(iter(found.values())))
    return table(["requests", *ways], [[size(n)] + [f"{times_[way]:.0f}" for way in ways]
                                       for (_, n), times_ in found.items()])


def over(path, one, other, form="hundredths", n="", set="", pick=""):
    """The time of one way over that of another one."""
    return words([ways[one] / ways[other] for (names, count), ways in cells(path).items()
                  if (not n or str(count) in listed(n)) and (not set or set in "/".join(names))], form, pick)


def uneven(path):
    """Over the oracle's launches."""
    found = cells(path)
    ways = [way for way in next(iter(found.values())) if way not in ("oracle-launches", "bucket+explicit")]
    name = {"fixed-shares": "bucket+explicit"}
    rows = [[size(n), set_.split(",")[0]] + [f"{times_[way] / times_['oracle-launches']:.2f}" for way in ways]
            for ((set_, kind), n), times_ in found.items() if kind == "index"]
    return table(["requests", "shaders", *(name.get(way, way) for way in ways)], rows)


def integration(path):
    """Milliseconds of a frame of the two renderers, as they print them: medians, least and most of several runs."""
    frames = defaultdict(lambda: defaultdict(list))
    for line in path.read_text(encoding="utf-8").splitlines():
        name, scale, time = re.fullmatch(r"(\w+) scale (\d+): .* ([\d.]+) ms a frame", line).groups()
        frames[int(scale)][name].append(float(time))
    rows = []
    for scale, found in sorted(frames.items()):
        middle = {name: statistics.median(times_) for name, times_ in found.items()}
        rows.append([f"{320 * scale} x {240 * scale}"] +
                    [f"{middle[name]:.2f} ({min(found[name]):.2f} to {max(found[name]):.2f})" for name in ("sort", "grouped")] +
                    [f"{middle['sort'] / middle['grouped']:.2f}"])
    return table(["paths", "with the sort, ms", "with the library, ms", "times as fast"], rows)
