#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts/demo would build and run on machines with and without a GPU and nvcc: by programs of those names that
stand first on the PATH, in dry runs."""
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
DEMO = ROOT / "scripts/demo"
TOOLS = ("bash", "dirname", "realpath", "head", "basename", "nproc", "env")


def demo(programs, *arguments):
    """The demo's outcome if the PATH has a few tools of the system and these programs, which print and exit so."""
    with tempfile.TemporaryDirectory() as folder:
        for tool in TOOLS:
            path = subprocess.run(["sh", "-c", f"command -v {tool}"], check=True, capture_output=True, text=True).stdout
            (pathlib.Path(folder) / tool).symlink_to(path.strip())
        for name, (text, code) in programs.items():
            program = pathlib.Path(folder) / name
            program.write_text(f"#!/bin/sh\necho '{text}'\nexit {code}\n", encoding="utf-8")
            program.chmod(0o755)
        return subprocess.run([DEMO, *arguments], env={"PATH": folder, "CUDA_HOME": folder}, capture_output=True, text=True, check=False)


def check(result, words, absent=()):
    text = result.stdout + result.stderr
    missing = [word for word in words if word not in text] + [f"not {word}" for word in absent if word in text]
    assert not missing, f"{missing} in\n{text}"


GPU = {"nvidia-smi": ("NVIDIA Example 1\nNVIDIA Example 2", 0)}
ON_CPU = ("--preset omp", "-B build/demo-omp", "uses the CPU", "--schedule all")
ON_GPU = ("--preset cuda", "-B build/demo-cuda", "--backend cuda", "uses the GPU: NVIDIA Example 1\n", "--schedule all")

check(demo({**GPU, "nvcc": ("", 0)}, "--dry-run"), ON_GPU, ("--preset omp", "Example 2"))
check(demo({"nvcc": ("", 0)}, "--dry-run"), ON_CPU, ("GPU", "cuda "))
check(demo({"nvidia-smi": ("No devices were found", 6), "nvcc": ("", 0)}, "--dry-run"), ON_CPU, ("GPU", "--backend"))
check(demo(GPU, "--dry-run"), (*ON_CPU, "as there is no nvcc", "NVIDIA Example 1"), ("--preset cuda",))

box = demo({}, "--dry-run", str(ROOT / "examples/scenes/box.gltf"))
assert box.returncode == 0
check(box, ("out/demo/box.png", "out/demo/box-heatmaps.png", "out/demo/box-shaders.png", "out/demo/box.json"))
for wrong, words in ((["none.gltf"], "no such scene"), (["--bogus"], "usage"), (["a", "b"], "usage")):
    result = demo({}, "--dry-run", *wrong)
    assert result.returncode == 1, wrong
    check(result, (words,), ("cmake",))
