#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tables of ratios, as Markdown, from the reports of the benchmarks.

    benchmark_schedules --benchmark_out=schedules.json
    benchmark_grouping --benchmark_out=grouping.json
    benchmark/ratios.py schedules.json grouping.json

and of benchmark_vectors and benchmark_simd alike.

Every ratio is of two medians of one report, and of its repetitions where it has several
(--benchmark_repetitions). Exits with 1 where a cell of a report has an error.
"""
import json
import math
import statistics
import sys
from collections import defaultdict

MICROSECONDS = {"ns": 1e-3, "us": 1.0, "ms": 1e3, "s": 1e6}
ORACLES = ("oracle-launches", "oracle-switch")
CONTROLS = ORACLES + ("known-counts", "switch")


def read(path):
    """The times of a report in µs, {(path of names, n, run): µs}, its context, its errors, and the
    spread of every cell that has repetitions: what lies between its extremes, over its median."""
    with open(path, encoding="utf-8") as file:
        report = json.load(file)
    times, errors = defaultdict(list), []
    for cell in report["benchmarks"]:
        if cell.get("run_type") == "aggregate":
            continue
        if cell.get("error_occurred"):
            errors.append(f"{cell['name']}: {cell.get('error_message', '')}")
            continue
        parts = cell["name"].split("/")
        values = dict(part.split(":", 1) for part in parts if ":" in part)
        names = tuple(part for part in parts if ":" not in part and part != "manual_time")
        times[names, int(values["n"]), int(values["run"])].append(
            cell["real_time"] * MICROSECONDS[cell["time_unit"]])
    medians = {cell: statistics.median(found) for cell, found in times.items()}
    spreads = [(max(found) - min(found)) / medians[cell]
               for cell, found in times.items() if len(found) > 1]
    return medians, report["context"], errors, spreads


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def size(n):
    return f"{n >> 20} Mi" if n % (1 << 20) == 0 else f"{n >> 10} Ki"


def table(head, rows):
    print("| " + " | ".join(head) + " |\n" + "|---" * len(head) + "|")
    for row in rows:
        print("| " + " | ".join(map(str, row)) + " |")
    print()


class Cells:
    """The report of the schedules: a cell is a set of shaders, a number of requests and a run length,
    and has a time for every row of either kind of shaders."""

    def __init__(self, times):
        self.rows = defaultdict(lambda: defaultdict(dict))
        for ((shaders, kind, row), n, run), time in times.items():
            self.rows[shaders, n, run][kind][row] = time
        self.sets = list(dict.fromkeys(key[0] for key in self.rows))
        self.sizes = sorted({key[1] for key in self.rows})
        self.runs = sorted({key[2] for key in self.rows})

    def times(self, cell, kinds):
        """(time, name of the row) of every row of some kinds of shaders."""
        short = len(kinds) == 1
        return [(time, row, row if short else f"{row}, {kind}")
                for kind in kinds for row, time in self.rows[cell][kind].items()]

    def best(self, cell, kinds, without=CONTROLS):
        """The least time of a schedule and the schedule's name."""
        found = [(time, name) for time, row, name in self.times(cell, kinds)
                 if row not in without]
        return min(found, default=None)

    def oracle(self, cell, kinds):
        return min((time for time, row, _ in self.times(cell, kinds) if row in ORACLES),
                   default=None)

    def by_run(self, ratio, sizes):
        """Prints `ratio(cell)`, a number and a note, in a table of sets and sizes against run
        lengths, then the means and the worst cells."""
        found, rows = {}, []
        for n in sizes:
            for shaders in self.sets:
                row = [shaders, size(n)]
                for run in self.runs:
                    cell = shaders, n, run
                    value = ratio(cell) if cell in self.rows else None
                    if value:
                        found[cell] = value
                    row.append(f"{value[0]:.2f} {value[1]}".strip() if value else "")
                rows.append(row)
        if not found:
            print("No such rows in the report.\n")
            return
        table(["shaders", "n"] + [f"run {run}" for run in self.runs], rows)
        means = [(f"run {run}", [v for (_, _, r), (v, _) in found.items() if r == run])
                 for run in self.runs] + [("all", [v for v, _ in found.values()])]
        table(["geometric mean"] + [name for name, values in means if values],
              [[""] + [f"{geometric_mean(values):.3f}" for _, values in means if values]])
        worst = sorted(found.items(), key=lambda item: -item[1][0])[:5]
        print("Largest: " + "; ".join(f"{value:.2f} ({shaders}, {size(n)}, run {run})"
                                      for (shaders, n, run), (value, _) in worst) + "\n")


def print_schedules(times):
    cells = Cells(times)
    large = [n for n in cells.sizes if n >= 1 << 20] or cells.sizes

    for title, kinds in (("index shaders", ["index"]), ("record shaders", ["record"]),
                         ("the better kind of shaders", ["index", "record"])):
        def over_oracle(cell, kinds=kinds):
            best, oracle = cells.best(cell, kinds), cells.oracle(cell, kinds)
            return (best[0] / oracle, best[1]) if best and oracle else None
        print(f"## Best schedule over the better oracle, {title}\n")
        cells.by_run(over_oracle, large)

    for kind in ("index", "record"):
        def over_known(cell, kind=kind):
            rows = cells.rows[cell][kind]
            if "bucket+explicit" not in rows or "known-counts" not in rows:
                return None
            return rows["bucket+explicit"] / rows["known-counts"], ""
        print("## Launches per shader without the counts on the host over the same with them, "
              f"{kind} shaders\n")
        cells.by_run(over_known, cells.sizes)

    run = cells.runs[0]
    for kind in ("record", "index"):
        print(f"## Speedup of the best schedule over a plain switch, unsorted, {kind} shaders, run {run}\n")
        rows = []
        for shaders in cells.sets:
            row = [shaders]
            for n in cells.sizes:
                unsorted = cells.rows[shaders, n, run][kind].get("switch")
                best = cells.best((shaders, n, run), [kind])
                row.append(f"{unsorted / best[0]:.2f} {best[1]}" if unsorted and best else "")
            rows.append(row)
        table(["shaders"] + [size(n) for n in cells.sizes], rows)


def print_over_switch(times):
    """For CPUs, where there is no oracle: every row over the switch."""
    cells = Cells(times)
    kinds = list(dict.fromkeys(kind for cell in cells.rows.values() for kind in cell))
    for kind in kinds:
        schedules = list(dict.fromkeys(row for cell in cells.rows.values() for row in cell[kind]
                                       if row not in CONTROLS and row != "implicit"))
        print(f"## Speedup over unsorted implicit_serialization, {kind} shaders\n")
        rows = []
        for run in cells.runs:
            for shaders in cells.sets:
                for n in cells.sizes:
                    row = cells.rows[shaders, n, run][kind]
                    if "implicit" not in row:
                        continue
                    rows.append([run, shaders, size(n), f"{1000 * row['implicit'] / n:.1f}"] +
                                [f"{row['implicit'] / row[s]:.2f}" if s in row else ""
                                 for s in schedules])
        table(["run", "shaders", "n", "implicit, ns per request"] + schedules, rows)


def print_grouping(times):
    cells = defaultdict(dict)
    for ((shaders, way), n, run), time in times.items():
        cells[run, int(shaders.split()[0]), n][way] = time
    ways = list(dict.fromkeys(way for ways in cells.values() for way in ways))
    print("## Grouping alone, µs\n")
    print("5 bytes: what an id and an index per request take at the rate of the copy, which moves 10."
          "\n")
    has_cub = "cub-radix-sort" in ways
    head = (["run", "shaders", "n"] + ways + ["CUB / bucket"] * has_cub + ["bucket / 5 bytes"])
    rows = []
    for (run, shaders, n), row in sorted(cells.items()):
        def ratio(above, below, factor, row=row):
            return f"{factor * row[above] / row[below]:.2f}" if {above, below} <= set(row) else ""
        rows.append([run, shaders, size(n)] + [f"{row[w]:.1f}" if w in row else "" for w in ways] +
                    [ratio("cub-radix-sort", "bucket", 1)] * has_cub +
                    [ratio("bucket", "copy-5-bytes", 2)])
    table(head, rows)


def print_ways(times):
    """Ways to run one shader over packed records."""
    ways = {way: 1000 * time / n for ((_, way), n, _), time in times.items()}
    print("## Ways to vectors, ns per request\n")
    table(["way", "ns", "faster than scalar"],
          [[way, f"{time:.2f}", f"{ways['scalar'] / time:.1f}" if "scalar" in ways else ""]
           for way, time in ways.items()])


def main(paths):
    if not paths:
        sys.exit(__doc__)
    failed = False
    for path in paths:
        times, context, errors, spreads = read(path)
        keys = ("date", "machine", "cuda_driver", "cuda_runtime", "nvcc", "compiler", "vectors",
                "threads", "thrust", "deferred_shade", "commit")
        print(", ".join(f"{key} {context[key]}" for key in keys if key in context) + "\n")
        if spreads:
            print("Medians of repetitions. Between the extremes of a cell lie "
                  f"{100 * statistics.median(spreads):.0f} % of its median, of the least certain one "
                  f"{100 * max(spreads):.0f} %.\n")
        for error in errors:
            failed = True
            print(f"Error in {error}\n")
        if not times:
            continue
        names = next(iter(times))[0]
        if names[0] == "stone":
            print_ways(times)
        elif len(names) == 2:
            print_grouping(times)
        elif "cuda_driver" in context:
            print_schedules(times)
        else:
            print_over_switch(times)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
