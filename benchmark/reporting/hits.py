# SPDX-License-Identifier: Apache-2.0
"""The heterogeneous efficiency of the first hits of paths: the paper's, and that of reports of the path tracer."""
import json

from .markdown import table
from .paper import EFFICIENCY
from .svg import Drawing, apart

WIDTH, LEFT, RIGHT, TOP, BOTTOM = 440, 52, 262, 40, 270
LOOKS = (("s5", "square"), ("s0", "disc"), ("s1", "diamond"), ("s2", "disc"), ("s3", "square"), ("s4", "disc"))


def bounces_of(path, schedule):
    """(scene, its first bounces by a schedule) of a report of the path tracer, or of several in one file."""
    with open(path, encoding="utf-8") as file:
        report = json.load(file)
    for one in report.get("reports", [report]):
        bounces = {run["schedule"]: run["bounces"] for run in one["schedules"]}[schedule]
        yield one["scene"].split(".")[0], bounces[:len(EFFICIENCY)]


def hits(path, schedule="implicit"):
    """(scene, its heterogeneous efficiency hit by hit) of the same."""
    for scene, bounces in bounces_of(path, schedule):
        yield scene, [bounce["efficiency"] for bounce in bounces]


def efficiency(*paths):
    """Of the paper, and of reports of the path tracer: as requests come, and grouped."""
    rows = [["the paper"] + [f"{share} %" for share in EFFICIENCY]]
    for path in paths:
        for schedule, words in (("implicit", "as they come"), ("bucket+explicit", "grouped")):
            rows += [[f"`{scene}`, {words}"] + [f"{100 * share:.0f} %" for share in shares]
                     for scene, shares in hits(path, schedule)]
        rows += [[f"`{scene}`, paths left"] +
                 [f"{100 * bounce['requests'] / bounces[0]['requests']:.0f} %" for bounce in bounces]
                 for scene, bounces in bounces_of(path, "implicit")]
    return table([""] + [f"hit {k + 1}" for k in range(len(EFFICIENCY))], rows)


def plot(*paths):
    """Requests as they come."""
    curves = [("the paper", list(EFFICIENCY))]
    curves += [(scene, [100 * share for share in shares]) for path in paths for scene, shares in hits(path)]
    d = Drawing(WIDTH, BOTTOM + 44, "Heterogeneous efficiency of the first hits, in the paper and in scenes of ours")

    def x(hit):
        return LEFT + 14 + (RIGHT - LEFT - 28) * hit / (len(EFFICIENCY) - 1)

    def y(share):
        return BOTTOM + (TOP - BOTTOM) * share / 100
    d.text(8, 20, "Heterogeneous efficiency, requests as they come", "strong")
    for share in range(0, 101, 25):
        d.line([(LEFT, y(share)), (RIGHT, y(share))], "grid")
        d.text(LEFT - 6, y(share) + 4, f"{share} %", "small soft", "end")
    for hit in range(len(EFFICIENCY)):
        d.text(x(hit), BOTTOM + 17, f"{hit + 1}", "small soft", "middle")
    d.text((LEFT + RIGHT) / 2, BOTTOM + 36, "hit", "", "middle")
    ends = apart([y(shares[-1]) for _, shares in curves], 15)
    for (name, shares), (look, shape), end in zip(curves, LOOKS, ends):
        d.line([(x(hit), y(share)) for hit, share in enumerate(shares)], f"line {look}")
        for hit, share in enumerate(shares):
            d.mark(shape, x(hit), y(share), look, f"{name}, hit {hit + 1}: {share:.0f} %")
        d.text(RIGHT + 6, end + 4, name, "small")
    return d.render()
