# SPDX-License-Identifier: Apache-2.0
"""Figures for sentences: each is one number or a span of cells, from raw data, and never more than a few words.

`form` says what becomes of the ratios that a view has found: `times` "1.2 to 3.4", `hundredths` "1.21 to 3.40", `digits`
"1.21 to 34", `whole` "1 to 3", `ahead` the per cent above 1, "21 to 240 %", `less` those below 1, `share` the ratio in per
cent, and `count` how many of them are above 1.
`pick` takes `least`, `most` or the geometric `mean` of them instead of the span.
"""
import accuracy_report

from .google_benchmark import Report, geometric_mean
from .hits import hits
from .paper import GROUPINGS, LATER, SCHEDULES, unsorted
from .scenes import Timed
from .schedules import ORACLES, Cells

SCALED = {"ahead": lambda ratio: 100 * (ratio - 1), "less": lambda ratio: 100 * (1 - ratio),
          "share": lambda ratio: 100 * ratio}
GROUPS = {"best": SCHEDULES + LATER, "any": ["implicit", *SCHEDULES, *LATER], "paper": SCHEDULES, "oracle": list(ORACLES)}


def in_form(value, form):
    digits = {"times": 1, "hundredths": 2, "digits": 2 if value < 10 else 0}.get(form, 0)
    return f"{value:.{digits}f}"


def words(ratios, form, pick=""):
    """The ratios in the fewest words."""
    if not ratios:
        raise ValueError("no cell is like that")
    if form == "count":
        return f"{sum(ratio > 1 for ratio in ratios)} of {len(ratios)}"
    if pick:
        ratios = [{"least": min, "most": max, "mean": geometric_mean}[pick](ratios)]
    values = sorted(map(SCALED.get(form, float), ratios))
    ends = list(dict.fromkeys(in_form(value, form) for value in (values[0], values[-1])))
    return " to ".join(ends) + (" %" if form in SCALED else "")


def listed(text):
    return [word.strip() for word in text.split(",") if word.strip()]


def matches(shaders, sets):
    """Whether a set is named, or is one of the `simple` ones or of the `others`."""
    return not sets or shaders in sets or ("simple" if shaders.endswith(" simple") else "others") in sets


def least(times, name):
    """The time of a schedule, of the plain switch for `unsorted`, or of the fastest of a group or of some names."""
    if name == "unsorted":
        return unsorted(times)
    return min(times[one] for one in GROUPS.get(name, listed(name)))


def cells_of(path, kind, sets, n, runs):
    """(set, {schedule: time}) of all cells of benchmark_schedules that match."""
    for (shaders, count, run), kinds in Cells(Report(path).times).rows.items():
        if matches(shaders, listed(sets)) and str(count) in (listed(n) or [str(count)]) \
                and str(run) in (listed(runs) or [str(run)]):
            for name in listed(kind):
                yield shaders, kinds[name]


def gain(*paths, schedule, over="unsorted", kind="index", sets="", n="", runs="", form="times", pick=""):
    """How many times as fast one schedule is as another, over all cells that match. A * stands for every grouping."""
    found = []
    for path in paths:
        for _, times in cells_of(path, kind, sets, n, runs):
            for grouping in GROUPINGS if "*" in schedule else [""]:
                found.append(least(times, over.replace("*", grouping)) / least(times, schedule.replace("*", grouping)))
    return words(found, form, pick)


def best_in(*paths, names, kind="index", sets="", n="", runs=""):
    """In how many cells one of these schedules is the fastest of all."""
    won = [min(GROUPS["any"], key=lambda name, times=times: times[name]) in listed(names)
           for path in paths for _, times in cells_of(path, kind, sets, n, runs)]
    return f"{sum(won)} of {len(won)}"


def microseconds(path, schedule, sets, n, runs, kind="index"):
    return words([least(times, schedule) for _, times in cells_of(path, kind, sets, n, runs)], "whole") + " µs"


def repeated(path, times):
    """How many cells have so many repetitions."""
    counts = Report(path).repetitions.values()
    return f"{sum(count == int(times) for count in counts)} of {len(counts)}"


def scene_gain(path, schedule="best", over="implicit", what="shading", scenes="", form="times", pick=""):
    """The same of the path tracer's scenes: of shading, or of a whole picture."""
    timed = Timed(path)

    def time(scene, names):
        return timed.middle(scene, timed.fastest(scene, GROUPS.get(names, listed(names))), what)
    return words([time(s, over) / time(s, schedule) for s in listed(scenes) or timed.scenes], form, pick)


def scene_share(path, schedule="implicit"):
    """The share of shading in each picture's time, scene by scene."""
    timed = Timed(path)
    shares = [f"{100 * timed.share(scene, schedule):.0f}" for scene in timed.scenes]
    return ", ".join(shares[:-1]) + f" and {shares[-1]} %"


def hit_efficiency(*paths, hit, schedule="implicit", scenes=""):
    """The efficiency of requests at a hit, least to most of the scenes."""
    return words([shares[int(hit) - 1] for path in paths for scene, shares in hits(path, schedule)
                  if scene in (listed(scenes) or [scene])], "share")


def accuracy(path, setting, what, spp="64", scenes="", form="hundredths", pick=""):
    """What a setting takes or gives next to the defaults with as many samples: its time, efficiency or mean square error
    over theirs, or its bias."""
    found = accuracy_report.of_setting(path, setting, what, int(spp))
    return words([value for scene, value in found.items() if scene in (listed(scenes) or [scene])], form, pick)


def equal_error(path, reports, schedule, over="implicit", scenes="", form="times", pick=""):
    """How many times as fast one schedule comes to an error as another: as no schedule changes a bit, that is the ratio
    of their times. The fastest of all is `best`."""
    found = accuracy_report.medians(reports)
    return words([least(found[scene], over) / least(found[scene], schedule)
                  for scene in listed(scenes) or found], form, pick)
