#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tables and plots of what benchmark/accuracy.py has measured.

    benchmark/accuracy_report.py table RESULT.jsonl
    benchmark/accuracy_report.py knobs RESULT.jsonl SPP
    benchmark/accuracy_report.py digits RESULT.jsonl...
    benchmark/accuracy_report.py plot PLOT.svg RESULT.jsonl...
    benchmark/accuracy_report.py schedules RESULT.jsonl REPORTS.jsonl

`table` prints Markdown: for every scene what each setting takes and gives. `knobs` sets the settings with SPP samples side
by side over scenes, and `digits` what a digit costs. `plot` draws error against time, a panel for each scene and file, with
the settings that no other beats in both joined by a line. `schedules` takes reports of `gltf_path_tracer --schedule all` over the
same scenes, one a line, and prints the seconds in which each schedule reaches a relative error of 1 %: as schedules change
no bit, that is its time per sample times the samples which that takes.
"""
import json
import math
import pathlib
import statistics
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


def seconds_of_samples(results):
    """Seconds per sample, and those that no sample takes."""
    slope, fixed = line_through([(spp, r["seconds"]) for spp, r in only_samples_differ(results)])
    return slope, max(fixed, 0)


def convergence(results):
    """The power of the samples with which the variance falls: -1, but for what few samples find."""
    return line_through([(math.log(spp), math.log(r["relative_variance"])) for spp, r in only_samples_differ(results)])[0]


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
    return "\n\n".join([
        f"{first['machine']}, commit {first['commit']}, backend {first['backend']}, {first['width']} x {first['height']}, "
        f"{first['seeds']} seeds. Reference: {first['reference_spp']} samples, its own relative error "
        f"{percent(math.sqrt(first['reference_mse']))}.",
        markdown.table(["setting", "seconds", "spread", "error", "variance", "bias²", "99.9 % below", "FLIP", "rounding",
                        "efficiency"], rows)])


def text(path):
    """The tables of all scenes; a heading for each where there are several."""
    scenes = read(path)
    if len(scenes) == 1:
        return "\n\n".join(f"`{scene}`, {table(results)}" for scene, results in scenes.items())
    return "\n\n".join(f"## {scene}\n\n{table(results)}" for scene, results in scenes.items())


def bias(r):
    """The root of bias², where it stands out of what noise leaves of it; about 0 otherwise."""
    least = 0.05 * r["relative_variance"] / r["seeds"] + r["reference_mse"]
    return percent(math.sqrt(r["relative_bias2"])) if r["relative_bias2"] > least else "-"


def knobs(path, spp):
    """Settings that have these samples, over the one that changes nothing else: time, efficiency, and bias."""
    scenes = {scene: {name(r): r for r in results if r["setting"]["spp"] == int(spp)}
              for scene, results in read(path).items()}
    base = {scene: next(r for r in found.values() if set(r["changes"]) <= {"spp"}) for scene, found in scenes.items()}
    settings = [s for s, r in next(iter(scenes.values())).items() if not set(r["changes"]) <= {"spp"}]
    rows = []
    for setting in settings:
        cells = [setting.removeprefix(f"spp {spp}, ")]
        for scene, found in scenes.items():
            r, b = found.get(setting), base[scene]
            cells.append(f"{r['seconds'] / b['seconds']:.2f} / {r['efficiency'] / b['efficiency']:.2f} / {bias(r)}" if r else "")
        rows.append(cells)
    return markdown.table([f"with {spp} samples", *scenes], rows)


def digits(*paths):
    """What an error costs on each machine and scene."""
    rows = []
    for path in paths:
        for scene, results in read(path).items():
            slope, fixed = seconds_of_samples(results)
            samples = {error: samples_for(results, error) for error in (0.1, 0.01, 0.001)}
            rows.append([scene, results[0]["machine"], f"{convergence(results):.2f}", f"{samples[0.01]:.2g}", f"{fixed:.2g}"] +
                        [f"{fixed + slope * n:.3g}" for n in samples.values()])
    return markdown.table(["scene", "machine", "slope of the variance", "samples for 1 %", "fixed, s", "10 %, s", "1 %, s",
                           "0.1 %, s"], rows)


def front(results):
    """The results that no other beats in time and error, fastest first."""
    found, least = [], math.inf
    for r in sorted(results, key=lambda r: r["seconds"]):
        if r["relative_mse"] < least:
            least = r["relative_mse"]
            found.append(r)
    return found


AXES, ROW = 300, 17  # heights of a panel's axes with their words, and of a row of its key


def keys(places, gap=16):
    """Numbers of points from 1, [(first, last, place)]: points that lie on each other share one label."""
    found = []
    for k, (x, y) in enumerate(places, start=1):
        if found and abs(x - found[-1][2][0]) < gap and abs(y - found[-1][2][1]) < gap:
            found[-1] = found[-1][0], k, found[-1][2]
        else:
            found.append((k, k, (x, y)))
    return found


def panel(d, title, results, top):
    """Error over seconds of every setting of a scene, a line through those that no other beats in both, and a key to
    these."""
    left, right, bottom = 62, 424, top + AXES - 66
    times, errors = [r["seconds"] for r in results], [math.sqrt(r["relative_mse"]) for r in results]
    x = LogScale(min(times) / 1.3, max(times) * 1.15, left, right)
    y = LogScale(min(errors) / 1.5, max(errors) * 1.15, bottom, top)
    best = front(results)
    d.text(8, top - 14, title, "strong")
    d.text(right, top - 14, results[0]["machine"], "small soft", "end")
    for value in x.round_values():
        d.line([(x(value), top), (x(value), bottom)], "grid")
        d.text(x(value), bottom + 17, plain(value), "small soft", "middle")
    for value in y.round_values():
        d.line([(left, y(value)), (right, y(value))], "grid")
        d.text(left - 6, y(value) + 4, plain(100 * value), "small soft", "end")
    d.text((left + right) / 2, bottom + 36, "seconds", "", "middle")
    d.text(16, (top + bottom) / 2, "relative error, %", "", "middle", turned=True)

    def place(r):
        return x(r["seconds"]), y(math.sqrt(r["relative_mse"]))
    d.line([place(r) for r in best], "line s0")
    for r in sorted(results, key=lambda r: r in best):
        error = math.sqrt(r["relative_mse"])
        d.mark("disc" if r in best else "diamond", *place(r), "s0" if r in best else "s4",
               f"{name(r)}: {percent(error)} in {r['seconds']:.3g} s")
    for first, last, (px, py) in keys([place(r) for r in best]):
        d.text(px - 2, py + 18, f"{first}" if first == last else f"{first}-{last}", "small", "end")
    for k, r in enumerate(best):
        d.text(left, bottom + 58 + ROW * k, f"{k + 1}", "small soft", "end")
        d.text(left + 8, bottom + 58 + ROW * k, name(r), "small")


def plot(files):
    panels = [pair for file in files for pair in read(file).items()]
    heights = [AXES + ROW * len(front(results)) + 14 for _, results in panels]
    d = Drawing(440, sum(heights) + 64, "Relative error over seconds of the path tracer's settings")
    d.mark("disc", 16, 16, "s0")
    d.text(26, 20, "no other setting is faster and nearer (named below)", "small")
    d.mark("diamond", 16, 36, "s4")
    d.text(26, 40, "another one is (named in the tables)", "small")
    for k, (title, results) in enumerate(panels):
        panel(d, title, results, sum(heights[:k]) + 86)
    return d.render()


def seconds_per_sample(reports):
    """{scene: {schedule: seconds of a sample, run by run}}"""
    found = {}
    for report in map(json.loads, pathlib.Path(reports).read_text(encoding="utf-8").splitlines()):
        times = found.setdefault(pathlib.Path(report["scene"]).stem, {})
        for run in report["schedules"]:
            times.setdefault(run["schedule"], []).append(run["seconds"] / report["settings"]["spp"])
    return found


def medians(reports):
    return {scene: {name: statistics.median(several) for name, several in times.items()}
            for scene, times in seconds_per_sample(reports).items()}


def schedules(path, reports):
    """Medians over a scene's reports; the spread is the largest of any schedule."""
    scenes, middle, rows, names = read(path), medians(reports), [], []
    for scene, times in seconds_per_sample(reports).items():
        spp, names = samples_for(scenes[scene], 0.01), list(times)
        spread = max((max(t) - min(t)) / middle[scene][n] for n, t in times.items())
        best = min(middle[scene].values())
        rows.append([scene, f"{spp:.3g}", len(times[names[0]]), percent(spread)] +
                    [f"**{m * spp:.3g}**" if m == best else f"{m * spp:.3g}" for m in middle[scene].values()])
    return markdown.table(["scene", "samples", "runs", "spread"] + [f"`{n}`" for n in names], rows)


def of_setting(path, setting, what, spp):
    """{scene: the time, efficiency or mean square error of a setting over the defaults', all with these samples; or its
    bias, if it is found in the noise}"""
    found = {}
    for scene, results in read(path).items():
        same = {name(r).removeprefix(f"spp {spp}, "): r for r in results if r["setting"]["spp"] == spp}
        base = next(r for r in same.values() if set(r["changes"]) <= {"spp"})
        if (r := same.get(setting)) is None:
            continue
        if what == "bias":
            if bias(r) != "-":
                found[scene] = math.sqrt(r["relative_bias2"])
        else:
            key = {"time": "seconds", "efficiency": "efficiency", "mse": "relative_mse"}[what]
            found[scene] = r[key] / base[key]
    return found


def main(arguments):
    what, rest = arguments[:1], arguments[1:]
    if what == ["table"] and len(rest) == 1:
        print(text(*rest))
    elif what == ["knobs"] and len(rest) == 2:
        print(knobs(*rest))
    elif what == ["digits"] and rest:
        print(digits(*rest))
    elif what == ["plot"] and len(rest) > 1:
        pathlib.Path(rest[0]).write_text(plot(rest[1:]), encoding="utf-8")
    elif what == ["schedules"] and len(rest) == 2:
        print(schedules(*rest))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
