#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What it costs to have code for effects that a scene does not call for.

    benchmark/effects.py measure PATH_TRACER --backend NAME -o RESULT.json SCENE...
    benchmark/effects.py table RESULT.json
    benchmark/effects.py plot PLOT.svg RESULT.json...

`measure` renders every scene with --effects all and --effects auto in turns, by every schedule, and keeps
the seconds of each picture and the milliseconds of its shading, grouping included; with --against PROGRAM also
by another path tracer, which has code for the effects of these scenes alone. `table` prints, as Markdown, all
over auto, and auto over that program: medians over the repetitions, of the picture and in brackets of its
shading. `plot` draws the latter.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

from reporting import markdown
from reporting.svg import Drawing, LogScale, plain


def render(arguments, program, scene, effects):
    """All schedules, one after the other, in one process."""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        command = [program, str(scene), "-o", str(pathlib.Path(folder) / "picture.pfm"), "--quiet",
                   "--effects", effects, "--schedule", arguments.schedule, "--backend", arguments.backend,
                   "--width", str(arguments.width), "--height", str(arguments.height),
                   "--spp", str(arguments.spp), "--max-depth", str(arguments.max_depth), "--report", str(report)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        result = json.loads(report.read_text(encoding="utf-8"))
    return [{"code_for": result["settings"]["code_for"], "schedule": run["schedule"], "seconds": run["seconds"],
             "shade_ms": sum(b["total_ms"] for b in run["bounces"])} for run in result["schedules"]]


def measure(arguments):
    result = {"commit": arguments.commit, "machine": arguments.machine,
              "settings": {k: getattr(arguments, k) for k in
                           ("backend", "width", "height", "spp", "max_depth", "repetitions")}, "runs": []}
    programs = [("auto", arguments.path_tracer, "auto"), ("all", arguments.path_tracer, "all")]
    if arguments.against:
        programs.append(("only", arguments.against, "all"))
    for scene in map(pathlib.Path, arguments.scenes):
        for repetition in range(arguments.repetitions):
            turn = repetition % len(programs)
            for name, program, effects in programs[turn:] + programs[:turn]:
                for run in render(arguments, program, scene, effects):
                    result["runs"].append({"scene": scene.stem, "effects": name, **run})
        write(arguments.output, result)  # what is measured is not lost if the rest is interrupted
        print(scene.stem, flush=True)


def write(path, result):
    temporary = pathlib.Path(path + ".part")
    temporary.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    temporary.replace(path)


# What a table compares, and what stands above it.
PAIRS = {("all", "auto"): "", ("auto", "only"): "By its effects, over a program of those alone:"}


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def measured(result):
    settings = result["settings"]
    return ", ".join([result["machine"], f"commit {result['commit']}", f"{settings['width']} x {settings['height']}"] +
                     [f"{k} {settings[k]}" for k in ("backend", "spp", "max_depth", "repetitions")])


def table(result, pair):
    """The ratios of a pair of programs, and the spread of their times; empty where one of them did not run."""
    if not all(any(run["effects"] == e for run in result["runs"]) for e in pair):
        return ""
    numbers, spreads = {}, []
    for run in result["runs"]:
        for what in ("seconds", "shade_ms"):
            numbers.setdefault((run["scene"], run["schedule"], run["effects"], what), []).append(run[what])
    code = {run["scene"]: run["code_for"] for run in result["runs"] if run["effects"] == "auto"}
    schedules = list(dict.fromkeys(run["schedule"] for run in result["runs"]))

    def ratio(scene, schedule, what):
        above, below = (numbers[scene, schedule, e, what] for e in pair)
        if what == "seconds":
            spreads.extend((max(v) - min(v)) / statistics.median(v) for v in (above, below))
        return statistics.median(above) / statistics.median(below)

    rows = [[scene, len(names.split(", "))] +
            [f"{ratio(scene, s, 'seconds'):.2f} ({ratio(scene, s, 'shade_ms'):.2f})" for s in schedules]
            for scene, names in code.items()]
    return (markdown.table(["scene", "effects in its code"] + [f"`{s}`" for s in schedules], rows) +
            "\n\nSpread of a picture's seconds, (most - least) / median: half of them at most "
            f"{100 * statistics.median(spreads):.0f} %, the largest {100 * max(spreads):.0f} %.")


def text(path, pairs=tuple(PAIRS)):
    result = read(path)
    parts = [measured(result)]
    for pair in pairs:
        found = table(result, pair)
        if found:
            parts += [PAIRS[pair]] * bool(PAIRS[pair] and len(pairs) > 1) + [found]
    return "\n\n".join(parts)


PLOTTED = ("implicit", "explicit", "bucket+explicit", "local", "window")


def plot(paths):
    """Shading, all over auto, for each scene and some schedules: a disc for the first result, a diamond for the next."""
    results, times = [read(path) for path in paths], []
    for result in results:
        times.append({})
        for run in result["runs"]:
            times[-1].setdefault((run["scene"], run["schedule"], run["effects"]), []).append(run["shade_ms"])
    scenes = [s for s in dict.fromkeys(run["scene"] for run in results[0]["runs"])
              if all((s, name, "all") in found for found in times for name in PLOTTED)]

    def ratio(found, scene, name):
        return statistics.median(found[scene, name, "all"]) / statistics.median(found[scene, name, "auto"])
    top, row, block, left, right = 48, 14, 21 + 14 * len(PLOTTED) + 9, 128, 426
    bottom = top + block * len(scenes)
    every = [ratio(found, scene, name) for found in times for scene in scenes for name in PLOTTED]
    x = LogScale(min(0.75, min(every) / 1.1), max(4, max(every) * 1.1), left, right)
    d = Drawing(440, bottom + 58, "Shading by code for all effects, over shading by code for those of the scene")
    looks = list(zip(("disc", "diamond"), ("s0", "s1"), results))
    for k, (shape, look, result) in enumerate(looks):
        d.mark(shape, 16, 16 + 20 * k, look)
        d.text(26, 20 + 20 * k, result["machine"])
    for value in (0.5, 0.75, 1, 1.5, 2, 3, 4, 8):
        if not x.low <= value <= x.high:
            continue
        d.line([(x(value), top), (x(value), bottom)], "axis" if value == 1 else "grid")
        d.text(x(value), bottom + 15, plain(value), "small soft", "middle")
    d.text((left + right) / 2, bottom + 34, "shading takes so many times as long", "", "middle")
    d.text((left + right) / 2, bottom + 50, "by code for all effects", "", "middle")
    for k, scene in enumerate(scenes):
        d.text(8, top + block * k + 14, scene, "strong")
        for i, name in enumerate(PLOTTED):
            y = top + block * k + 21 + row * i + row / 2
            d.text(left - 8, y + 4, name, "small", "end")
            for (shape, look, _), found in zip(looks, times):
                value = ratio(found, scene, name)
                d.mark(shape, x(value), y, look, f"{scene}, {name}: {value:.2f}")
    return d.render()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    m = commands.add_parser("measure")
    m.add_argument("path_tracer")
    m.add_argument("scenes", nargs="+")
    m.add_argument("--backend", default="omp")
    m.add_argument("--schedule", default="all")
    m.add_argument("--against")
    m.add_argument("--commit", default="unknown")
    m.add_argument("--machine", default="unknown")
    m.add_argument("-o", "--output", required=True)
    for name, value in (("width", 512), ("height", 512), ("spp", 8), ("max-depth", 8), ("repetitions", 5)):
        m.add_argument("--" + name, type=int, default=value)
    commands.add_parser("table").add_argument("result")
    p = commands.add_parser("plot")
    p.add_argument("output")
    p.add_argument("results", nargs="+")
    arguments = parser.parse_args()
    if arguments.command == "measure":
        measure(arguments)
    elif arguments.command == "plot":
        pathlib.Path(arguments.output).write_text(plot(arguments.results), encoding="utf-8")
    else:
        print(text(arguments.result))


if __name__ == "__main__":
    sys.exit(main())
