# SPDX-License-Identifier: Apache-2.0
"""Tables of benchmark_schedules."""
from collections import defaultdict

from .google_benchmark import geometric_mean
from .markdown import size, table

ORACLES = ("oracle-launches", "oracle-switch")
CONTROLS = ORACLES + ("known-counts", "switch")


class Cells:
    """A cell is a set of shaders, a number of requests and a run length, and has a time for every row of either
    kind of shaders."""

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
        return min(((time, name) for time, row, name in self.times(cell, kinds) if row not in without), default=None)

    def oracle(self, cell, kinds):
        return min((time for time, row, _ in self.times(cell, kinds) if row in ORACLES), default=None)

    def by_run(self, ratio, sizes):
        """`ratio(cell)`, a number and a note, in a table of sets and sizes against run lengths, then the means
        and the worst cells."""
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
            return "No such rows in the report."
        means = [(f"run {run}", [v for (_, _, r), (v, _) in found.items() if r == run])
                 for run in self.runs] + [("all", [v for v, _ in found.values()])]
        worst = sorted(found.items(), key=lambda item: -item[1][0])[:5]
        return "\n\n".join([
            table(["shaders", "n"] + [f"run {run}" for run in self.runs], rows),
            table(["geometric mean"] + [name for name, values in means if values],
                  [[""] + [f"{geometric_mean(values):.3f}" for _, values in means if values]]),
            "Largest: " + "; ".join(f"{value:.2f} ({shaders}, {size(n)}, run {run})"
                                    for (shaders, n, run), (value, _) in worst)])


def over_controls(times):
    """(title, text) of each table of a GPU: next to the oracle, to known counts and to a plain switch."""
    cells, sections = Cells(times), []
    large = [n for n in cells.sizes if n >= 1 << 20] or cells.sizes

    for title, kinds in (("index shaders", ["index"]), ("record shaders", ["record"]),
                         ("the better kind of shaders", ["index", "record"])):
        def over_oracle(cell, kinds=kinds):
            best, oracle = cells.best(cell, kinds), cells.oracle(cell, kinds)
            return (best[0] / oracle, best[1]) if best and oracle else None
        sections.append((f"Best schedule over the better oracle, {title}", cells.by_run(over_oracle, large)))

    for kind in ("index", "record"):
        def over_known(cell, kind=kind):
            rows = cells.rows[cell][kind]
            if "bucket+explicit" not in rows or "known-counts" not in rows:
                return None
            return rows["bucket+explicit"] / rows["known-counts"], ""
        sections.append(("Launches per shader without the counts on the host over the same with them, "
                         f"{kind} shaders", cells.by_run(over_known, cells.sizes)))

    run = cells.runs[0]
    for kind in ("record", "index"):
        rows = []
        for shaders in cells.sets:
            row = [shaders]
            for n in cells.sizes:
                unsorted = cells.rows[shaders, n, run][kind].get("switch")
                best = cells.best((shaders, n, run), [kind])
                row.append(f"{unsorted / best[0]:.2f} {best[1]}" if unsorted and best else "")
            rows.append(row)
        sections.append((f"Speedup of the best schedule over a plain switch, unsorted, {kind} shaders, run {run}",
                         table(["shaders"] + [size(n) for n in cells.sizes], rows)))
    return sections


def over_switch(times):
    """The same of a CPU, which has no controls: every row over the switch."""
    cells, sections = Cells(times), []
    kinds = list(dict.fromkeys(kind for cell in cells.rows.values() for kind in cell))
    for kind in kinds:
        schedules = list(dict.fromkeys(row for cell in cells.rows.values() for row in cell[kind]
                                       if row not in CONTROLS and row != "implicit"))
        rows = []
        for run in cells.runs:
            for shaders in cells.sets:
                for n in cells.sizes:
                    row = cells.rows[shaders, n, run][kind]
                    if "implicit" in row:
                        rows.append([run, shaders, size(n), f"{1000 * row['implicit'] / n:.1f}"] +
                                    [f"{row['implicit'] / row[s]:.2f}" if s in row else "" for s in schedules])
        sections.append((f"Speedup over unsorted implicit_serialization, {kind} shaders",
                         table(["run", "shaders", "n", "implicit, ns per request"] + schedules, rows)))
    return sections
