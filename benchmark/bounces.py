#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The time of every bounce of the example path tracer, schedule by schedule, as a Markdown table.

    path_tracer SCENE --schedule all --report first.json, and once or twice more
    benchmark/bounces.py first.json second.json third.json

Milliseconds of shading for one sample per pixel, medians over the reports, which must have the same
settings. The spread is the largest of (most - least) / median of any number in the table.
"""
import json
import statistics
import sys

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


def main(paths):
    if not paths:
        sys.exit(__doc__)
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

    print(", ".join([f"{settings['width']} x {settings['height']}"] +
                    [f"{key} {settings[key]}" for key in ("spp", "max_depth", "seed", "backend")] +
                    [f"{len(reports)} runs"]) + "\n")
    print("| schedule | " + " | ".join(f"{b + 1}" for b in range(bounces)) +
          f" | 1 to {bounces} |\n" + "|---" * (bounces + 2) + "|")
    print("| *thousand requests* | " + " | ".join(
        f"{requests[b]['requests'] / samples / 1000:.0f}" for b in range(bounces)) + " | |")
    for total, name, times in sorted(rows):
        print(f"| `{name}` | " + " | ".join(f"{t:.3f}" for t in times) + f" | {total:.3f} |")
    print(f"\nLargest spread: {100 * spread:.0f} %.")


if __name__ == "__main__":
    main(sys.argv[1:])
