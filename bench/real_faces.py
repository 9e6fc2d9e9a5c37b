"""Real faces: a pair whose truth is known, against the figures of other ways on the same points."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.core.methods.settings import HierarchicalSettings
from facial_retarget_addon.core.retarget import retarget

from .real_pair import RealPair, read_pair
from .timing import Row


def rows() -> Iterator[Row]:
    """Relative motion errors per expression, no examples: median and 90 % on the face, median over all vertices.

    Yardsticks on the same points: deformation transfer 0.139, non-rigid fit and delta 0.061, perfect
    correspondence 0.039.
    """
    pair = read_pair()
    if pair is None:
        return
    for variant in ("default", "paper"):
        on_face, everywhere, drift = pair_errors(pair, variant)
        bound = variant == "default"
        yield Row(f"{variant}: median on the face", float(np.median(on_face)), "", 0.08 if bound else None)
        yield Row(f"{variant}: 90 % on the face", float(np.quantile(on_face, 0.9)), "", 0.14 if bound else None)
        yield Row(f"{variant}: median, all vertices", float(np.median(everywhere)), "", 0.10 if bound else None)
        yield Row(f"{variant}: motion of a still source", drift, "", 1e-6)


def pair_errors(pair: RealPair, variant: str) -> tuple[FloatArray, FloatArray, float]:
    """Relative error per expression on the face and over all vertices, and the motion of a still source."""
    source, target = pair.problem.source.mesh.vertices, pair.problem.target.mesh.vertices
    frames = np.concatenate([pair.frames, source[None].astype(np.float32)])
    result = retarget("hierarchical", pair.problem, HierarchicalSettings(variant=variant), frames).frames
    motion = result[:-1] - target
    drift = np.abs(result[-1] - target.astype(np.float32)).max() / target.size
    return pair.errors(motion, pair.on_face), pair.errors(motion), float(drift)
