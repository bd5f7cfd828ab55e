# SPDX-License-Identifier: Apache-2.0
"""Runs the benchmarks of a build, and writes a page about them."""
import json
import os
import subprocess
import sys

from .google_benchmark import Report, without_names
from .pages import Pages
from .views import PLOTS, VIEWS


def output_of(*words):
    """What a program says, or "unknown" where there is none."""
    try:
        return subprocess.run(words, capture_output=True, text=True, check=True).stdout.strip() or "unknown"
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def commit_of(root):
    """The commit of a checkout, and whether its files are others."""
    changed = output_of("git", "-C", str(root), "status", "--porcelain", "--untracked-files=no") != "unknown"
    return output_of("git", "-C", str(root), "rev-parse", "--short", "HEAD") + "-changed" * changed


def without_places(path):
    """Takes the name of the host and the way to the program out of a report, and means and the like, which follow from
    the repetitions."""
    report = json.loads(path.read_text(encoding="utf-8"))
    report["context"] = without_names(report["context"])
    report["benchmarks"] = [cell for cell in report["benchmarks"] if cell.get("run_type") != "aggregate"]
    path.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")


def measure(program, out, root, arguments):
    """Runs one program; what it measured on is in the context of its report."""
    context = {"commit": commit_of(root)}
    driver = output_of("nvidia-smi", "--query-gpu=driver_version", "--format=csv,noheader")
    if driver != "unknown":
        context["driver"] = driver.splitlines()[0]
    command = [str(program), f"--benchmark_out={out}", "--benchmark_out_format=json",
               f"--benchmark_repetitions={arguments.repetitions}",
               "--benchmark_context=" + ",".join(f"{k}={v}" for k, v in context.items())]
    command += [f"--benchmark_filter={arguments.filter}"] * bool(arguments.filter) + ["--quick"] * arguments.quick
    threads = {"OMP_NUM_THREADS": str(os.cpu_count()), "OMP_PROC_BIND": "spread", "OMP_WAIT_POLICY": "active"}
    print(f"{program.name} runs", flush=True)
    return subprocess.run(command, env={**threads, **os.environ}, check=False, stdout=subprocess.DEVNULL).returncode


def plots_of(name, report):
    """(words of a marker, what is to be seen) of what could be drawn of a report."""
    sizes, runs = ({key[k] for key in report.times} for k in (1, 2))
    if name == "schedules":
        shown = sorted(runs)[:1] + [run for run in sorted(runs) if run >= 32][:1]
        return [(f"speedups {name}.json n={max(sizes)} runs={','.join(map(str, shown))}", "Speedup of every schedule")]
    if name == "grouping":
        return [(f"scaling {name}.json n={max(sizes)} shaders=11", "Time of grouping")]
    return []


def page_of(found, out, again):
    """A page of markers for some reports, {name: Report}, filled in."""
    parts = ["# Benchmarks of one machine", f"Made by `{again}`."]
    pages = Pages([out / "report.md"], out, VIEWS, PLOTS)
    for name, report in found.items():
        parts.append(f"## {name}")
        for words, seen in plots_of(name, report):
            try:
                pages.make(words, PLOTS)
            except ValueError as error:  # not all that it draws was measured
                print(f"no plot of {name}: {error}")
                continue
            parts.append(f"<!-- plot: {words} -->\n![{seen}]({name}.svg)")
        parts.append(f"<!-- report: ratios {name}.json headings=3 -->\n<!-- end of report -->")
    (out / "report.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")
    for path, text in list(pages.stale()):
        path.write_text(text, encoding="utf-8")


def run(build, out, root, arguments):
    """Runs all benchmarks of a build; the exit status."""
    programs = sorted(path for folder in (build, build / "benchmark") for path in folder.glob("benchmark_*")
                      if path.is_file() and os.access(path, os.X_OK))
    if not programs:
        sys.exit(f"{build} has no benchmarks: they need Google Benchmark and DEFERRED_SHADE_BUILD_BENCHMARKS")
    out.mkdir(parents=True, exist_ok=True)
    found, failed = {}, []
    for program in programs:
        name = program.name.removeprefix("benchmark_")
        path, part = out / f"{name}.json", out / f"{name}.json.part"
        if measure(program, part, root, arguments) != 0:
            failed.append(program.name)
        if part.is_file() and part.stat().st_size:  # nothing is left where a filter left out every cell
            without_places(part)
            part.replace(path)
            report = Report(path)
            if report.times:
                found[name] = report
    page_of(found, out, "benchmark/report.py --run")
    print(f"{', '.join(found) or 'nothing'} in {(out / 'report.md').relative_to(root)}")
    return f"failed: {', '.join(failed)}" if failed else 0
