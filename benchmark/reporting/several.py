# SPDX-License-Identifier: Apache-2.0
"""Tables that take several files: numbers of threads, another library beside this one, compile times."""
import re
import statistics
from collections import defaultdict

from .google_benchmark import Report
from .markdown import table


def threads(*paths, cells=""):
    """The same cells by one thread and more, those in whose names a regular expression is found; a thread's efficiency is
    what it does next to the only one of the first file."""
    reports = sorted(((int(report.context["threads"]), path, report) for path in paths for report in [Report(path)]),
                     key=lambda item: item[0])
    first, _, base = reports[0]
    cells = [key for key in base.times if re.search(cells, "/".join([*key[0], f"n:{key[1]}", f"run:{key[2]}"]))]
    head = ["threads"]
    for (shaders, _, schedule), _, _ in cells:
        head += [f"{schedule}, {shaders.split()[0]}", "efficiency"]
    rows = []
    for count, path, report in reports:
        row = [count]
        for cell in cells:
            _, n, _ = cell
            row += [f"{1000 * report.times[cell] / n:.2f} ns",
                    f"{100 * first * base.times[cell] / (count * report.times[cell]):.0f} %"]
        rows.append(row + [f"[json]({path.name})"])
    return table(head + ["raw"], rows)


def peers(report):
    """What peers/drjit_switch.py has measured."""
    rows = []
    for materials in dict.fromkeys(cell["materials"] for cell in report["cells"]):
        cells = [cell for cell in report["cells"] if cell["materials"] == materials]
        best = min(statistics.median(c["seconds"]) for c in cells if c["what"].startswith("dr"))
        for cell in cells:
            median = statistics.median(cell["seconds"])
            rows.append([materials, cell["what"], f"{1e9 * median / report['n']:.1f}",
                         f"{100 * (max(cell['seconds']) - min(cell['seconds'])) / median:.0f} %", f"{best / median:.2f}"])
    return table(["materials", "what", "ns per request", "spread", "over Dr.Jit's best"], rows)


def compiled_sets(path):
    """Seconds, peak memory and size of an object, of lines `NAME NUMBER SECONDS s user KIB KiB` and `BYTES bytes`
    after those of an object."""
    found, last = defaultdict(lambda: {"s": [], "KiB": []}), None
    for line in path.read_text(encoding="utf-8").splitlines():
        if timed := re.fullmatch(r"(\w+) (\d+) ([\d.]+) s user (\d+) KiB", line):
            last = timed[1], int(timed[2])
            found[last]["s"].append(float(timed[3]))
            found[last]["KiB"].append(int(timed[4]))
        elif sized := re.fullmatch(r"(\d+) bytes", line):
            found[last]["MB"] = int(sized[1]) / 1e6

    def cell(key):
        seconds, mib = statistics.median(found[key]["s"]), statistics.median(found[key]["KiB"]) / 1024
        memory = f"{mib:.0f} MiB" if mib < 1024 else f"{mib / 1024:.2f} GiB"
        size = found[key]["MB"]
        return (f"{seconds:.{1 if seconds < 10 else 0}f} s, {memory}, {size:.{2 if size < 1 else 1}f} MB")
    sets, compilers = (2, 9, 21), {"omp": "g++", "cuda": "nvcc"}
    return table([""] + [f"{s} effects" for s in sets],
                 [[f"`render_{name}.cpp`, {compilers[name]}"] + [cell((name, k)) for k in range(len(sets))]
                  for name in dict.fromkeys(name for name, _ in found)])
