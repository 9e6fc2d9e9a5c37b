"""Cloning all expressions of a real head: ours beside the peers, against the truth, no examples."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from time import perf_counter
from typing import Protocol

import numpy as np

from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.core.methods.base import fit
from facial_retarget_addon.core.methods.settings import SETTINGS
from facial_retarget_addon.core.problem import Problem
from facial_retarget_addon.core.quality import Quality

from .deformation_transfer import AlignedTransfer
from .expression_cloning import ExpressionCloning
from .nearest_vertex import NearestVertex
from .real_pair import RealPair, read_pair
from .seals import lid_error, lip_error
from .timing import Row


class Cloner(Protocol):
    """Fitted to a pair of faces."""

    def frames(self, source: FloatArray) -> FloatArray:
        """Target positions (F, Vt, 3) of source frames (F, Vs, 3)."""
        ...


PEERS: Mapping[str, Callable[[Problem], Cloner]] = {
    "nearest vertex": NearestVertex,
    "expression cloning": ExpressionCloning,
    "deformation transfer": AlignedTransfer,
}
OURS = ("hierarchical", "wavelet", "feature_points", "motion_cloning")
BEST = "motion_cloning"
"""The method of ours that must err less than any peer, and tear, fold and leave open no more than the best of them."""
ERROR = "error"
LIMITS = {"error on the face, median": 0.06, "error on the face, 90 %": 0.10}
"""What it must reach besides."""
UNBOUNDED = ("fit", "keys")
"""Seconds have a bench of their own."""


def rows() -> Iterator[Row]:
    """Errors, defects, seals and seconds of each way, the peers first.

    Yardsticks of others' making on the same points, median / 90 % on the face: nearest vertex 0.161 / 0.374,
    expression cloning 0.325 / 0.391, deformation transfer 0.139 / 0.230, perfect correspondence 0.039 / 0.041.
    """
    pair = read_pair()
    if pair is None:
        return
    best: dict[str, float] = {}
    for name, make in PEERS.items():
        for row in _measured(pair, make):
            best[row.what] = min(row.value, best.get(row.what, np.inf))
            yield Row(f"{name}: {row.what}", row.value, row.unit)
    for name in OURS:
        for row in _measured(pair, partial(fit, name, settings=SETTINGS[name]())):
            bounded = name == BEST and not row.what.endswith(UNBOUNDED)
            bound = min(best[row.what], LIMITS.get(row.what, np.inf)) if bounded else None
            yield Row(f"{name}: {row.what}", row.value, row.unit, bound)


def _measured(pair: RealPair, make: Callable[[Problem], Cloner]) -> Iterator[Row]:
    frames = pair.frames
    start = perf_counter()
    cloner = make(pair.problem)
    fitted = perf_counter()
    found = cloner.frames(frames)
    done = perf_counter()
    target = pair.problem.target.mesh
    motion = found - target.vertices
    for where, errors in (
        ("on the face", pair.errors(motion, pair.on_face)),
        ("everywhere", pair.errors(motion)),
    ):
        yield Row(f"{ERROR} {where}, median", float(np.median(errors)), "")
        yield Row(f"{ERROR} {where}, 90 %", float(np.quantile(errors, 0.9)), "")
    quality = Quality(pair.problem.source.mesh, target, pair.counterpart)
    quality.add(frames, found.astype(np.float32))
    summary = quality.summary()
    yield Row("torn edges", summary["torn_edges_per_million"], "per million")
    yield Row("flipped triangles", summary["flipped_triangles_per_million"], "per million")
    ours, truth = (dict(zip(pair.names, one, strict=True)) for one in (motion, pair.truth))
    yield Row("lip gap, jaw open and mouth closed", lip_error(target, ours, truth), "% of the open jaw's")
    yield Row("lid gap, blinking", lid_error(target, ours, truth), "% of the eye's opening")
    yield Row("fit", fitted - start, "s")
    yield Row(f"{len(frames)} keys", done - fitted, "s")
