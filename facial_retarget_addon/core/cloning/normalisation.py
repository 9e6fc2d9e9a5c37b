"""The lengths that measure motion at every vertex of a face."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.distance import cdist

from ..arrays import FloatArray


def vertex_lengths(
    vertices: FloatArray, positions: FloatArray, point_lengths: FloatArray, smooth: bool = True
) -> FloatArray:
    """Lengths (V, 3) along the head's axes that vertices are measured in, by the feature points near them.

    Parameters
    ----------
    vertices : (V, 3) of the neutral.
    positions : (P, 3) of the points on it.
    point_lengths : (P, 3) of the points, from `mpeg4.regions.point_lengths`.
    smooth : the biharmonic spline of the lengths' logarithms, within the range of the points' lengths; False takes the
        closest point's, so that motion jumps where the regions meet.

    References
    ----------
    Pandzic 2001, "Normalizing the face": N(FP) of the closest feature point; Duchon 1977 for the spline.
    """
    if not smooth:
        closest: FloatArray = point_lengths[cKDTree(positions).query(vertices)[1]]
        return closest
    size = max(float(np.ptp(positions, axis=0).max()), 1e-300)
    count = len(positions)
    system = np.ones((count + 1, count + 1))
    system[:count, :count] = cdist(positions, positions) / size
    system[count, count] = 0.0
    logarithms = np.log(point_lengths)
    # Least squares: lips that touch have two points in one place.
    weights = np.linalg.lstsq(system, np.concatenate([logarithms, np.zeros((1, 3))]), rcond=None)[0]
    spline = cdist(vertices, positions) / size @ weights[:count] + weights[count]
    lengths: FloatArray = np.exp(np.clip(spline, logarithms.min(axis=0), logarithms.max(axis=0)))
    return lengths
