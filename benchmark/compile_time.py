#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What it takes to compile with the library: seconds, peak memory and the size of the object.

    benchmark/compile_time.py --compiler g++ -o compile-time-gcc.json
    benchmark/compile_time.py --compiler nvcc --shaders 16 -o compile-time-nvcc.json

Compiles, one at a time, a source that includes nothing but Thrust's policies; one that includes the library as
well; and for every schedule and each size of table one that calls shade() once, whose shaders are all different.
The times are those of the processor, user and system, of the compiler and what it starts, which say the same when
others use the machine, and those of a clock; memory is that of its largest process. Every case is compiled
--repetitions times, and rounds of all cases follow each other, so that a slow minute is spread over them.

A file that is there is added to: only what it lacks is measured. With --seconds, stops after so many of them.
"""
import argparse
import datetime
import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
# By the names that the library's own list has.
SCHEDULES = {name: re.sub(r"\b(\w+_serialization|bitonic|counting)\b(?=>)", r"ds::\1", type_)
             for name, type_ in re.findall(r'^  f\("([^"]+)", ([^;]*)\{\}\);$',
                                           (ROOT / "include/deferred_shade/schedule.hpp").read_text(encoding="utf-8"), re.M)}
THRUST = "#include <thrust/execution_policy.h>\n"
LIBRARY = THRUST + "#include <deferred_shade/deferred_shade.hpp>\n"
CALL = LIBRARY + """#include <cstdint>
#include <utility>
namespace ds = deferred_shade;
using scratch_memory = decltype(ds::workspace{thrust::device});
template <int Id>
struct shader {
  float* values;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const {
    float const x = values[i];
    values[i] = x * (0.5F + Id) / (1 + x * x * Id);
  }
};
template <int... Ids>
void shade(float* values, std::uint8_t const* ids, std::size_t n, scratch_memory& scratch,
           std::integer_sequence<int, Ids...>) {
  ds::shader_table const shaders{shader<Ids>{values}...};
  ds::shade(thrust::device, ds::%(schedule)s{}, n, ids, shaders, scratch);
}
void call(float* values, std::uint8_t const* ids, std::size_t n, scratch_memory& scratch) {
  shade(values, ids, n, scratch, std::make_integer_sequence<int, %(shaders)d>{});
}
"""


def cases(sizes, schedules):
    """(name, shaders, source) of everything to compile."""
    found = [("nothing", 0, "int answer() { return 42; }\n"), ("Thrust's policies", 0, THRUST),
             ("the library", 0, LIBRARY)]
    return found + [(name, shaders, CALL % {"schedule": SCHEDULES[name], "shaders": shaders})
                    for shaders in sizes for name in schedules]


def compile_once(command, source, folder):
    """Compiles a source once; what it took."""
    path, target = folder / "case.cpp", folder / "case.o"
    path.write_text(source, encoding="utf-8")
    begin = time.monotonic()
    process = subprocess.Popen([*command, "-c", str(path), "-o", str(target)])
    _, status, used = os.wait4(process.pid, 0)
    elapsed = time.monotonic() - begin
    if status != 0:
        sys.exit(f"the compiler fails:\n{source}")
    return {"seconds": elapsed, "cpu_seconds": used.ru_utime + used.ru_stime, "peak_kib": used.ru_maxrss,
            "object_bytes": target.stat().st_size}


def machine():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        names = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
    return names[0] if names else platform.machine()


def context(arguments, command):
    def output_of(*words):
        return subprocess.run(words, capture_output=True, text=True, check=True).stdout.strip()
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "version.cpp"
        path.write_text("#include <thrust/version.h>\nTHRUST_VERSION\n", encoding="utf-8")
        thrust = output_of(*command, "-E", str(path)).split()[-1]
    version = output_of(arguments.compiler, "--version")
    commit = output_of("git", "-C", str(ROOT), "log", "-1", "--format=%h", "--", "include")  # the last that changed it
    return {"date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"), "machine": machine(),
            "compiler": version.splitlines()[-2 if arguments.nvcc else 0], "flags": " ".join(arguments.flags),
            "thrust": f"{int(thrust) // 100000}.{int(thrust) // 100 % 1000}", "commit": commit}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--compiler", default="g++")
    parser.add_argument("--cccl", default="/usr/local/cuda/include/cccl", help="the folder that has thrust/")
    parser.add_argument("--shaders", type=int, nargs="*", default=[4, 16, 64])
    parser.add_argument("--schedules", nargs="*", default=list(SCHEDULES), choices=list(SCHEDULES))
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=float("inf"))
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    arguments.nvcc = "nvcc" in arguments.compiler
    arguments.flags = ["-std=c++17", "-O3"] + (["-arch=sm_90", "-x", "cu"] if arguments.nvcc else
                                               ["-fopenmp", "-DTHRUST_DEVICE_SYSTEM=THRUST_DEVICE_SYSTEM_OMP"])
    command = [arguments.compiler, *arguments.flags, f"-I{ROOT / 'include'}", "-isystem", arguments.cccl]
    report = {"context": context(arguments, command), "cases": []}
    if arguments.output.exists():
        before = json.loads(arguments.output.read_text(encoding="utf-8"))
        if any(before["context"][key] != report["context"][key] for key in ("compiler", "flags", "thrust", "commit")):
            sys.exit(f"{arguments.output} has times of another compiler, of other flags or of another commit")
        report = before
    found = {(case["name"], case["shaders"]): case for case in report["cases"]}
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        for repetition in range(arguments.repetitions):
            for name, shaders, source in cases(arguments.shaders, arguments.schedules):
                case = found.setdefault((name, shaders), {"name": name, "shaders": shaders, "runs": []})
                if len(case["runs"]) > repetition or time.monotonic() - begin > arguments.seconds:
                    continue
                case["runs"].append(compile_once(command, source, pathlib.Path(folder)))
                report["cases"] = list(found.values())
                part = arguments.output.with_suffix(".part")
                part.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
                part.replace(arguments.output)
    runs = sum(len(case["runs"]) for case in found.values())
    print(f"{runs} of {arguments.repetitions * len(cases(arguments.shaders, arguments.schedules))} compilations are "
          f"in {arguments.output.name}")


if __name__ == "__main__":
    main()
