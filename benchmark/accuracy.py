#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What accuracy costs in time: the path tracer's settings, one at a time and together.

    benchmark/accuracy.py PATH_TRACER --backend NAME -o RESULT.jsonl SCENE...

renders every scene by every setting below with several seeds, compares the pictures with a reference, and
appends one line of JSON for each setting. A setting that the file has is not measured again, nor a picture that
the cache has: an interrupted run goes on where it was. References and unfinished pictures lie in --cache, by names that say scene, size,
seed, samples and precision. benchmark/accuracy_report.py makes tables and plots. Needs NumPy; FLIP is filled in
where the package flip-evaluator is installed. The programs gltf_path_tracer_double, gltf_path_tracer_fast and
gltf_path_tracer_compact (cmake -DDEFERRED_SHADE_BUILD_ACCURACIES=ON) lie beside PATH_TRACER; the first makes the references; none of them has the backend tbb.

Errors are relative to the reference r: (x - r)^2 / (r^2 + 1e-2 m^2), where m is the mean of the reference,
averaged over pixels and channels. Of several seeds' pictures, their variance and the square of their mean's
distance from the reference (less what is left of the variance in both) are told apart. What only rounds differently
is compared with the same samples in double precision as well, where noise does not hide it: `rounding`, the root
mean square of that difference, relative as above, and its median.
"""
import argparse
import hashlib
import json
import pathlib
import statistics
import subprocess
import sys
import time

import numpy

try:
    import flip_evaluator
except ImportError:
    flip_evaluator = None

REFERENCE_SEEDS = (1000001, 1000002)
BASE = {"spp": 16, "max-depth": 16, "roulette": 5, "estimator": "mis", "sums": "double", "octaves": 16,
        "precision": "float", "storage": "full"}
# What is another program, by the ending of its name, and not an option.
BUILDS = {"precision": {"float": "", "double": "_double", "fast": "_fast"}, "storage": {"full": "", "compact": "_compact"}}
EXACT = {"precision": "double", "storage": "full", "sums": "double"}
ONE_AT_A_TIME = {
    "spp": [1, 2, 4, 8, 16, 32, 64, 128],
    "max-depth": [2, 3, 4, 6, 8, 32],
    "roulette": [1, 2, 3, 8, 64],
    "estimator": ["bsdf", "light"],
    "sums": ["compensated", "float"],
    "octaves": [1, 2, 3],
    "precision": ["double", "fast"],
    "storage": ["compact"],
}
TOGETHER = [{"max-depth": 4, "spp": 4}, {"max-depth": 4, "spp": 64}, {"max-depth": 8, "spp": 64},
            {"max-depth": 8, "roulette": 2, "spp": 64}, {"max-depth": 4, "roulette": 1, "spp": 64},
            {"estimator": "light", "max-depth": 4, "spp": 64}, {"estimator": "light", "spp": 64},
            {"estimator": "bsdf", "spp": 64}, {"sums": "float", "spp": 128},
            {"precision": "fast", "spp": 64}, {"precision": "double", "spp": 64}, {"storage": "compact", "spp": 64},
            {"max-depth": 8, "precision": "fast", "spp": 64}]


def settings():
    found = [dict(BASE, **{knob: value}) for knob, values in ONE_AT_A_TIME.items() for value in values]
    found += [dict(BASE, **changes) for changes in TOGETHER]
    return [s for k, s in enumerate(found) if s not in found[:k]]


def read_pfm(path):
    with open(path, "rb") as file:
        if file.readline().strip() != b"PF":
            raise ValueError(f"{path} is no colour PFM")
        width, height = map(int, file.readline().split())
        if float(file.readline()) >= 0:
            raise ValueError(f"{path} is not little-endian")
        pixels = numpy.frombuffer(file.read(), "<f4")
    return pixels.reshape(height, width, 3)[::-1].astype(numpy.float64)


def render(arguments, scene, setting, seed, name):
    """The picture and its seconds; both are kept under `name` until forget()."""
    picture, report = arguments.cache / (name + ".pfm"), arguments.cache / (name + ".json")
    if not report.exists() or not picture.exists():
        unfinished = arguments.cache / (name + ".part.json")
        endings = [endings[setting[knob]] for knob, endings in BUILDS.items()]
        command = [arguments.path_tracer + "".join(endings), str(scene), "-o", str(picture), "--quiet", "--report", str(unfinished),
                   "--backend", arguments.backend, "--schedule", arguments.schedule, "--seed", str(seed),
                   "--width", str(arguments.width), "--height", str(arguments.height)]
        for knob, value in setting.items():
            command += [] if knob in BUILDS else ["--" + knob, str(value)]
        subprocess.run(command, check=True)
        unfinished.replace(report)
    run = json.loads(report.read_text(encoding="utf-8"))["schedules"][0]
    return read_pfm(picture), run["seconds"], run["discarded_samples"]


def forget(arguments, name):
    for ending in (".pfm", ".json"):
        (arguments.cache / (name + ending)).unlink()


def reference(arguments, scene):
    """The mean of two pictures with many samples and deep paths, and the relative error that their
    difference shows the mean to have."""
    setting = dict(BASE, **{"spp": arguments.reference_spp, "max-depth": 64, "roulette": 8, "precision": "double"})
    name = f"{scene.stem}-{arguments.width}x{arguments.height}-double-spp{arguments.reference_spp}-seed"
    halves = [render(arguments, scene, setting, seed, name + str(seed))[0] for seed in REFERENCE_SEEDS]
    mean = (halves[0] + halves[1]) / 2
    return mean, float(numpy.mean((halves[0] - halves[1]) ** 2 / 4 / scale(mean)))


def scale(r):
    return r ** 2 + 1e-2 * numpy.mean(r) ** 2


def flip(r, x):
    if flip_evaluator is None:
        return None

    def shown(linear):
        c = numpy.clip(linear, 0, 1)
        return numpy.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055).astype(numpy.float32)

    return float(flip_evaluator.evaluate(shown(r), shown(x), "LDR")[1])


def names_of(arguments, scene, setting):
    """What the pictures of all seeds are called."""
    what = json.dumps([arguments.backend, arguments.schedule, arguments.commit, setting], sort_keys=True)
    digest = hashlib.sha256(what.encode()).hexdigest()[:12]
    return [f"{scene.stem}-{arguments.width}x{arguments.height}-{digest}-seed{seed}" for seed in range(arguments.seeds)]


def render_in_turns(arguments, scene, wanted):
    """All settings with one seed, then all with the next: what disturbs the machine for a while falls on a seed of
    many settings, and not on many seeds of one."""
    for seed in range(arguments.seeds):
        for k, setting in enumerate(wanted):
            render(arguments, scene, setting, seed, names_of(arguments, scene, setting)[seed])
            print(f"{scene.stem}, seed {seed + 1}/{arguments.seeds}: {k + 1}/{len(wanted)} settings", flush=True)


def render_seeds(arguments, scene, setting):
    names = names_of(arguments, scene, setting)
    return [render(arguments, scene, setting, seed, name) for seed, name in enumerate(names)], names


def rounding(arguments, scene, setting, pictures, relative):
    changed = {knob for knob, value in setting.items() if BASE[knob] != value}
    if changed == {"spp"} or not changed <= {"spp", *EXACT}:
        return None, []
    runs, names = render_seeds(arguments, scene, dict(setting, **EXACT))
    difference = numpy.abs(pictures - numpy.array([picture for picture, _, _ in runs])) / numpy.sqrt(relative)
    return {"rms": float(numpy.sqrt(numpy.mean(difference ** 2))), "median": float(numpy.median(difference))}, names


def measure(arguments, scene, setting, truth, truth_error):
    runs, names = render_seeds(arguments, scene, setting)
    pictures = numpy.array([picture for picture, _, _ in runs])
    if not numpy.isfinite(pictures).all():
        raise ValueError(f"{scene.stem}: a picture has a pixel that is not finite")
    seconds = [s for _, s, _ in runs]
    relative = scale(truth)
    errors = [float(numpy.mean((p - truth) ** 2 / relative)) for p in pictures]
    variance = float(numpy.mean(pictures.var(axis=0, ddof=1) / relative))
    distance = float(numpy.mean((pictures.mean(axis=0) - truth) ** 2 / relative))
    result = {
        "scene": scene.stem, "setting": setting,
        "changes": {knob: value for knob, value in setting.items() if BASE[knob] != value}, "seeds": arguments.seeds,
        "seconds": statistics.median(seconds), "seconds_spread": max(seconds) - min(seconds),
        "relative_mse": statistics.mean(errors),
        "relative_variance": variance,
        "relative_bias2": distance - variance / arguments.seeds - truth_error,
        "reference_mse": truth_error, "reference_spp": 2 * arguments.reference_spp,
        "p999": float(numpy.percentile(numpy.abs(pictures[0] - truth) / numpy.sqrt(relative), 99.9)),
        "flip": flip(truth, pictures[0]),
        "discarded_samples": sum(d for _, _, d in runs),
    }
    result["rounding"], exact_names = rounding(arguments, scene, setting, pictures, relative)
    result["efficiency"] = 1 / (result["relative_mse"] * result["seconds"])
    return result, set(names + exact_names)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path_tracer")
    parser.add_argument("scenes", nargs="+", type=pathlib.Path)
    parser.add_argument("--backend", default="omp")
    parser.add_argument("--schedule", default="local")
    parser.add_argument("--cache", type=pathlib.Path, default=pathlib.Path("accuracy-cache"))
    parser.add_argument("--commit", default="unknown")
    parser.add_argument("--machine", default="unknown")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    for name, value in (("width", 128), ("height", 128), ("seeds", 8), ("reference-spp", 8192)):
        parser.add_argument("--" + name, type=int, default=value)
    arguments = parser.parse_args()
    arguments.cache.mkdir(parents=True, exist_ok=True)
    done = [json.loads(line) for line in arguments.output.read_text(encoding="utf-8").splitlines()] \
        if arguments.output.exists() else []
    if any(set(d["setting"]) != set(BASE) for d in done):
        sys.exit(f"{arguments.output} has results of other settings than this script knows: name another file")
    finished = {(d["scene"], json.dumps(d["setting"], sort_keys=True)) for d in done}
    common = {k: getattr(arguments, k) for k in ("backend", "schedule", "width", "height", "commit", "machine")}
    wanted = [(scene, s) for scene in arguments.scenes for s in settings()
              if (scene.stem, json.dumps(s, sort_keys=True)) not in finished]
    start, truth_of, truth = time.monotonic(), None, (None, 0)
    for k, (scene, setting) in enumerate(wanted):
        if truth_of != scene:
            truth_of, truth = scene, reference(arguments, scene)
            render_in_turns(arguments, scene, [s for other, s in wanted if other == scene])
        result, names = measure(arguments, scene, setting, *truth)
        with open(arguments.output, "a", encoding="utf-8") as file:
            file.write(json.dumps({**common, **result}) + "\n")
        for name in names:
            forget(arguments, name)
        left = (time.monotonic() - start) / (k + 1) * (len(wanted) - k - 1)
        print(f"{k + 1}/{len(wanted)} {scene.stem} {result['changes']}: {result['relative_mse']:.3g} in "
              f"{result['seconds']:.3f} s; {left:.0f} s to go", flush=True)


if __name__ == "__main__":
    sys.exit(main())
