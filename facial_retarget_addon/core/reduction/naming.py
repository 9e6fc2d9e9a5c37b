"""Names that tell an animator where a shape acts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray

_SIDED = 0.8
"""A shape is of one side if so much of it lies there."""


def region_names(shapes: FloatArray, weights: FloatArray, regions: Sequence[str], left: FloatArray) -> list[str]:
    """Names of shapes after the region in which most of each lies: `mouth`, `brows_L`, and numbered ones after them.

    Parameters
    ----------
    shapes : (K, V, 3) displacements. weights : (V, R) of the regions, which may lack some vertices.
    regions : (R,) their names.
    left : (V,) above 0 on the face's left, below on its right.
    """
    counted: Counter[str] = Counter()
    names = []
    for shape in shapes:
        energy = np.einsum("vi,vi->v", shape, shape)
        shares = energy @ weights
        name = regions[int(shares.argmax())] if shares.max(initial=0.0) > 0.25 * energy.sum() else "head"
        whole = max(float(energy.sum()), 1e-300)
        if energy[left > 0].sum() > _SIDED * whole:
            name += "_L"
        elif energy[left < 0].sum() > _SIDED * whole:
            name += "_R"
        counted[name] += 1
        names.append(name if counted[name] == 1 else f"{name}.{counted[name] - 1:03d}")
    return names
