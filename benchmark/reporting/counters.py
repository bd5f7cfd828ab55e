# SPDX-License-Identifier: Apache-2.0
"""The counters of kernels that benchmark/counters.py has collected, cell by cell."""
import json
from dataclasses import dataclass

from .markdown import table

# Nsight Compute's names, and ours.
METRICS = {
    "gpu__time_duration.sum": "ns",
    "smsp__cycles_elapsed.avg.per_second": "hertz",
    "smsp__inst_executed.sum": "instructions",
    "smsp__thread_inst_executed.sum": "instructions_of_threads",
    "smsp__issue_active.avg.pct_of_peak_sustained_active": "issue_percent",
    "dram__bytes_read.sum": "bytes_read",
    "dram__bytes_write.sum": "bytes_written",
    "lts__t_sectors.avg.pct_of_peak_sustained_elapsed": "l2_percent",
    "sm__icc_requests.sum": "code_requests",
    "sm__icc_requests_lookup_miss.sum": "code_misses",
    "smsp__average_warps_issue_stalled_no_instruction_per_issue_active.ratio": "waiting_for_code",
    "smsp__average_warps_issue_stalled_long_scoreboard_per_issue_active.ratio": "waiting_for_memory",
}
RESULT = 16  # bytes that benchmark_schedules stores for a request


@dataclass(frozen=True)
class Cell:
    """What a schedule did with one batch: its kernels together, the one behind the other."""
    shaders: str
    schedule: str
    run: int
    n: int
    kernels: list

    def total(self, counter):
        return sum(kernel[counter] for kernel in self.kernels)

    def mean(self, counter):
        """Over the time of the kernels."""
        return sum(kernel[counter] * kernel["ns"] for kernel in self.kernels) / self.total("ns")

    def seconds(self):
        return 1e-9 * self.total("ns")

    def bytes(self):
        """To and from memory. Of what is written at least the results: the profiler empties the caches between kernels,
        and does not count what was still in them."""
        return self.total("bytes_read") + max(self.total("bytes_written"), RESULT * self.n)

    def intensity(self):
        """Instructions of warps per byte of memory."""
        return self.total("instructions") / self.bytes()

    def threads(self):
        """Per instruction of a warp."""
        return self.total("instructions_of_threads") / self.total("instructions")


def read(path):
    """The cells of a file, {(shaders, schedule, run): Cell}."""
    with open(path, encoding="utf-8") as file:
        cells = json.load(file)["cells"]
    found = {}
    for name, kernels in cells.items():
        shaders, _, schedule, n, run = name.split("/")
        key = shaders, schedule, int(run.removeprefix("run:"))
        if key in found:
            raise ValueError(f"two cells are {key}")
        found[key] = Cell(*key, int(n.removeprefix("n:")), kernels)
    return found


COLUMNS = {
    "kernels": lambda c: f"{len(c.kernels)}",
    "µs": lambda c: f"{1e6 * c.seconds():.0f}",
    "warp instructions, M": lambda c: f"{c.total('instructions') / 1e6:.0f}",
    "threads per instruction": lambda c: f"{c.threads():.1f}",
    "issue slots busy": lambda c: f"{c.mean('issue_percent'):.0f} %",
    "memory, MB": lambda c: f"{c.bytes() / 1e6:.0f}",
    "L2 of its peak": lambda c: f"{c.mean('l2_percent'):.0f} %",
    "code fetched, M": lambda c: f"{c.total('code_requests') / 1e6:.1f}",
    "not cached, M": lambda c: f"{c.total('code_misses') / 1e6:.1f}",
    "waits for code": lambda c: f"{c.mean('waiting_for_code'):.1f}",
    "waits for memory": lambda c: f"{c.mean('waiting_for_memory'):.1f}",
}


def counters(path, run):
    """All cells of a run length."""
    cells = [cell for cell in read(path).values() if cell.run == int(run)]
    return table(["shaders", "schedule", *COLUMNS],
                 [[cell.shaders, f"`{cell.schedule}`"] + [of(cell) for of in COLUMNS.values()] for cell in cells])


def counter(path, shaders, run, schedule, what):
    """One number, for a sentence."""
    return COLUMNS[what](read(path)[shaders, schedule, int(run)])


def share(path, shaders, run, schedule, one, other):
    """One counter as a share of another."""
    cell = read(path)[shaders, schedule, int(run)]
    return f"{100 * cell.total(one) / cell.total(other):.0f} %"


def provenance(path):
    with open(path, encoding="utf-8") as file:
        context = json.load(file)["context"]
    clocks = [kernel["hertz"] / 1e9 for cell in read(path).values() for kernel in cell.kernels]
    words = ", ".join(f"{key} {value}" for key, value in context.items())
    return f"{words}. Clocks of the kernels: {min(clocks):.2f} to {max(clocks):.2f} GHz."
