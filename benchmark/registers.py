#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Registers and occupancy of the path tracer's kernels, variant by variant, from the compiler's report.

    cmake --preset cuda -DCMAKE_CUDA_FLAGS="-Xptxas -v" && cmake --build build/cuda -t gltf_path_tracer > build.log
    benchmark/registers.py build.log > registers.json
    benchmark/registers.py registers.json
"""
import json
import re
import subprocess
import sys

from reporting import markdown

# Threads of a block; those of window_kernel for tables of 9 to 16 shaders. (include/deferred_shade)
BLOCK = {"switch_kernel": 256, "segments_kernel": 256, "tile_kernel": 512, "bitonic_kernel": 256, "window_kernel": 512}
STAGES = ("find_hits", "trace_shadows", "generate_paths")


def kernels_of(log):
    names, registers, name = [], [], None
    for line in log.splitlines():
        if entry := re.search(r"Compiling entry function '([^']+)'", line):
            name = entry.group(1)
        if (used := re.search(r"Used (\d+) registers", line)) and name:
            names.append(name)
            registers.append(int(used.group(1)))
            name = None
    plain = subprocess.run(["c++filt"], input="\n".join(names), capture_output=True, text=True, check=True).stdout
    result = []
    for text, count in zip(plain.splitlines(), registers):
        variant = re.search(r"effect_set<(\d+)u>", text)
        kernel = next((k for k in (*BLOCK, *STAGES) if f"{k}<" in text), None)
        if variant and kernel:
            result.append({"kernel": kernel, "effects": bin(int(variant.group(1))).count("1"), "registers": count})
    return result


def warps(registers, threads):
    """Warps that a multiprocessor of compute capability 9.0 has room for: 65536 registers, in units of 8 per
    thread, and 64 warps."""
    blocks = 65536 // (-(-registers // 8) * 8 * threads)
    return min(blocks * threads, 2048) // 32


def table(path):
    rows = {}
    with open(path, encoding="utf-8") as file:
        for k in json.load(file):
            rows.setdefault(k["kernel"], {})[k["effects"]] = k["registers"]
    sets = sorted({effects for row in rows.values() for effects in row})
    lines = []
    for kernel in (*BLOCK, *STAGES):
        line = [f"`{kernel}`"]
        for effects in sets:
            registers = rows.get(kernel, {}).get(effects)
            room = f" ({warps(registers, BLOCK[kernel])})" if registers and kernel in BLOCK else ""
            line.append(f"{registers}{room}" if registers else "")
        lines.append(line)
    return markdown.table(["kernel"] + [f"{s} effects" for s in sets], lines)


def main(path):
    if path.endswith(".json"):
        return print(table(path))
    with open(path, encoding="utf-8") as file:
        print(json.dumps(kernels_of(file.read()), indent=1))


if __name__ == "__main__":
    main(sys.argv[1]) if len(sys.argv) == 2 else sys.exit(__doc__)
