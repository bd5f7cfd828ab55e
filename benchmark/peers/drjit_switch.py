#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Dr.Jit's dr.switch on its LLVM backend, next to benchmark_vectors: the same materials, requests, ids
and number of threads, one after the other on one machine.

    benchmark/peers/drjit_switch.py build/omp/benchmark/benchmark_vectors [--threads 2] [--json out.json]

Dr.Jit and NumPy come from PyPI (drjit, numpy); Dr.Jit loads LLVM's shared library, 19 for one, whose
path may be given in DRJIT_LIBLLVM_PATH. Where one is missing, says so and exits with 0.

Dr.Jit's times are those of a call whose kernels are compiled and cached, tracing included: `symbolic` is
one kernel with calls in it, `evaluated` sorts the requests by material and runs a kernel for each. Means of
the results must agree with those of the C++ program.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from reporting.google_benchmark import without_names
from reporting.several import peers

try:
    import drjit as dr
    import drjit.llvm as llvm
    import numpy as np
    llvm.Float(1) + 1
except Exception as error:  # a missing package, or a missing LLVM
    print(f"SKIPPED: no Dr.Jit with LLVM and NumPy here: {error}")
    sys.exit(0)

N = 1 << 22
Float, UInt32, Int32 = llvm.Float, llvm.UInt32, llvm.Int32


# The requests, as benchmark/batch.hpp and vectors.cpp make them.
def mixed(x):
    x = x ^ (x >> np.uint32(16))
    x = x * np.uint32(0x85ebca6b)
    x = x ^ (x >> np.uint32(13))
    x = x * np.uint32(0xc2b2ae35)
    return x ^ (x >> np.uint32(16))


def random_bits(dimension):
    i = np.arange(1, N + 1, dtype=np.uint32)
    return mixed(mixed(i) + np.uint32(dimension * 0x9e3779b1 & 0xffffffff))


def make_surfaces():
    vectors = []
    for v in range(4):
        p = np.stack([2 * ((random_bits(20 + 3 * v + d) >> np.uint32(8)).astype(np.float32) *
                           np.float32(2 ** -24)) - 1 for d in range(3)])
        length = np.sqrt((p * p).sum(axis=0) + np.float32(1e-6))
        vectors.append((p * 5 if v == 0 else p / length).astype(np.float32))
    return vectors


# The materials, as vectors.cpp has them.
def noise(x, y, seed):
    floor_x, floor_y = dr.floor(x), dr.floor(y)
    cell_x, cell_y = UInt32(Int32(floor_x)), UInt32(Int32(floor_y))

    def corner(right, up):
        h = (cell_x + right) * 0x9e3779b1 ^ (cell_y + up) * 0x85ebca77 ^ seed
        h = (h ^ h >> 16) * 0x85ebca6b
        h = (h ^ h >> 13) * 0xc2b2ae35
        h = h ^ h >> 16
        return Float(Int32(h >> 8)) * 2 ** -24

    def smooth(t):
        return t * t * (3 - 2 * t)
    u, v = smooth(x - floor_x), smooth(y - floor_y)
    low = corner(0, 0) + u * (corner(1, 0) - corner(0, 0))
    high = corner(0, 1) + u * (corner(1, 1) - corner(0, 1))
    return low + v * (high - low)


def turbulence(octaves, x, y, seed):
    if octaves == 0:
        return Float(0)
    return 0.5 * (noise(x, y, seed) + turbulence(octaves - 1, 2 * x, 2 * y, seed + 1))


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def material(number):
    alpha = 0.05 + 0.05 * (1 + number % 16)
    grain = 3 + number % 8
    seed = 71 * number + 3

    def microfacets(light, view, half, difference):
        alpha2 = alpha * alpha
        d = half * half * (alpha2 - 1) + 1
        toward = light * dr.sqrt(view * view * (1 - alpha2) + alpha2)
        away = view * dr.sqrt(light * light * (1 - alpha2) + alpha2)
        grazing = 1 - difference
        grazing2 = grazing * grazing
        fresnel = 0.04 + 0.96 * grazing2 * grazing2 * grazing
        distribution = alpha2 / (3.14159265 * d * d + 1e-7)
        return light * fresnel * distribution * 0.5 / (toward + away + 1e-6)

    def shade(*s):
        p, n, v, l = s[0:3], s[3:6], s[6:9], s[9:12]
        light, view = dr.maximum(dot(n, l), 0), dr.maximum(dot(n, v), 0)
        h = [v[d] + l[d] for d in range(3)]
        scale = 1 / dr.sqrt(dot(h, h) + 1e-8)
        half, difference = dr.maximum(dot(n, h) * scale, 0), dr.maximum(dot(v, h) * scale, 0)
        if number % 4 == 0:
            stone = turbulence(2, grain * p[0], grain * p[1], seed)
            rgb, gloss = (stone, 0.8 * stone, 0.3 * stone), microfacets(light, view, half, difference)
        elif number % 4 == 1:
            wax = turbulence(4, grain * p[0], grain * p[2], seed)
            deep = dr.exp(-alpha * (dr.abs(p[0]) + wax))
            rgb, gloss = (wax * deep, deep, (1 - wax) * deep), 0.02 * half
        elif number % 4 == 2:
            stripe = 0.5 + 0.5 * dr.sin(grain * p[0] + 2 * dr.sin(grain * p[1]))
            rgb, gloss = (stripe, 1 - stripe, Float(0.2)), microfacets(light, view, half, difference)
        else:
            rough = turbulence(4, grain * p[0], grain * p[1], seed)
            vein = 0.5 + 0.5 * dr.sin(grain * p[2] + 5 * rough)
            dark = dr.exp(-2 * vein)
            rgb, gloss = (vein, vein * dark, dark), microfacets(light, view, half, difference)
        return tuple(c * light + gloss for c in rgb)
    return shade


def time_drjit(materials, surfaces, ids, calls):
    """Seconds of each of `calls` calls, and the means of the results."""
    shaders = [material(k) for k in range(materials)]
    seconds, means = [], None
    for call in range(calls + 2):
        dr.sync_thread()
        begin = time.perf_counter()
        rgb = dr.switch(ids, shaders, *surfaces)
        dr.eval(*rgb)
        dr.sync_thread()
        if call >= 2:
            seconds.append(time.perf_counter() - begin)
        means = [float(np.array(c, dtype=np.float64).mean()) for c in rgb]
    return seconds, means


def time_ours(program, materials, threads, calls):
    """The same of the schedules of the C++ program, {name: (seconds, means)}."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "vectors.json")
        subprocess.run([program, f"--benchmark_filter=^{materials} materials/record/(implicit|local)/"
                        f"n:{N}/run:1/", f"--benchmark_repetitions={calls}", "--benchmark_out=" + out,
                        "--benchmark_out_format=json"], check=True, stdout=subprocess.DEVNULL,
                       env=dict(os.environ, OMP_NUM_THREADS=str(threads)))
        with open(out, encoding="utf-8") as file:
            report = json.load(file)
    found = {}
    for cell in report["benchmarks"]:
        if cell.get("run_type") == "aggregate":
            continue
        seconds, _ = found.setdefault(cell["name"].split("/")[2],
                                      ([], [cell[f"mean_{c}"] for c in "rgb"]))
        seconds.append(1e-6 * cell["real_time"])
    return found, without_names(report["context"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program", help="benchmark_vectors, built for this machine's CPUs")
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("--calls", type=int, default=7)
    parser.add_argument("--json", help="where to write the times")
    arguments = parser.parse_args()
    dr.set_thread_count(arguments.threads)
    surfaces = [Float(component) for vector in make_surfaces() for component in vector]
    report = {"n": N, "threads": arguments.threads, "drjit": dr.__version__, "cells": []}
    failed = False
    for materials in (4, 12):
        ids = UInt32(random_bits(1) % np.uint32(materials))
        rows, context = time_ours(arguments.program, materials, arguments.threads, arguments.calls)
        report["context"] = context
        rows = {f"deferred_shade, {name}": row for name, row in rows.items()}
        for name, symbolic in (("symbolic", True), ("evaluated", False)):
            with dr.scoped_set_flag(dr.JitFlag.SymbolicCalls, symbolic):
                rows[f"dr.switch, {name}"] = time_drjit(materials, surfaces, ids, arguments.calls)
        expected = rows["deferred_shade, implicit"][1]
        for name, (seconds, means) in rows.items():
            if any(abs(a - b) > 1e-3 * abs(b) for a, b in zip(means, expected)):
                failed = True
                print(f"WRONG RESULTS of {materials} materials, {name}")
            report["cells"].append({"materials": materials, "what": name, "seconds": seconds,
                                    "means": means})
    print(peers(report))
    if arguments.json:
        with open(arguments.json + ".part", "w", encoding="utf-8") as file:
            json.dump(report, file, indent=1)
        os.replace(arguments.json + ".part", arguments.json)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
