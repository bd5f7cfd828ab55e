#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the figures of docs/concepts.md beside this file; with --check, only compares them.

Every number in them is counted by lanes.py, which runs the batch.
"""
import argparse
import pathlib
import sys

import lanes
from lanes import SHADERS, WARP, BATCH
from picture import CELL, LEFT, Picture, column

EVERYONE = range(len(BATCH))


def batch():
    p = Picture("A batch of sixteen requests, four shaders, four lanes per warp")
    p.head("A batch: requests, each with a shader")
    p.requests(EVERYONE)
    p.warps([f"warp {w}" for w in range(len(BATCH) // WARP)])
    p.head("What a shader takes")
    p.costs()
    return p


def divergence():
    p = Picture("Two warps in time, one of four shaders and one of a single shader")
    mixed, alike = lanes.warps_of(range(4, 8)), lanes.warps_of([2, 6, 8, 13])
    p.head("Four shaders in a warp")
    p.text(column(8), p.y - 5, "One shader in a warp", "head")
    p.requests([*mixed[0].requests, None, None, None, None, *alike[0].requests])
    # Only the warps that there are: between them is nothing.
    p.out = [line for line in p.out if 'class="none"' not in line]
    p.head("in time, step by step:")
    top = p.y
    p.time(alike, 2 * WARP)
    p.y = top
    p.time(mixed)
    for name, warp, x in (("mixed", mixed, LEFT), ("alike", alike, column(8))):
        run = lanes.Run([warp])
        p.text(x, p.y + 18, f"{run.active()} of {run.held()} lane-steps")
        p.text(x, p.y + 34, f"are work: {run.efficiency():.0%}")
    p.space(34)
    return p


def implicit():
    p = Picture("Implicit serialisation: one launch with a switch")
    run = lanes.schedules()["implicit"]
    p.head("One launch, requests as they come")
    p.requests(EVERYONE)
    p.head("The switch: shaders take turns in every warp")
    p.time(run.warps())
    p.result(run)
    return p


def explicit():
    p = Picture("Explicit serialisation: one masked launch per shader")
    run = lanes.schedules()["explicit"]
    for shader, launch in zip(SHADERS, run.launches):
        p.head(f"Launch {shader}: every request is looked at")
        for position in EVERYONE:
            p.cell(position, BATCH[position], None if BATCH[position] == shader else "off")
        p.y += CELL
        p.space(4)
        p.time(launch)
    p.result(run)
    return p


def compact():
    p = Picture("Stream compaction, once per shader: select, scan, scatter")
    order = lanes.compacted()
    flags, places = lanes.compaction_of("A")
    p.head("The batch")
    p.requests(EVERYONE)
    p.head("Select A: a flag for each request")
    p.numbers(flags)
    p.head("Scan: how many flags came before it")
    p.numbers(places)
    p.head("Scatter: the scan says the place")
    size = sum(flags)
    p.requests(order[:size] + [None] * (len(BATCH) - size))
    for number, shader in enumerate(SHADERS[1:], 1):
        size += sum(lanes.compaction_of(shader)[0])
        p.head(f"The same for {shader}")
        p.requests(order[:size] + [None] * (len(BATCH) - size), indices=shader == SHADERS[-1])
    return p


def sort():
    p = Picture("A radix sort of ids and indices, bit by bit")
    heads = ["Below each index: the lower bit of the id", "Pass 1: by the lower bit. Below: the upper bit",
             "Pass 2: by the upper bit"]
    for number, (head, order) in enumerate(zip(heads, lanes.radix_passes())):
        p.head(head)
        p.requests(order)
        if number + 1 < len(heads):
            p.numbers([SHADERS.index(BATCH[r]) >> number & 1 for r in order])
    return p


def table(p, rows, names):
    """Numbers by shader, a row per tile."""
    for position, shader in enumerate(SHADERS, 4):
        p.cell(position, shader)
    p.y += CELL
    for name, row in zip(names, rows):
        p.text(LEFT, p.y + 11, name)
        p.numbers(row, 4)


def bucket():
    p = Picture("Bucketing: count, scan, place")
    counts, places = lanes.bucket_tables()
    names = [f"tile {t}" for t in range(len(counts))]
    p.head("The batch, cut into tiles")
    p.requests(EVERYONE)
    p.warps(names, lanes.TILE)
    p.head("Every tile counts its shaders")
    table(p, counts, names)
    p.head("A scan down the columns: first places")
    table(p, places, names)
    p.head("Every tile puts its requests there")
    p.requests(lanes.bucketed())
    return p


def dispatch():
    p = Picture("A grouped batch, dispatched by a switch and by a launch per shader")
    runs = lanes.schedules()
    p.head("The grouped batch")
    p.requests(lanes.bucketed())
    run = runs["compact, sort or bucket, implicit"]
    p.head("Implicit: one launch, warps cross borders")
    p.time(run.warps())
    p.result(run)
    run = runs["compact, sort or bucket, explicit"]
    p.head("Explicit: a launch for each shader")
    y, start = p.y, 0
    for shader, launch in zip(SHADERS, run.launches):
        if start + len(launch) * WARP > len(BATCH):
            y, start = bottom + 4, 0
        p.y = y
        p.text(column(start), y + 12, f"launch {shader}", "say small")
        p.y += 16
        p.time(launch, start)
        bottom = p.y if start == 0 else max(bottom, p.y)
        start += len(launch) * WARP
    p.y = bottom
    p.result(run)
    return p


def local():
    p = Picture("Sorting inside tiles, then a switch or rows of one shader")
    names = [f"tile {t}" for t in range(len(lanes.tiles()))]
    p.head("The batch, cut into tiles")
    p.requests(EVERYONE)
    p.head("Each tile sorted by itself, near its lanes")
    p.requests(sum(lanes.sorted_tiles(), []))
    p.warps(names, lanes.TILE)
    run = lanes.schedules()["local-bitonic"]
    p.head("Then the switch")
    p.time(run.warps())
    p.result(run)
    run = lanes.schedules()["local"]
    p.head("Or shader by shader, a row at a time")
    for name, tile in zip(names, run.launches):
        p.text(LEFT, p.y + 12, name, "say small")
        p.y += 16
        p.time(tile)
    p.result(run)
    return p


def window():
    p = Picture("A window: tiles add up each other's counts, and the switch runs over the result")
    counts = lanes.bucket_tables()[0]
    names = [f"tile {t}" for t in range(len(counts))]
    p.head("One window of a batch, cut into tiles")
    p.requests(EVERYONE)
    p.warps(names, lanes.TILE)
    p.head("1: every tile counts its shaders")
    table(p, counts, names)
    p.head("2: a tile adds up its window, and places")
    p.requests(lanes.bucketed())
    run = lanes.schedules()["window"]
    p.head("3: the switch, window by window")
    p.time(run.warps())
    p.result(run)
    return p


def efficiency():
    p = Picture("The share of lane-steps that are work, for every schedule")
    p.head("Lane-steps that are work, of this one batch")
    for name, run in lanes.schedules().items():
        p.bar(name, run)
    return p


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare the files instead of writing them")
    check = parser.parse_args().check
    lanes.check()
    here = pathlib.Path(__file__).resolve().parent
    figures = {f"{f.__name__}.svg": f().svg() for f in (batch, divergence, implicit, explicit, compact, sort, bucket,
                                                        dispatch, local, window, efficiency)}
    stale = [path.name for path in here.glob("*.svg") if path.name not in figures]
    for name, text in figures.items():
        path = here / name
        if not check:
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            stale.append(name)
    if stale:
        sys.exit(f"not what docs/figures/draw.py draws: {', '.join(sorted(stale))}")
    print(f"{len(figures)} figures are what the script draws" if check else f"{len(figures)} figures")


if __name__ == "__main__":
    main()
