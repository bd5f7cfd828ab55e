# SPDX-License-Identifier: Apache-2.0
"""A machine of four lanes per warp, small enough to draw, and every schedule of the library on it.

A schedule here does what the library's does, and gives what lanes do, step by step; efficiency is counted
from that. `check()` compares with the paper's formula and sees that every request runs exactly once.
"""
import dataclasses
import itertools

BATCH = "ACBADABCBDACABDB"  # the shader that each request names
COSTS = {"A": 1, "B": 2, "C": 2, "D": 3}  # the steps that a shader takes
SHADERS = list(COSTS)
WARP = 4
TILE = 8


@dataclasses.dataclass
class Warp:
    """Lanes that share a program counter: the request of each, None for a lane without one."""
    requests: list

    def steps(self):
        """For every step the shader that runs: shaders take turns, each for as long as it takes."""
        here = {BATCH[r] for r in self.requests if r is not None}
        return [shader for shader in SHADERS if shader in here for _ in range(COSTS[shader])]

    def at_work(self, lane, shader):
        return self.requests[lane] is not None and BATCH[self.requests[lane]] == shader


@dataclasses.dataclass
class Run:
    """Launches, each a list of warps, in the order of time."""
    launches: list

    def warps(self):
        return [warp for launch in self.launches for warp in launch]

    def active(self):
        """The lane-steps in which a lane computes something."""
        return sum(warp.at_work(lane, shader)
                   for warp in self.warps() for shader in warp.steps() for lane in range(WARP))

    def held(self):
        """The lane-steps that pass for lanes, at work or waiting."""
        return sum(len(warp.steps()) * WARP for warp in self.warps())

    def efficiency(self):
        return self.active() / self.held()


def warps_of(requests):
    """Warps over requests in the order given; the last one may have lanes without any."""
    padded = list(requests) + [None] * (-len(requests) % WARP)
    return [Warp(padded[i:i + WARP]) for i in range(0, len(padded), WARP)]


def switch(order):
    """One launch with a switch."""
    return Run([warps_of(order)])


def launches(order):
    """One launch per shader over its segment."""
    return Run([warps_of([r for r in order if BATCH[r] == shader]) for shader in SHADERS])


def masked():
    """One launch per shader over all requests; lanes whose request names another leave at once."""
    everyone = range(len(BATCH))
    return Run([warps_of([r if BATCH[r] == shader else None for r in everyone]) for shader in SHADERS])


def exclusive_scan(values):
    return [0, *itertools.accumulate(values)][:-1]


def compaction_of(shader):
    """Flags and places: select and scan."""
    flags = [int(name == shader) for name in BATCH]
    return flags, exclusive_scan(flags)


def compacted():
    order = []
    for shader in SHADERS:
        flags, places = compaction_of(shader)
        segment = [None] * sum(flags)
        for request, flag in enumerate(flags):
            if flag:
                segment[places[request]] = request
        order += segment
    return order


def radix_passes():
    """The order after each pass over one bit of the ids, the lowest first."""
    order = list(range(len(BATCH)))
    passes = [order]
    for bit in range((len(SHADERS) - 1).bit_length()):
        ones = [r for r in order if SHADERS.index(BATCH[r]) >> bit & 1]
        order = [r for r in order if r not in ones] + ones
        passes.append(order)
    return passes


def tiles():
    return [range(first, first + TILE) for first in range(0, len(BATCH), TILE)]


def bucket_tables():
    """What each tile counts of each shader, and the place of its first one."""
    counts = [[sum(BATCH[r] == shader for r in tile) for shader in SHADERS] for tile in tiles()]
    by_shader = exclusive_scan([row[k] for k in range(len(SHADERS)) for row in counts])
    places = [[by_shader[k * len(counts) + t] for k in range(len(SHADERS))] for t in range(len(counts))]
    return counts, places


def bucketed():
    order = [None] * len(BATCH)
    for tile, places in zip(tiles(), bucket_tables()[1]):
        free = dict(zip(SHADERS, places))
        for request in tile:
            order[free[BATCH[request]]] = request
            free[BATCH[request]] += 1
    return order


def bitonic(tile):
    """Batcher's network over keys of shader and position, as in grouping/tile.hpp."""
    keys = [(SHADERS.index(BATCH[r]), r) for r in tile]
    run = 2
    while run <= len(keys):
        distance = run // 2
        while distance:
            for i in range(len(keys)):
                j = i ^ distance
                if i < j and (keys[i] > keys[j]) == (i & run == 0):
                    keys[i], keys[j] = keys[j], keys[i]
            distance //= 2
        run *= 2
    return [r for _, r in keys]


def sorted_tiles():
    return [bitonic(tile) for tile in tiles()]


def local_switch():
    return switch(sum(sorted_tiles(), []))


def local_rows():
    """Tile by tile, rows of one shader: no launch of its own for each."""
    return Run([[warp for launch in launches(tile).launches for warp in launch] for tile in sorted_tiles()])


def schedules():
    """A run of the batch by every schedule. Compaction, sort and buckets make one order, and so does the window,
    which holds the whole of so small a batch."""
    grouped = bucketed()
    return {
        "implicit": switch(range(len(BATCH))),
        "explicit": masked(),
        "local-bitonic": local_switch(),
        "local": local_rows(),
        "window": switch(grouped),
        "compact, sort or bucket, implicit": switch(compacted()),
        "compact, sort or bucket, explicit": launches(radix_passes()[-1]),
    }


def check():
    """Stops where a schedule leaves a request out, runs one twice, or counts otherwise than the formula of
    Hoberock et al., HPG 2009, section 5."""
    grouped = [r for shader in SHADERS for r in range(len(BATCH)) if BATCH[r] == shader]
    for order in (compacted(), radix_passes()[-1], bucketed()):
        assert order == grouped, "a grouping is the stable one"
    for tile, order in zip(tiles(), sorted_tiles()):
        assert order == [r for r in grouped if r in tile], "a tile is sorted"
    for name, run in schedules().items():
        ran = [warp.requests[lane] for warp in run.warps() for shader in warp.steps()
               for lane in range(WARP) if warp.at_work(lane, shader)]
        assert sorted(ran) == sorted(r for r in grouped for _ in range(COSTS[BATCH[r]])), name
        useful = sum(COSTS[name] for name in BATCH)
        named = [{BATCH[r] for r in warp.requests if r is not None} for warp in run.warps()]
        held = WARP * sum(COSTS[shader] for names in named for shader in names)
        assert (run.active(), run.held()) == (useful, held), name
