#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tables and plots of what benchmark/accuracy.py has measured.

    benchmark/accuracy_report.py table RESULT.jsonl
    benchmark/accuracy_report.py plot PLOT.svg RESULT.jsonl...
    benchmark/accuracy_report.py schedules RESULT.jsonl REPORT.json...

`table` prints Markdown: for every scene what each setting takes and gives, the slope of the convergence, and what
a digit costs. `plot` draws error against time, a panel for each scene and file, with the settings that no other beats in
both joined by a line. `schedules` takes reports of `path_tracer --schedule all` over the same scenes and prints
the seconds in which each schedule reaches a relative error of 1 %: as schedules change no bit, that is its time per
sample times the samples which that takes.
"""
import json
import math
import pathlib
import sys

from reporting import markdown
from reporting.svg import Drawing, LogScale, plain


def read(path):
    lines = pathlib.Path(path).read_text(encoding="utf-8").splitlines()
    scenes = {}
    for result in map(json.loads, lines):
        scenes.setdefault(result["scene"], []).append(result)
    return scenes


def percent(share):
    return f"{100 * share:.0f} %" if share >= 0.1 else f"{100 * share:.2g} %"


def name(result):
    return ", ".join(f"{k} {v}" for k, v in result["changes"].items()) or "the defaults"


def only_samples_differ(results):
    """(samples, result) of the settings that differ from the base in samples alone, in their order."""
    return sorted(((r["setting"]["spp"], r) for r in results if set(r["changes"]) <= {"spp"}), key=lambda pair: pair[0])


def line_through(points):
    """Slope and value at 0 of the least-squares line."""
    n = len(points)
    mx, my = sum(x for x, _ in points) / n, sum(y for _, y in points) / n
    slope = sum((x - mx) * (y - my) for x, y in points) / sum((x - mx) ** 2 for x, _ in points)
    return slope, my - slope * mx


def samples_for(results, error):
    """The samples per pixel that bring the variance to error^2: it is that of one sample over their number."""
    per_sample = [spp * r["relative_variance"] for spp, r in only_samples_differ(results)]
    return sorted(per_sample)[len(per_sample) // 2] / error ** 2


def seconds_for(results, spp):
    slope, fixed = line_through([(spp, r["seconds"]) for spp, r in only_samples_differ(results)])
    return max(fixed, 0) + slope * spp


def table(results):
    """What was measured, what each setting of one scene takes and gives, and what an error costs."""
    first = results[0]
    base = next((r for r in results if not r["changes"]), first)
    rows = []
    for r in sorted(results, key=lambda r: (len(r["changes"]), name(r).split()[0], r["seconds"])):
        rounding = f"{r['rounding']['rms']:.1g} ({r['rounding']['median']:.0e})" if r.get("rounding") else ""
        rows.append([name(r), f"{r['seconds']:.3f}", f"{100 * r['seconds_spread'] / r['seconds']:.0f} %",
                     percent(math.sqrt(r["relative_mse"])), f"{r['relative_variance']:.2g}",
                     f"{r['relative_bias2']:.1g}", f"{r['p999']:.2g}", "" if r["flip"] is None else f"{r['flip']:.3f}",
                     rounding, f"{r['efficiency'] / base['efficiency']:.2f}"])
    slope, _ = line_through([(math.log(spp), math.log(r["relative_variance"]))
                             for spp, r in only_samples_differ(results)])
    costs = [[f"{100 * error:g} %", f"{samples_for(results, error):.3g}",
              f"{seconds_for(results, samples_for(results, error)):.3g}"] for error in (0.1, 0.01, 0.001)]
    return "\n\n".join([
        f"{first['machine']}, commit {first['commit']}, backend {first['backend']}, {first['width']} x {first['height']}, "
        f"{first['seeds']} seeds. Reference: {first['reference_spp']} samples, its own relative error "
        f"{percent(math.sqrt(first['reference_mse']))}.",
        markdown.table(["setting", "seconds", "spread", "error", "variance", "bias²", "99.9 % below", "FLIP", "rounding",
                        "efficiency"], rows),
        f"The variance falls with the samples to the power of {slope:.2f}.",
        markdown.table(["relative error", "samples per pixel", "seconds"], costs)])


def text(path):
    """The tables of all scenes; a heading for each where there are several."""
    scenes = read(path)
    if len(scenes) == 1:
        return "\n\n".join(f"`{scene}`, {table(results)}" for scene, results in scenes.items())
    return "\n\n".join(f"### {scene}\n\n{table(results)}" for scene, results in scenes.items())


def front(results):
    """The results that no other beats in time and error, fastest first."""
    found, least = [], math.inf
    for r in sorted(results, key=lambda r: r["seconds"]):
        if r["relative_mse"] < least:
            least = r["relative_mse"]
            found.append(r)
    return found


def panel(d, title, results, top, height):
    """Error over seconds of every setting of a scene, and a line through those that no other beats in both."""
    left, right, bottom = 58, 424, top + height - 66
    times, errors = [r["seconds"] for r in results], [math.sqrt(r["relative_mse"]) for r in results]
    x = LogScale(min(times) / 1.15, max(times) * 1.15, left, right)
    y = LogScale(min(errors) / 1.15, max(errors) * 1.15, bottom, top)
    best = front(results)
    d.text(8, top - 14, title, "strong")
    for value in x.round_values():
        d.line([(x(value), top), (x(value), bottom)], "grid")
        d.text(x(value), bottom + 17, plain(value), "small soft", "middle")
    for value in y.round_values():
        d.line([(left, y(value)), (right, y(value))], "grid")
        d.text(left - 6, y(value) + 4, plain(100 * value), "small soft", "end")
    d.text((left + right) / 2, bottom + 36, "seconds", "", "middle")
    d.text(16, (top + bottom) / 2, "relative error, %", "", "middle", turned=True)
    d.line([(x(r["seconds"]), y(math.sqrt(r["relative_mse"]))) for r in best], "line s0")
    for r in sorted(results, key=lambda r: r in best):
        error = math.sqrt(r["relative_mse"])
        d.mark("disc" if r in best else "diamond", x(r["seconds"]), y(error), "s0" if r in best else "s4",
               f"{name(r)}: {percent(error)} in {r['seconds']:.3g} s")


def plot(files):
    panels = [(f"{scene}, {results[0]['machine']}, {results[0]['backend']}", results)
              for file in files for scene, results in read(file).items()]
    height = 300
    d = Drawing(440, height * len(panels) + 44, "Relative error over seconds of the path tracer's settings")
    d.mark("disc", 16, 16, "s0")
    d.text(26, 20, "no other beats it in both")
    d.mark("diamond", 221, 16, "s4")
    d.text(231, 20, "another is faster and nearer")
    for k, (title, results) in enumerate(panels):
        panel(d, title, results, height * k + 66, height)
    return d.render()


def schedules(path, reports):
    scenes = read(path)
    rows, names = [], []
    for report in reports:
        run = json.loads(pathlib.Path(report).read_text(encoding="utf-8"))
        scene = pathlib.Path(run["scene"]).stem
        spp = samples_for(scenes[scene], 0.01)
        names = [s["schedule"] for s in run["schedules"]]
        rows.append([scene, f"{spp:.3g}"] +
                    [f"{s['seconds'] / run['settings']['spp'] * spp:.3g}" for s in run["schedules"]])
    return markdown.table(["scene", "samples"] + [f"`{n}`" for n in names], rows)


def main(arguments):
    if arguments[:1] == ["table"] and len(arguments) == 2:
        print(text(arguments[1]))
    elif arguments[:1] == ["plot"] and len(arguments) > 2:
        pathlib.Path(arguments[1]).write_text(plot(arguments[2:]), encoding="utf-8")
    elif arguments[:1] == ["schedules"] and len(arguments) > 2:
        print(schedules(arguments[1], arguments[2:]))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
