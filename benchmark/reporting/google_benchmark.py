# SPDX-License-Identifier: Apache-2.0
"""Reads the reports that the C++ benchmarks write."""
import functools
import json
import math
import re
import statistics
from collections import defaultdict

MICROSECONDS = {"ns": 1e-3, "us": 1.0, "ms": 1e3, "s": 1e6}
CONTEXT = ("date", "machine", "driver", "cuda_driver", "cuda_runtime", "nvcc", "compiler", "vectors", "threads", "thrust",
           "deferred_shade", "commit")


@functools.cache  # many sentences ask the same file
class Report:
    """`times`, {(path of names, n, run): µs}, medians of repetitions where there are several; `ranges`, of the
    same keys: least and most of the repetitions, or the tenths of the calls that a single one kept; `spreads`
    of the cells with repetitions, what lies between their extremes over the median; `repetitions`, how many of each
    cell; `context` and `errors`."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            report = json.load(file)
        self.context, self.errors, self.ranges = report["context"], [], {}
        found = defaultdict(list)
        # In the order of the program, if repetitions ran in another (--benchmark_enable_random_interleaving).
        for cell in sorted(report["benchmarks"], key=lambda cell: cell.get("family_index", 0)):
            if cell.get("run_type") == "aggregate":
                continue
            if cell.get("error_occurred"):
                self.errors.append(f"{cell['name']}: {cell.get('error_message', '')}")
                continue
            parts = cell["name"].split("/")
            values = dict(part.split(":", 1) for part in parts if ":" in part)
            names = tuple(part for part in parts if ":" not in part and part != "manual_time")
            key = names, int(values["n"]), int(values.get("run", 1))
            found[key].append(cell["real_time"] * MICROSECONDS[cell["time_unit"]])
            if "p10_us" in cell:
                self.ranges[key] = cell["p10_us"], cell["p90_us"]
        self.repetitions = {key: len(values) for key, values in found.items()}
        self.times = {key: statistics.median(values) for key, values in found.items()}
        several = {key: values for key, values in found.items() if len(values) > 1}
        self.ranges.update((key, (min(values), max(values))) for key, values in several.items())
        self.spreads = [(max(values) - min(values)) / self.times[key] for key, values in several.items()]

    def provenance(self):
        """What was measured and on what, the spread, and the errors, as paragraphs."""
        lines = [", ".join(f"{key} {self.context[key]}" for key in CONTEXT if key in self.context)]
        if self.spreads:
            lines.append("Medians of repetitions. Those of a typical cell differ by "
                         f"{100 * statistics.median(self.spreads):.0f} % of its median, of the worst by "
                         f"{100 * max(self.spreads):.0f} %.")
        return "\n\n".join(lines + [f"Error in {error}" for error in self.errors])


def without_names(context):
    """The context of a report without the name of the host and the way to the program."""
    return {**context, "host_name": "", "executable": context["executable"].rsplit("/", 1)[-1]}


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def machine_of(context):
    """The machine's name, short enough for a title."""
    name = re.sub(r"\((R|TM|C)\)| (CPU|Processor)\b|@.*", "", context["machine"]).strip()
    return name if len(name) <= 24 else name[:23] + "…"
