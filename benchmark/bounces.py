#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The time of every bounce of the example path tracer, schedule by schedule, as a Markdown table.

    gltf_path_tracer SCENE --schedule all --report first.json, and once or twice more
    benchmark/bounces.py first.json second.json third.json

Milliseconds of shading for one sample per pixel, medians over the reports, which must have the same
settings. The spread is the largest of (most - least) / median of any number in the table.
"""
import json
import statistics
import sys

from reporting import markdown

BOUNCES = 8


def read(paths):
    reports = []
    for path in paths:
        with open(path, encoding="utf-8") as file:
            reports.append(json.load(file))
    for path, report in zip(paths, reports):
        for key in ("scene", "settings"):
            if report[key] != reports[0][key]:
                sys.exit(f"{path}: its {key} is not that of {paths[0]}")
        names = [s["schedule"] for s in report["schedules"]]
        if names != [s["schedule"] for s in reports[0]["schedules"]]:
            sys.exit(f"{path}: its schedules are not those of {paths[0]}")
    return reports


def table(paths):
    reports = read(paths)
    settings = reports[0]["settings"]
    samples = settings["spp"]
    spread = 0

    def median(numbers):
        nonlocal spread
        middle = statistics.median(numbers)
        if middle > 0:
            spread = max(spread, (max(numbers) - min(numbers)) / middle)
        return middle

    bounces = min(BOUNCES, min(len(s["bounces"]) for r in reports for s in r["schedules"]))
    rows = []
    for index, schedule in enumerate(reports[0]["schedules"]):
        times = [median([r["schedules"][index]["bounces"][b]["total_ms"] / samples for r in reports])
                 for b in range(bounces)]
        rows.append((sum(times), schedule["schedule"], times))
    requests = reports[0]["schedules"][0]["bounces"]
    lines = [["*thousand requests*"] + [f"{requests[b]['requests'] / samples / 1000:.0f}" for b in range(bounces)] + [""]]
    lines += [[f"`{name}`"] + [f"{t:.3f}" for t in times] + [f"{total:.3f}"] for total, name, times in sorted(rows)]
    return "\n\n".join([
        ", ".join([f"{settings['width']} x {settings['height']}"] +
                  [f"{key} {settings[key]}" for key in ("spp", "max_depth", "seed", "backend")] +
                  [f"{len(reports)} runs"]),
        markdown.table(["schedule"] + [f"{b + 1}" for b in range(bounces)] + [f"1 to {bounces}"], lines),
        f"Largest spread: {100 * spread:.0f} %."])


if __name__ == "__main__":
    print(table(sys.argv[1:])) if sys.argv[1:] else sys.exit(__doc__)
