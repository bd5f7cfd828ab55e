# SPDX-License-Identifier: Apache-2.0
"""How the time of grouping grows with the number of shaders and of requests."""
import math

from .google_benchmark import Report, machine_of
from .markdown import size
from .svg import Drawing, LogScale, apart, plain

WIDTH, LEFT, RIGHT, HEIGHT = 440, 62, 316, 290
NAMES = {"copy-5-bytes": "copy of 5 bytes", "bucket": "bucketing", "radix-sort": "radix sort", "compaction": "compaction",
         "queue-push": "queue push", "cub-radix-sort": "CUB's sort", "thrust-sort-u32": "Thrust's sort"}
LOOKS = {"compaction": ("s1", "disc"), "radix-sort": ("s0", "disc"), "bucket": ("s2", "disc"),
         "queue-push": ("s3", "square"), "cub-radix-sort": ("s4", "square"), "thrust-sort-u32": ("s5", "diamond"),
         "copy-5-bytes": ("s5", "square")}


def series(*paths, run=1):
    """{way: {(shaders, n): µs}} of files whose machine is one, and the context of the first."""
    found, context = {}, None
    for path in paths:
        report = Report(path)
        context = context or report.context
        for ((shaders, way), n, length), time in report.times.items():
            if length == run:
                found.setdefault(way, {})[int(shaders.split()[0]), n] = time
    return found, context


def growth(points, begin, end, size_of):
    """What the time is multiplied by from one point to another, and the power of the size that this is."""
    factor = points[end] / points[begin]
    return factor, math.log(factor) / math.log(size_of(end) / size_of(begin))


def panel(d, top, curves, guides, unit, labels):
    """Curves {way: [(x, y)]} in one pair of axes, named at their ends; guides are (name, [(x, y)])."""
    bottom = top + HEIGHT - 74
    every = [point for points in curves.values() for point in points]
    xs = sorted({x for x, _ in every})
    x = LogScale(xs[0] / 1.12, xs[-1] * 1.12, LEFT, RIGHT)
    low, high = min(y for _, y in every) / 1.3, max(y for _, y in every) * 1.3
    y = LogScale(low, high, bottom, top)
    for value in y.round_values():
        d.line([(LEFT, y(value)), (RIGHT, y(value))], "grid")
        d.text(LEFT - 6, y(value) + 4, plain(value), "small soft", "end")
    for value in xs:
        d.line([(x(value), bottom), (x(value), bottom + 4)], "axis")
        d.text(x(value), bottom + 17, plain(value), "small soft", "middle")
    d.line([(LEFT, top), (LEFT, bottom), (RIGHT, bottom)], "axis")
    d.text(16, (top + bottom) / 2, f"{unit} per request", "", "middle", turned=True)
    d.text((LEFT + RIGHT) / 2, bottom + 35, labels, "", "middle")
    for points in guides.values():
        d.line([(x(a), y(b)) for a, b in points if b <= high], "guide")
    ends = {way: points[-1] for way, points in curves.items()}
    ends.update((name, [p for p in points if p[1] <= high][-1]) for name, points in guides.items())
    for way, points in curves.items():
        look, shape = LOOKS[way]
        d.line([(x(a), y(b)) for a, b in points], f"line {look}")
        for a, b in points:
            d.mark(shape, x(a), y(b), look, f"{NAMES[way]}, {plain(a)}: {b:.3g} {unit}")
    for column in sorted({point[0] for point in ends.values()}):
        here = [name for name, point in ends.items() if point[0] == column]
        for name, place in zip(here, apart([y(ends[name][1]) for name in here], 15)):
            d.text(x(column) + 9, place + 4, NAMES.get(name, name), "small" if name in NAMES else "small soft")


def plot(*paths, n, shaders, run="1"):
    """Over the number of shaders at n requests, and over requests at a number of shaders."""
    found, context = series(*paths, run=int(run))
    n, shaders, order = int(n), int(shaders), "ids at random" if run == "1" else f"runs of {run}"
    ways = [way for way in LOOKS if way in found]
    most = max(time / count for points in found.values() for (_, count), time in points.items())
    unit, factor = ("ps", 1e6) if most < 1e-3 else ("ns", 1e3)
    over_m = {way: [(m, factor * t / n) for (m, count), t in sorted(found[way].items()) if count == n] for way in ways}
    over_n = {way: [(count / (1 << 20), factor * t / count)
                    for (m, count), t in sorted(found[way].items()) if m == shaders] for way in ways}
    guides = {}
    for name, way, law in (("× M", "compaction", lambda m: m), ("× log M", "radix-sort", math.log2)):
        if way in over_m:
            (first, value), every = over_m[way][0], [m for m, _ in over_m["bucket"]]
            guides[name] = [(m, value * law(m) / law(first)) for m in every]
    d = Drawing(WIDTH, 2 * HEIGHT + 26, f"Time of grouping over shaders and requests on one {context['machine']}")
    d.text(8, 20, f"{machine_of(context)}, {order}, {size(n)} requests", "strong")
    panel(d, 34, over_m, guides, unit, "shaders M")
    d.text(8, HEIGHT + 20, f"the same with {shaders} shaders", "strong")
    panel(d, HEIGHT + 34, over_n, {}, unit, "requests N, Mi")
    return d.render()
