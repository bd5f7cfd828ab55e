# SPDX-License-Identifier: Apache-2.0
"""The scenes with as many shaders as the paper's: what benchmark/scenes.py has counted and timed."""
import json
import statistics

from .hits import hits
from .markdown import table
from .paper import EFFICIENCY, SCENES, SCHEDULES

ORDERS = {"implicit": "as they come", "local-bitonic": "sorted in blocks of 256", "bucket+explicit": "grouped"}
PROCEDURAL = ("marble", "wood")


def in_words(milliseconds):
    """Whole ones, and of less than ten the hundredths."""
    return f"{milliseconds:.0f}" if milliseconds >= 10 else f"{milliseconds:.2f}"


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def bounces_of(report, schedule):
    return next(run["bounces"] for run in report["schedules"] if run["schedule"] == schedule)


def shaders(path):
    """Which shaders each scene runs, and which share of the requests is of each."""
    rows = []
    for report in read(path)["reports"]:
        total = {}
        for bounce in bounces_of(report, "implicit"):
            for name, count in bounce["first_batch_by_shader"].items():
                total[name] = total.get(name, 0) + count
        shares = sorted(total.items(), key=lambda item: (item[0] in PROCEDURAL, -item[1]))
        every = sum(total.values())
        rows.append([report["scene"], len(total), ", ".join(
            f"{'the sky' if name == 'miss' else name} {100 * count / every:.0f} %" for name, count in shares)])
    return table(["scene", "shaders that run", "their shares of the requests of four hits"], rows)


def efficiency(path):
    """Hit by hit, as requests come and in other orders, and how many of the paths are left."""
    rows = [["the paper", ""] + [f"{share} %" for share in EFFICIENCY]]
    shares = {schedule: dict(hits(path, schedule)) for schedule in ORDERS}
    for report in read(path)["reports"]:
        for schedule, words in ORDERS.items():
            rows.append([report["scene"] if schedule == "implicit" else "", words] +
                        [f"{100 * share:.0f} %" for share in shares[schedule][report["scene"]]])
        paths = report["settings"]["width"] * report["settings"]["height"] * report["settings"]["spp"]
        rows.append(["", "*paths that are left*"] +
                    [f"*{100 * b['requests'] / paths:.0f} %*" for b in bounces_of(report, "implicit")[:len(EFFICIENCY)]])
    return table(["scene", "requests"] + [f"hit {k + 1}" for k in range(len(EFFICIENCY))], rows)


class Timed:
    """A file of benchmark/scenes.py: milliseconds of shading with grouping, of one sample of every pixel, run by run, by
    (scene, schedule). All else in a picture's time, above all tracing, is the same work for every schedule: `rest` is its
    median over the runs of all but the first schedule, which pays for the start-up of the program."""

    def __init__(self, path):
        self.result, self.shading, others = read(path), {}, {}
        samples = self.result["reports"][0]["settings"]["spp"]
        for report in self.result["reports"]:
            for place, run in enumerate(report["schedules"]):
                shading = sum(b["total_ms"] for b in run["bounces"]) / samples
                self.shading.setdefault((report["scene"], run["schedule"]), []).append(shading)
                if place > 0:
                    others.setdefault(report["scene"], []).append(1e3 * run["seconds"] / samples - shading)
        self.scenes, self.schedules = (list(dict.fromkeys(key[k] for key in self.shading)) for k in (0, 1))
        self.rest = {scene: statistics.median(values) for scene, values in others.items()}

    def middle(self, scene, schedule, what="shading"):
        """The median of shading, or of a whole picture, of which the part that is not shading is `rest`."""
        return statistics.median(self.shading[scene, schedule]) + {"shading": 0, "picture": self.rest[scene]}[what]

    def share(self, scene, schedule):
        return self.middle(scene, schedule) / self.middle(scene, schedule, "picture")

    def fastest(self, scene, names):
        return min(names, key=lambda name: self.middle(scene, name))

    def apart(self, scene, one, other):
        """Whether the runs of two schedules do not overlap."""
        one, other = self.shading[scene, one], self.shading[scene, other]
        return max(one) < min(other) or max(other) < min(one)

    def gain(self, scene, names, what="shading"):
        """How many times as fast as unsorted implicit serialisation the fastest of some schedules is."""
        return self.middle(scene, "implicit", what) / self.middle(scene, self.fastest(scene, names), what)


def speedups(path, names):
    """{scene: how many times as fast as unsorted implicit serialisation the best of some schedules shades it, and
    whether the runs of the two lie apart}"""
    timed = Timed(path)
    return {s: (timed.gain(s, names), timed.apart(s, "implicit", timed.fastest(s, names))) for s in timed.scenes}


def gains(*paths, heads):
    """What the fastest schedule gains in each scene on some machines: of shading, and of the whole picture."""
    machines, rows = [Timed(path) for path in paths], []
    for scene in machines[0].scenes:
        row = [scene]
        for timed in machines:
            sure = timed.apart(scene, "implicit", timed.fastest(scene, timed.schedules))
            row += [f"{timed.gain(scene, timed.schedules, what):.2f}" if sure else "within the spread"
                    for what in ("shading", "picture")]
        rows.append(row)
    return table(["shaders of the scene"] + [f"{head}: {what}" for head in heads.split(",")
                                             for what in ("shading", "whole picture")], rows)


def times(path):
    """Every schedule, medians; and what the best gains over unsorted implicit serialisation."""
    timed = Timed(path)
    scenes, names = timed.scenes, timed.schedules

    def cell(scene, name):
        runs, middle = timed.shading[scene, name], timed.middle(scene, name)
        return f"{in_words(middle)} ± {50 * (max(runs) - min(runs)) / middle:.0f} %"
    rows = [[f"`{name}`"] + [cell(s, name) for s in scenes] for name in names]
    for words, of in (("", names), ("the paper's ", [name for name in names if name in SCHEDULES])):
        rows.append([f"*{words}fastest*"] + [f"`{timed.fastest(s, of)}`" for s in scenes])
        for what, of_what in (("shading", "shading"), ("picture", "the picture")):
            rows.append([f"*speedup of {of_what}*"] +
                        [f"{timed.gain(s, of, what):.2f}" for s in scenes])
    rows.append(["*in the paper*"] + [scene.words() for scene in SCENES])
    rows.append(["*the rest of a picture, ms*"] + [in_words(timed.rest[s]) for s in scenes])
    rows.append(["*share of shading, by `implicit`*"] + [f"{100 * timed.share(s, 'implicit'):.0f} %" for s in scenes])
    settings, runs = timed.result["reports"][0]["settings"], len(timed.shading[scenes[0], "implicit"])
    result = timed.result
    return "\n\n".join([
        ", ".join([result["machine"], f"commit {result['commit']}", f"{settings['width']} x {settings['height']}"] +
                  [f"{key} {settings[key]}" for key in ("backend", "spp", "max_depth")] + [f"{runs} runs"]),
        table(["schedule"] + scenes, rows)])
