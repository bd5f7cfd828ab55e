# SPDX-License-Identifier: Apache-2.0
"""What a marker may name: the tables and the plots."""
import json

import accuracy_report
import bounces
import effects
import ratios
import registers

from . import claims, compiling, counters, hits, matrix, means, own_kernels, roofline, scaling, scenes, sentences, several, speedups
from . import summary
from .google_benchmark import Report


def ratios_of(path, headings="0"):
    """All that benchmark/ratios.py says of a report; `headings` is the level of its titles, 0 for titles in the text."""
    return ratios.text(Report(path), int(headings))


def effects_of(path, over="all/auto"):
    """Of one pair of programs."""
    return effects.text(path, [tuple(over.split("/"))])


VIEWS = {
    "ratios": ratios_of,
    "spread": lambda path: Report(path).provenance(),
    "threads": several.threads,
    "peers": lambda path: several.peers(json.loads(path.read_text(encoding="utf-8"))),
    "bounces": lambda *paths: bounces.table(paths),
    "effects": effects_of,
    "registers": registers.table,
    "compiled-sets": several.compiled_sets,
    "accuracy": accuracy_report.text,
    "accuracy-knobs": accuracy_report.knobs,
    "accuracy-digits": accuracy_report.digits,
    "accuracy-schedules": accuracy_report.schedules,
    "compile-time": compiling.compile_time,
    "matrix": matrix.matrix,
    "summary": summary.summary,
    "speedup": summary.speedup,
    "gain": sentences.gain,
    "best-in": sentences.best_in,
    "microseconds": sentences.microseconds,
    "repeated": sentences.repeated,
    "counter-share": counters.share,
    "scene-gain": sentences.scene_gain,
    "scene-share": sentences.scene_share,
    "hit-efficiency": sentences.hit_efficiency,
    "accuracy-of": sentences.accuracy,
    "equal-error": sentences.equal_error,
    "gains": scenes.gains,
    "means": means.means,
    "span": means.span,
    "apart": means.apart,
    "against": means.against,
    "scenes": claims.scenes,
    "coherence": claims.coherence,
    "efficiency": hits.efficiency,
    "scene-shaders": scenes.shaders,
    "scene-efficiency": scenes.efficiency,
    "scene-times": scenes.times,
    "dispatches": claims.dispatches,
    "dispatches-by-set": claims.dispatches_by_set,
    "unordered": claims.unordered,
    "local": claims.local,
    "scaling": claims.scaling,
    "roofs": roofline.counters,
    "shares": roofline.shares,
    "counters": counters.counters,
    "counter": counters.counter,
    "profiled": counters.provenance,
    "own-renderer": own_kernels.renderer,
    "own-renderer-gain": own_kernels.renderer_gain,
    "own-gathers": own_kernels.gathers,
    "own-times": own_kernels.times,
    "own-over": own_kernels.over,
    "own-uneven": own_kernels.uneven,
    "own-integration": own_kernels.integration,
}
PLOTS = {
    "effects": lambda *paths: effects.plot(paths),
    "accuracy": lambda *paths: accuracy_report.plot(paths),
    "speedups": speedups.plot,
    "scaling": scaling.plot,
    "roofline": roofline.plot,
    "efficiency": hits.plot,
}
