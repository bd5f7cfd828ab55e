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


def measured(path):
    """The file, and milliseconds by (scene, schedule), run by run: of shading with grouping a sample of each pixel, and
    of all of a picture."""
    result, found, pictures = read(path), {}, {}
    samples = result["reports"][0]["settings"]["spp"]
    for report in result["reports"]:
        for run in report["schedules"]:
            key = report["scene"], run["schedule"]
            found.setdefault(key, []).append(sum(b["total_ms"] for b in run["bounces"]) / samples)
            pictures.setdefault(key, []).append(1e3 * run["seconds"] / samples)
    return result, found, pictures


def speedups(path, names):
    """{scene: how many times as fast as unsorted implicit serialisation the best of some schedules shades it, and
    whether the runs of the two lie apart}"""
    _, found, _ = measured(path)
    result = {}
    for scene in dict.fromkeys(scene for scene, _ in found):
        best = min((found[scene, name] for name in names), key=statistics.median)
        unsorted = found[scene, "implicit"]
        result[scene] = (statistics.median(unsorted) / statistics.median(best),
                         max(best) < min(unsorted) or max(unsorted) < min(best))
    return result


def times(path):
    """Every schedule, medians; and what the best gains over unsorted implicit serialisation."""
    result, found, pictures = measured(path)
    middle = {key: statistics.median(values) for key, values in found.items()}
    spread = {key: (max(values) - min(values)) / middle[key] for key, values in found.items()}
    scenes, names = (list(dict.fromkeys(key[k] for key in found)) for k in (0, 1))
    rows = [[f"`{name}`"] + [f"{in_words(middle[s, name])} ± {50 * spread[s, name]:.0f} %" for s in scenes]
            for name in names]
    for words, of in (("", names), ("the paper's ", [name for name in names if name in SCHEDULES])):
        best = [min(of, key=lambda name, s=s: middle[s, name]) for s in scenes]
        rows.append([f"*{words}fastest*"] + [f"`{name}`" for name in best])
        rows.append(["*as fast as `implicit`*"] + [f"{middle[s, 'implicit'] / middle[s, name]:.2f} times"
                                                   for s, name in zip(scenes, best)])
    rows.append(["*that in the paper*"] + [scene.words() for scene in SCENES])
    rows.append(["*of the picture's time*"] + [
        f"{100 * middle[s, 'implicit'] / statistics.median(pictures[s, 'implicit']):.0f} %" for s in scenes])
    settings, runs = result["reports"][0]["settings"], len(next(iter(found.values())))
    return "\n\n".join([
        ", ".join([result["machine"], f"commit {result['commit']}", f"{settings['width']} x {settings['height']}"] +
                  [f"{key} {settings[key]}" for key in ("backend", "spp", "max_depth")] + [f"{runs} runs"]),
        table(["schedule"] + scenes, rows)])
