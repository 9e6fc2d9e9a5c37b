"""The lengths that measure motion at every vertex of a face."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.distance import cdist

from ..arrays import FloatArray

_NEAR = 1e-6
"""Share of the points' extent within which a vertex lies at a point."""


def vertex_lengths(
    vertices: FloatArray, positions: FloatArray, point_lengths: FloatArray, smooth: bool = True
) -> FloatArray:
    """Lengths (V, 3) along the head's axes that vertices are measured in, by the feature points near them.

    Parameters
    ----------
    vertices : (V, 3) of the neutral.
    positions : (P, 3) of the points on it.
    point_lengths : (P, 3) of the points, from `mpeg4.regions.point_lengths`.
    smooth : all points count, by the inverse fourth power of their distance; False takes the closest one's, so that
        motion jumps where the regions meet.

    References
    ----------
    Pandzic 2001, "Normalizing the face": N(FP) of the closest feature point; Shepard 1968 for the smooth weights.
    """
    if not smooth:
        closest: FloatArray = point_lengths[cKDTree(positions).query(vertices)[1]]
        return closest
    near = _NEAR * np.ptp(positions, axis=0).max()
    weights = 1 / (np.square(cdist(vertices, positions)) + near**2) ** 2
    blended: FloatArray = weights @ point_lengths / weights.sum(axis=1)[:, None]
    return blended
