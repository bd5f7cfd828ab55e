# SPDX-License-Identifier: Apache-2.0
"""Tables of what scripts/matrix has tried."""
import json

from .markdown import table


def text_of(cells):
    """What became of the standards of one place in a table."""
    outcomes = {cell["standard"]: cell["outcome"] for cell in cells}
    if len(set(outcomes.values())) == 1:
        return next(iter(outcomes.values()))
    # Those that differ are named.
    return ", ".join(f"C++{standard} {outcome}" for standard, outcome in sorted(outcomes.items()))


def part(cells, across, head):
    """One table: compilers down, and what `across` names to the right."""
    compilers = list(dict.fromkeys(cell["compiler"] for cell in cells))
    columns = list(dict.fromkeys(cell[across] for cell in cells))
    rows = [[compiler] + [text_of([c for c in cells if c["compiler"] == compiler and c[across] == column])
                          for column in columns] for compiler in compilers]
    return table(["compiler"] + [f"{head} {column}" for column in columns], rows)


def standards(cells):
    """The standards of all places, which have the same ones."""
    names = [f"C++{standard}" for standard in sorted({cell["standard"] for cell in cells})]
    return ", ".join(names[:-1]) + f" and {names[-1]}"


def matrix(path):
    """A table for CUDA and one for CPUs, how many cells there are of each outcome, and what failed."""
    with open(path, encoding="utf-8") as file:
        report = json.load(file)
    cells = report["cells"]
    cuda = [cell for cell in cells if cell["kind"] == "cuda"]
    cpu = [cell for cell in cells if cell["kind"] == "cpu"]
    count = {name: sum(cell["outcome"] == name for cell in cells) for name in ("ok", "failed", "not here")}
    if sum(count.values()) != len(cells):
        raise ValueError("a cell has another outcome")
    parts = [f"{report['context']['date']}, commit {report['context']['commit']}: " +
             ", ".join(f"{n} {name}" for name, n in count.items()),
             f"CUDA, {standards(cuda)}:", part(cuda, "capability", "capability"),
             f"CPUs, {standards(cpu)}:", part(cpu, "cccl", "CCCL")]
    failed = {}
    for cell in cells:
        if cell["outcome"] == "failed":
            failed.setdefault(cell["what"], []).append(cell)
    if failed:
        parts.append("What failed:")
        parts.append("\n".join(f"- `{what}`: {len(of)} cells, the first by {of[0]['compiler']} for C++{of[0]['standard']}"
                               for what, of in failed.items()))
    return "\n\n".join(parts)
