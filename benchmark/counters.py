#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What limits a schedule on a GPU: a profiler's counters of the kernels of cells of benchmark_schedules.

    benchmark/counters.py build/cuda/benchmark/benchmark_schedules docs/results/h200-counters.json

calls each cell once under Nsight Compute (`ncu`, which has to be on the PATH), with clocks as they are, caches emptied
before each kernel and one kernel at a time, several times over where its counters do not fit at once, and keeps the
counters of every kernel for benchmark/report.py. Cells are those of the paper's shaders, index, 8 Mi requests, random
and in runs of 32, unless --filter names others, of one kind and one number of requests.
"""
import argparse
import csv
import datetime
import json
import pathlib
import re
import subprocess
import sys

from reporting.counters import METRICS
from reporting.running import commit_of, output_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
CELLS = (r"^(3 simple|6 simple|2 simple \+ 2 procedural|3 simple \+ 2 procedural|11 moderate)/index/"
         r"(oracle-launches|switch|explicit|local-bitonic|local|window|(sort|bucket)\+(implicit|explicit))/"
         r"n:8388608/run:(1|32)/")


def names_of(program, cells):
    listed = subprocess.run([program, "--benchmark_list_tests", f"--benchmark_filter={cells}"], check=True,
                            capture_output=True, text=True).stdout.splitlines()
    return [re.sub(r"(/iterations:1)?/manual_time$", "", name) for name in listed]


def profile(program, cells):
    """The rows of ncu's table, as dictionaries by its headings."""
    command = ["ncu", "--profile-from-start", "off", "--clock-control", "none", "--nvtx", "--csv", "--page", "raw",
               "--print-units", "base", "--metrics", ",".join(METRICS),
               program, "--profile", f"--benchmark_filter={cells}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    lines = done.stdout.splitlines()
    begin = next((k for k, line in enumerate(lines) if line.startswith('"ID"')), None)
    if done.returncode != 0 or begin is None:
        sys.exit(f"{' '.join(command)}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return list(csv.DictReader(lines[begin:]))


def kernel_of(row):
    """One kernel: its name and its counters."""
    counters = {short: float(row[name].replace(",", "")) for name, short in METRICS.items()}
    return {"kernel": row["Kernel Name"], **counters}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--filter", default=CELLS, help="a regular expression that names of cells match")
    arguments = parser.parse_args()

    names = names_of(arguments.program, arguments.filter)
    cells = {name: [] for name in names}
    for row in profile(arguments.program, arguments.filter):
        if not row["ID"]:  # units
            continue
        range_of_row = " ".join(value for key, value in row.items() if key and "Push/Pop" in key and value)
        here = [name for name in names if f":{name}:" in range_of_row]
        if len(here) != 1:
            sys.exit(f"a kernel, {row['Kernel Name']}, is in the ranges of {len(here)} cells: {range_of_row}")
        cells[here[0]].append(kernel_of(row))
    without = [name for name, kernels in cells.items() if not kernels]
    if without or not names:
        sys.exit(f"{len(without)} of {len(names)} cells have no kernels: {', '.join(without[:3])}")
    gpu, driver = (output_of("nvidia-smi", f"--query-gpu={what}", "--format=csv,noheader").splitlines()[0]
                   for what in ("name", "driver_version"))
    context = {"date": datetime.datetime.now().astimezone().isoformat(timespec="seconds"), "machine": gpu,
               "driver": driver, "ncu": output_of("ncu", "--version").splitlines()[-1], "commit": commit_of(ROOT)}
    part = arguments.output.with_name(arguments.output.name + ".part")
    part.write_text(json.dumps({"context": context, "cells": cells}, indent=1) + "\n", encoding="utf-8")
    part.replace(arguments.output)
    print(f"{sum(map(len, cells.values()))} kernels of {len(cells)} cells")


if __name__ == "__main__":
    main()
