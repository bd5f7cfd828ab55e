# SPDX-License-Identifier: Apache-2.0
"""Memory bandwidth against the processor: kernels between the rate at which memory moves bytes and the rate at which
instructions are issued, from a profiler's counters."""
import re
from dataclasses import dataclass

from .google_benchmark import Report
from .markdown import table
from .svg import Drawing, LogScale, plain

WIDTH, LEFT, RIGHT, TOP, BOTTOM = 440, 58, 424, 62, 400


@dataclass(frozen=True)
class Kernel:
    name: str
    time: float           # s
    instructions: float   # of warps
    bytes: float          # to and from memory
    issue: float          # the share of the slots for instructions that is taken

    def rate(self):
        return self.instructions / self.time

    def intensity(self):
        return self.instructions / self.bytes


def kernels(path):
    """[kernel] of each table of counters of a text: a row of names above columns that end where they end, then a row
    for each counter."""
    found, lines = [], path.read_text(encoding="utf-8").splitlines()
    for first, line in enumerate(lines):
        if not line.startswith("time, us  "):
            continue
        ends = [len("time, us")] + [m.end() for m in re.finditer(r"\S+", line)][2:]
        rows = {}
        for row in lines[first:]:
            if not (cut := re.match(r"(\S.*?)  +(\S.*)", row)):
                break
            rows[cut[1]] = cut[2].split()
        found.append([])
        for k, (begin, end) in enumerate(zip(ends, ends[1:])):
            time, count, read, written, busy = (float(rows[row][k]) for row in (
                "time, us", "warp instructions, M", "memory read, MB", "memory written, MB", "issue slots busy, %"))
            found[-1].append(Kernel(lines[first - 1][begin:end].strip(), time * 1e-6, count * 1e6,
                                    (read + written) * 1e6, busy / 100))
    return found


def chosen(path):
    """The kernels to show, by a name that says what they are."""
    tables = kernels(path)
    if len(tables) != 2:
        raise KeyError(f"{path.name} has {len(tables)} tables of counters")
    names = ({"oracle": "oracle, 6 simple", "implicit": "implicit, 6 simple", "packed": "packed tiles, 6 simple",
              "shade": "window, 6 simple"}, {"oracle 8": "oracle, 11 moderate", "shade 8": "window, 11 moderate"})
    found = [{kernel.name: kernel for kernel in kernels_} for kernels_ in tables]
    return [(words, by_name[name]) for by_name, wanted in zip(found, names) for name, words in wanted.items()]


def roofs(path, grouping):
    """The most bytes per second that a kernel or the benchmark's copy moved, and the instructions per second of
    warps at which all slots would be taken, by the kernel that took the most of them."""
    shown = [kernel for _, kernel in chosen(path)]
    times = Report(grouping).times
    copy = max(10 * n / time * 1e6 for ((_, way), n, _), time in times.items() if way == "copy-5-bytes")
    busiest = max(shown, key=lambda kernel: kernel.issue)
    return max([copy] + [k.bytes / k.time for k in shown]), copy, busiest.rate() / busiest.issue


def counters(path, grouping):
    memory, copy, issue = roofs(path, grouping)
    rows = [[words, f"{k.intensity():.3f}", f"{100 * k.bytes / k.time / memory:.0f} %", f"{100 * k.issue:.0f} %",
             "memory" if k.bytes / k.time / memory > k.issue else "instructions"] for words, k in chosen(path)]
    head = ["kernel, shaders", "warp instructions per byte", "of the bytes per second", "of the slots for instructions",
            "nearer to its roof"]
    return table(head, rows) + (
        f"\n\nRoofs: {memory / 1e12:.2f} TB/s, the most that was measured (the benchmark's copy: {copy / 1e12:.2f}), "
        f"and {issue / 1e9:.0f} thousand million instructions of warps per second; they meet at {issue / memory:.2f} "
        "instructions per byte.")


def plot(path, grouping):
    memory, _, issue = roofs(path, grouping)
    shown = chosen(path)
    x = LogScale(0.02, 0.8, LEFT, RIGHT)
    y = LogScale(40e9, 1.6e12, BOTTOM, TOP)
    d = Drawing(WIDTH, BOTTOM + 54, "Instructions per second over instructions per byte on one NVIDIA H200")
    d.text(8, 20, "NVIDIA H200, 8 Mi requests, ids at random", "strong")
    d.text(8, 40, "index shaders, counters of the kernel that shades", "soft")
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
    slope = x(0.034), y(memory * 0.034) - 8
    d.text(slope[0] + 4, slope[1] - 6, "memory", "small", "end")
    for words, k in shown:
        look, shape = ("s0", "disc") if "simple" in words else ("s1", "diamond")
        here = x(k.intensity()), y(k.rate())
        d.mark(shape, *here, look, words)
        if here[0] + 8 * len(words) < RIGHT:
            d.text(here[0] + 9, here[1] + 4, words, "small")
        else:
            d.text(RIGHT, here[1] + 18, words, "small", "end")
    return d.render()
