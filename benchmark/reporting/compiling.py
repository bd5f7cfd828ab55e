# SPDX-License-Identifier: Apache-2.0
"""Tables of what compile_time.py has measured."""
import json
import statistics

from .markdown import table


def median_of(case, what):
    return statistics.median(run[what] for run in case["runs"])


def cell(case):
    seconds = [run["cpu_seconds"] for run in case["runs"]]
    spread = (max(seconds) - min(seconds)) / statistics.median(seconds)
    return (f"{statistics.median(seconds):.2f} s" + (f" ± {50 * spread:.0f} %" if len(seconds) > 1 else "") +
            f", {median_of(case, 'peak_kib') / 1024:.0f} MiB")


def compile_time(path):
    """Headers alone, then every schedule over every size of table."""
    with open(path, encoding="utf-8") as file:
        report = json.load(file)
    context, cases = report["context"], report["cases"]
    alone = [case for case in cases if case["shaders"] == 0]
    sizes = sorted({case["shaders"] for case in cases} - {0})
    found = {(case["name"], case["shaders"]): case for case in cases}
    names = list(dict.fromkeys(case["name"] for case in cases if case["shaders"]))
    before = next(case for case in alone if case["name"] == "Thrust's policies")
    repetitions = {len(case["runs"]) for case in cases}
    counts = f"{min(repetitions)} to {max(repetitions)}" if len(repetitions) > 1 else str(max(repetitions))
    parts = [", ".join(f"{key} {value}" for key, value in context.items()) + f", repetitions {counts}",
             table(["includes", "processor time, peak memory", "more than Thrust's policies"],
                   [[case["name"], cell(case),
                     f"{median_of(case, 'cpu_seconds') - median_of(before, 'cpu_seconds'):+.2f} s"] for case in alone])]
    if names:
        parts.append(table(["schedule"] + [f"{size} shaders" for size in sizes],
                           [[f"`{name}`"] + [cell(found[name, size]) if (name, size) in found else "not measured"
                                             for size in sizes] for name in names]))
    return "\n\n".join(parts)
