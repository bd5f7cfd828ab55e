# SPDX-License-Identifier: Apache-2.0
"""The paper's five scenes by schedule, over unsorted implicit serialisation."""
import math

from .google_benchmark import Report, machine_of
from .markdown import size
from .paper import LATER, SCENES, SCHEDULES, unsorted
from .schedules import Cells
from .svg import Drawing, LogScale, plain

WIDTH, LEFT, RIGHT = 440, 138, 426
TOP, ROW, TITLE, GAP = 116, 14, 21, 9


def plot(path, n, kind="index", runs="1,32"):
    """Discs and diamonds for two lengths of runs, thin lines for what lay between the tenths of the calls."""
    report, n, runs = Report(path), int(n), [int(run) for run in runs.split(",")]
    cells, names = Cells(report.times), SCHEDULES + LATER
    ranges = Cells(report.ranges)

    def ratios(scene, run, name):
        rows = cells.rows[scene, n, run][kind]
        least, most = ranges.rows[scene, n, run][kind][name]
        return unsorted(rows) / rows[name], unsorted(rows) / most, unsorted(rows) / least
    found = {(s.name, run, name): ratios(s.name, run, name) for s in SCENES for run in runs for name in names}
    every = [value for three in found.values() for value in three] + [v for s in SCENES for v in s.speedup()]
    low, high = (2.0 ** f(math.log2(v) + d) for f, v, d in ((math.floor, min(every), -.1), (math.ceil, max(every), .1)))
    x = LogScale(low, high, LEFT, RIGHT)
    block = TITLE + ROW * len(names) + GAP
    bottom = TOP + block * len(SCENES)
    machine = machine_of(report.context)
    d = Drawing(WIDTH, bottom + 42, f"Speedup of schedules over unsorted implicit serialisation on one {machine}")

    d.text(8, 20, f"{machine}, {size(n)} requests, {kind} shaders", "strong")
    for k, (shape, words) in enumerate(zip(("disc", "diamond"), runs)):
        d.mark(shape, 16 + 205 * k, 37, "s5")
        d.text(26 + 205 * k, 41, "ids at random (run 1)" if words == 1 else f"runs of {words} on average")
    for k, words in enumerate(("the paper's schedules", "later schedules")):
        d.rect(11 + 205 * k, 51, 11, 11, f"fill s{k}")
        d.text(26 + 205 * k, 61, words)
    d.rect(8, 70, 16, 12, "band")
    d.text(29, 80, "what the paper measured, scene by scene")
    d.line([(8, 96), (24, 96)], "thin s5")
    d.text(29, 100, "spread of the measurements")

    for value in x.doublings():
        d.line([(x(value), TOP), (x(value), bottom)], "axis" if value == 1 else "grid")
        if len(x.doublings()) <= 8 or math.log2(value) % 2 == 0:
            d.text(x(value), bottom + 15, plain(value), "small soft", "middle")
    d.text((LEFT + RIGHT) / 2, bottom + 34, "times as fast as unsorted implicit", "", "middle")
    for k, scene in enumerate(SCENES):
        y = TOP + block * k + TITLE
        slow, fast = scene.speedup()
        d.rect(x(slow), y - 2, max(x(fast) - x(slow), 2), ROW * len(names), "band")
        d.text(8, y - 7, scene.name, "strong")
        for row, name in enumerate(names):
            middle, look = y + ROW * row + ROW / 2 - 2, f"s{0 if name in SCHEDULES else 1}"
            d.text(LEFT - 8, middle + 4, name, "small", "end")
            for run, shape in reversed(list(zip(runs, ("disc", "diamond")))):
                value, least, most = found[scene.name, run, name]
                d.line([(x(least), middle), (x(most), middle)], f"thin {look}")
                d.mark(shape, x(value), middle, look, f"{name}, run {run}: {value:.2f}")
    return d.render()
