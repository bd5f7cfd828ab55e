#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The five scenes that have as many shaders as those of the paper, rendered by the example path tracer.

    benchmark/scenes.py efficiency PATH_TRACER docs/results/scenes-efficiency.json
    benchmark/scenes.py times PATH_TRACER docs/results/scenes-cpu.json --machine WORDS [--backend cuda]
    benchmark/scenes.py pictures PATH_TRACER docs/scenes

`efficiency` counts, and measures no time: the heterogeneous efficiency of every schedule at the first hits, and the
requests of each shader; no machine changes it. `times` renders every scene by every schedule, several times, in larger
pictures on a GPU. Both are for benchmark/report.py. `pictures` writes a picture of each scene, all in one row, and for
each the path tracer's sheet of heat maps, of what `efficiency` counts, for the schedules of PICTURED.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

from reporting import png
from reporting.paper import EFFICIENCY, SCENES
from reporting.running import commit_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
PICTURED = ("implicit", "local-bitonic")
COUNTED = {"width": 1280, "height": 720, "spp": 1, "max-depth": len(EFFICIENCY)}  # one batch, a path for each pixel
TIMED = {"width": 480, "height": 270, "spp": 1, "max-depth": 8}
TIMED_ON_CUDA = {"width": 1280, "height": 720, "spp": 8, "max-depth": 8}
SHOWN = {"width": 256, "height": 144, "spp": 256, "max-depth": 16}


def scene_path(scene):
    return ROOT / "examples/scenes/paper" / f"{scene.file()}.gltf"


def run(program, scene, settings, *options):
    words = [word for key, value in settings.items() for word in (f"--{key}", str(value))]
    subprocess.run([program, str(scene_path(scene)), "--quiet", *words, *options], check=True,
                   stdout=subprocess.DEVNULL)  # the table


def report_of(program, scene, settings):
    """The report of all schedules over a scene, without names of places."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "report.json"
        run(program, scene, settings, "--schedule", "all", "-o", str(path.with_suffix(".pfm")), "--report", str(path))
        report = json.loads(path.read_text(encoding="utf-8"))
    del report["output"]
    return {**report, "scene": scene.name}


def keep(report, of_run, of_bounce):
    """The same report with these measurements of its runs and bounces alone."""
    def bounces(run):
        return [{key: bounce[key] for key in of_bounce} for bounce in run["bounces"]]
    return {**report, "schedules": [{**{key: run[key] for key in of_run}, "bounces": bounces(run)}
                                    for run in report["schedules"]]}


def heat_maps(program, scene):
    with tempfile.TemporaryDirectory() as folder:
        sheet = pathlib.Path(folder) / "sheet.png"
        run(program, scene, COUNTED, "--schedule", ",".join(PICTURED), "--heatmap-sheet", str(sheet),
            "-o", f"{folder}/picture.pfm")
        return png.read(sheet)


def picture(program, scene):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "picture.png"
        run(program, scene, SHOWN, "-o", str(path))
        return png.read(path)


def write(path, result):
    temporary = path.with_name(path.name + ".part")
    temporary.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    temporary.replace(path)


def write_pictures(arguments):
    arguments.output.mkdir(parents=True, exist_ok=True)
    for scene in SCENES:
        png.write(arguments.output / f"{scene.file()}.png", heat_maps(arguments.path_tracer, scene))
    png.write(arguments.output / "scenes.png", png.beside([picture(arguments.path_tracer, s) for s in SCENES]))


def write_reports(arguments):
    is_timed = arguments.what == "times"
    settings = COUNTED
    if is_timed:
        settings = {**(TIMED_ON_CUDA if arguments.backend == "cuda" else TIMED), "backend": arguments.backend}
    result = {"commit": commit_of(ROOT), "machine": arguments.machine, "reports": []}
    for scene in SCENES:
        for _ in range(arguments.repetitions if is_timed else 1):
            report = report_of(arguments.path_tracer, scene, settings)
            result["reports"].append(keep(report, ["schedule", "seconds"], ["group_ms", "total_ms"]) if is_timed else
                                     keep(report, ["schedule"], ["requests", "efficiency", "first_batch_by_shader"]))
        write(arguments.output, result)  # what is measured is not lost if the rest is interrupted
        print(scene.name, flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("efficiency", "times", "pictures"))
    parser.add_argument("path_tracer")
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--machine", default="any", help="with times: its name in words")
    parser.add_argument("--backend", default="omp", help="with times: the path tracer's")
    parser.add_argument("--repetitions", type=int, default=5, help="with times")
    arguments = parser.parse_args()
    (write_pictures if arguments.what == "pictures" else write_reports)(arguments)


if __name__ == "__main__":
    sys.exit(main())
