# SPDX-License-Identifier: Apache-2.0
"""Memory bandwidth against the processor: what schedules do between the rate at which memory moves bytes and the rate
at which instructions are issued, from a profiler's counters (counters.py)."""
import statistics

from .counters import read
from .google_benchmark import Report
from .markdown import table
from .paper import SCENES, unsorted
from .schedules import ORACLES, Cells
from .svg import Drawing, LogScale, plain

WIDTH, LEFT, RIGHT, TOP, BOTTOM = 440, 62, 424, 128, 466
# What is shown of each of the paper's sets, and how: a shape for each way, and a colour for each set.
WAYS = {"oracle-launches": ("sorted beforehand", "disc"), "switch": ("as they come", "diamond"),
        "window": ("in windows", "square")}
LOOKS = {scene.name: f"s{k}" for k, scene in enumerate(SCENES)}
RUN = 1
REQUEST = 32 + 16  # bytes that benchmark_schedules loads and stores for a request at least
COPIED = 10  # and that benchmark_grouping's copy does


def chosen(path):
    """{(shaders, way): cell}"""
    cells = read(path)
    return {(scene.name, way): cells[scene.name, way, RUN] for scene in SCENES for way in WAYS}


def roofs(path, grouping):
    """The most bytes per second that a cell or the benchmark's copy moved, that copy's, and the instructions per second
    of warps at which all slots would be taken, by the cell that took the most of them."""
    shown = chosen(path).values()
    times = Report(grouping).times
    copy = max(COPIED * n / time * 1e6 for ((_, way), n, _), time in times.items() if way == "copy-5-bytes")
    busiest = max(shown, key=lambda cell: cell.mean("issue_percent"))
    issue = busiest.total("instructions") / busiest.seconds() / (busiest.mean("issue_percent") / 100)
    return max([copy] + [cell.bytes() / cell.seconds() for cell in shown]), copy, issue


def counters(path, grouping):
    memory, copy, issue = roofs(path, grouping)
    rows = []
    for (shaders, way), cell in chosen(path).items():
        of_memory, of_slots = cell.bytes() / cell.seconds() / memory, cell.mean("issue_percent") / 100
        rows.append([shaders, WAYS[way][0], f"{cell.intensity():.3f}", f"{100 * of_memory:.0f} %",
                     f"{100 * of_slots:.0f} %", "memory" if of_memory > of_slots else "instructions"])
    head = ["shaders", "requests", "warp instructions per byte", "of the bytes per second",
            "of the slots for instructions", "nearer to its roof"]
    return table(head, rows) + (
        f"\n\nRoofs: {memory / 1e12:.2f} TB/s, the most that was measured (the benchmark's copy: {copy / 1e12:.2f}), "
        f"and {issue / 1e9:.0f} thousand million instructions of warps per second; they meet at {issue / memory:.2f} "
        "instructions per byte.")


def shares_of(schedules, grouping, n):
    """{(shaders, kind): (sorted beforehand, as they come, by `local`)} of a machine without counters: bytes of n
    requests per second, over those of the copy that moves the next larger number of bytes."""
    times = Report(grouping).times
    copies = {size for (_, way), size, _ in times if way == "copy-5-bytes" and COPIED * size >= REQUEST * n}
    copy = statistics.median(COPIED * size / time for ((_, way), size, _), time in times.items()
                             if way == "copy-5-bytes" and size == min(copies))
    cells, found = Cells(Report(schedules).times), {}
    for scene in SCENES:
        for kind, rows in cells.rows[scene.name, n, RUN].items():
            ways = min(rows[name] for name in ORACLES), unsorted(rows), rows["local"]
            found[scene.name, kind] = [REQUEST * n / time / copy for time in ways]
    return found


def shares(schedules, grouping, n):
    found = shares_of(schedules, grouping, int(n))
    return table(["shaders", "kind", "sorted beforehand", "as they come", "by `local`"],
                 [[*key] + [f"{100 * share:.0f} %" for share in row] for key, row in found.items()])


def plot(path, grouping):
    memory, _, issue = roofs(path, grouping)
    x = LogScale(0.015, 6, LEFT, RIGHT)
    y = LogScale(40e9, 1.6e12, BOTTOM, TOP)
    d = Drawing(WIDTH, BOTTOM + 54, "Instructions per second over instructions per byte on one NVIDIA H200")
    d.text(8, 20, "NVIDIA H200, 8 Mi index requests, random ids", "strong")
    for k, (words, shape) in enumerate(WAYS.values()):
        d.mark(shape, 16 + 150 * k, 40, "s5")
        d.text(26 + 150 * k, 45, words, "small")
    for k, (name, look) in enumerate(LOOKS.items()):
        column, row = (0, k) if k < 3 else (1, k - 3)
        d.rect(11 + 215 * column, 57 + 20 * row, 11, 11, f"fill {look}")
        d.text(28 + 215 * column, 67 + 20 * row, name, "small")
    for value in x.round_values():
        d.line([(x(value), TOP), (x(value), BOTTOM)], "grid")
        d.text(x(value), BOTTOM + 17, plain(value), "small soft", "middle")
    for value in y.round_values():
        d.line([(LEFT, y(value)), (RIGHT, y(value))], "grid")
        d.text(LEFT - 6, y(value) + 4, plain(value / 1e9), "small soft", "end")
    d.text((LEFT + RIGHT) / 2, BOTTOM + 40, "instructions of warps per byte of memory", "", "middle")
    d.text(14, (TOP + BOTTOM) / 2, "instructions of warps, 10⁹ per second", "", "middle", turned=True)
    d.line([(x(x.low), y(max(memory * x.low, y.low))), (x(issue / memory), y(issue)), (x(x.high), y(issue))], "line s5")
    d.text(x(x.high) - 4, y(issue) - 8, "issue of instructions", "small", "end")
    d.text(x(0.1) - 8, y(memory * 0.1), "memory", "small", "end")
    for (shaders, way), cell in chosen(path).items():
        words, shape = WAYS[way]
        here = x(cell.intensity()), y(cell.total("instructions") / cell.seconds())
        d.mark(shape, *here, LOOKS[shaders], f"{shaders}, {words}")
    return d.render()
