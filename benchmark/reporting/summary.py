# SPDX-License-Identifier: Apache-2.0
"""All claims of the paper in one table."""
from .claims import verdict
from .google_benchmark import Report
from .hits import hits
from .markdown import table
from .paper import EFFICIENCY, GROUPINGS, LATER, SCENES, SCHEDULES, unsorted
from .roofline import chosen, roofs, shares_of
from .scaling import growth, series
from .scenes import speedups
from .schedules import Cells

ALMOST = 0.9  # of all cells: "almost always"
NOT_MEASURED = "not measured", "not measured"


def span(values, digits=2):
    return f"{min(values):.{digits}f} to {max(values):.{digits}f}"


def scene(cells, n, name, names, kind="index"):
    """The speedup of the best of some schedules over unsorted implicit serialisation, for every run length."""
    every = [cells.rows[name, n, run][kind] for run in cells.runs]
    return [unsorted(times) / min(times[s] for s in names) for times in every]


def explicit_wins(cells):
    """After the paper's groupings, index shaders."""
    won = [times[f"{g}+explicit"] < times[f"{g}+implicit"]
           for cell in cells.rows.values() for times in [cell["index"]] for g in GROUPINGS[:2]]
    share = sum(won) / len(won)
    return (f"in {sum(won)} of {len(won)}",
            "holds" if share >= ALMOST else "no longer holds" if share <= 1 - ALMOST else "depends")


def penalty(cells, n):
    """Explicit serialisation of requests as they come over that of grouped ones."""
    ratios = [times["explicit"] / min(times["compact+explicit"], times["sort+explicit"])
              for cell, kinds in cells.rows.items() if cell[1] == n for times in [kinds["index"]]]
    return f"{span(ratios)} times as long", verdict([ratio > 1 for ratio in ratios])


def never_best(cells, *names):
    """Whether a schedule, which may have several names, is nowhere the best."""
    best = [min(["implicit", *SCHEDULES, *LATER], key=lambda s, times=cell["index"]: times[s]) in names
            for cell in cells.rows.values()]
    return f"best in {sum(best)} of {len(best)}", "holds" if not any(best) else "no longer holds"


def grows(way, law, n, *paths):
    """What a table eight times as large multiplies the time of a grouping of n by, in the first report that has it, and
    whether that is as a law says, to a quarter."""
    found, _ = series(next((path for path in paths if way in series(path)[0]), paths[0]))
    if way not in found:
        return NOT_MEASURED
    factor = growth(found[way], (4, n), (32, n), lambda cell: cell[0])[0]
    word = "less than that" if factor < 0.75 * law else "holds" if factor < 1.25 * law else "no longer holds"
    return f"{factor:.2f} times", word


def balance(counters, grouping):
    """Where the roofs of memory and of instructions meet, and whether short shaders lie on the one side of it and
    long ones on the other."""
    memory, _, issue = roofs(counters, grouping)
    simple, moderate = (chosen(counters)[shaders, "oracle-launches"] for shaders in ("6 simple", "11 moderate"))
    held = simple.intensity() < issue / memory < moderate.intensity()
    return f"{issue / memory:.2f} instructions per byte", "holds" if held else "no longer holds"


def share_of_copy(schedules, grouping, n):
    """The most that a set of short shaders moves, as a share of the rate of a copy, on a machine without counters: on
    memory's side it is there from one half on."""
    found = shares_of(schedules, grouping, n)
    most = max(max(row) for (shaders, _), row in found.items() if shaders in ("3 simple", "6 simple"))
    return f"{100 * most:.0f} % of a copy's rate", "holds" if most > 0.5 else "no longer holds"


def efficiencies(*paths):
    """The least and the most of each hit, and in how many of all they are the paper's within ten points."""
    found = [shares for path in paths for _, shares in hits(path)]
    words = ", ".join(f"{100 * min(shares):.0f} to {100 * max(shares):.0f}" for shares in zip(*found)) + " %"
    return words, verdict([abs(100 * share - paper) <= 10 for shares in found
                           for share, paper in zip(shares, EFFICIENCY)])


def summary(gpu, cpu, gpu_grouping, cpu_grouping, cpu_scan, counters, *paths, gpu_n, cpu_n, n):
    """Of a GPU and a CPU: speedups of index shaders at so many requests, least to most over all lengths of runs;
    grouping of n, the scan of a CPU from a report of its own; of paths the first two, the scenes rendered by either;
    and the others, efficiencies of some reports of the path tracer, which no machine changes."""
    rendered, paths = paths[:2], paths[2:]
    both = [(Cells(Report(path).times), int(size)) for path, size in ((gpu, gpu_n), (cpu, cpu_n))]
    rows = []

    def add(claim, paper, found):
        rows.append([claim, paper, *(value for value, _ in found), *(word for _, word in found)])
    for s in SCENES:
        for names, whose in ((SCHEDULES, "the paper's schedules"), (SCHEDULES + LATER, "with later ones")):
            found = [scene(cells, size, s.name, names) for cells, size in both]
            add(f"{s.name}, {whose}", s.words(),
                [(f"{span(values)} times as fast", verdict([(v > 1) == s.pays() for v in values])) for values in found])
        found = [speedups(path, SCHEDULES)[s.name] for path in rendered]
        add(f"{s.name}, a scene rendered by the paper's schedules", s.words(),
            [(f"{value:.2f} times as fast", verdict([(value > 1) == s.pays()]) if sure else "within the spread")
             for value, sure in found])
    add("efficiency of the first four hits", ", ".join(map(str, EFFICIENCY)) + " %", [efficiencies(*paths)] * 2)
    add("grouped, explicit beats implicit", "almost always", [explicit_wins(cells) for cells, _ in both])
    add("explicit over unordered requests, to grouped ones", "large penalties", [penalty(*one) for one in both])
    add("its local sort, `local-bitonic`", "never successful", [never_best(cells, "local-bitonic") for cells, _ in both])
    (on_gpu, _), (on_cpu, _) = both
    add("a later local sort, `local`", "never successful",  # on a CPU, `window` is the same
        [never_best(on_gpu, "local"), never_best(on_cpu, "local", "window")])
    for name, way, words, law in (("sorting", "radix-sort", "2.5 times: log M", 2.5),
                                  ("scanning", "compaction", "8 times: M", 8)):
        add(f"{name}, 32 shaders instead of 4", words,
            [grows(way, law, int(n), *paths) for paths in ((gpu_grouping,), (cpu_grouping, cpu_scan))])
    add("memory bandwidth against processor clock", "short shaders: memory",
        [balance(counters, gpu_grouping), share_of_copy(cpu, cpu_grouping, int(cpu_n))])
    return table(["claim", "paper", "H200", "CPU", "on an H200", "on the CPU"], rows)


def speedup(path, shaders, n, run, schedule, kind="index"):
    """One number, for a sentence."""
    times = Cells(Report(path).times).rows[shaders, int(n), int(run)][kind]
    return f"{unsorted(times) / times[schedule]:.1f}"
