"""The smoothest map of space that takes points to points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.distance import cdist

from ..arrays import FloatArray
from ..errors import RetargetError

_BLOCK = 4096


@dataclass(frozen=True, eq=False)
class SmoothWarp:
    """x -> A x + b + sum_j w_j |x - c_j|: the biharmonic spline of three dimensions.

    Attributes
    ----------
    centres : (P, 3) the points, in units of `size`, from `origin`.
    coefficients : (P + 4, 3) of the distances, of x, y, z and of 1.
    """

    centres: FloatArray
    coefficients: FloatArray
    origin: FloatArray
    size: float

    def apply(self, points: FloatArray) -> FloatArray:
        """Positions (N, 3) mapped, (N, 3)."""
        out = np.empty((len(points), 3))
        count = len(self.centres)
        for start in range(0, len(points), _BLOCK):
            x = (points[start : start + _BLOCK] - self.origin) / self.size
            out[start : start + _BLOCK] = (
                cdist(x, self.centres) @ self.coefficients[:count] + x @ self.coefficients[count:-1]
            )
        return out + self.coefficients[-1]


def fit_smooth_warp(points: FloatArray, images: FloatArray, stiffness: float = 0.0) -> SmoothWarp:
    """The biharmonic spline with a linear term through matched points.

    Parameters
    ----------
    points, images : (P, 3); at least 4 different points that are not in one plane.
    stiffness : 0 goes through the images; greater values give way, in units of the points' extent.

    Raises
    ------
    RetargetError : if there are fewer than 4 points, if they lie in one plane, or, without stiffness, if two of them
        coincide.

    References
    ----------
    Duchon 1977; Wahba 1990, section 2.4.
    """
    origin = points.mean(axis=0)
    size = float(np.linalg.norm(points - origin, axis=1).max())
    if len(points) < 4:
        raise RetargetError(f"a warp needs at least 4 matched points, {len(points)} arrived")
    x = (points - origin) / max(size, 1e-300)
    spread = np.linalg.svd(x, compute_uv=False)
    if spread[2] <= 1e-4 * spread[0]:
        raise RetargetError(f"all {len(points)} points lie in one plane, expected points spread over a face")
    distance = cdist(x, x)
    np.fill_diagonal(distance, np.inf)
    if stiffness == 0 and distance.min() < 1e-7:
        raise RetargetError("two feature points lie in the same place, expected different places")
    np.fill_diagonal(distance, -stiffness)
    count = len(x)
    system = np.zeros((count + 4, count + 4))
    system[:count, :count] = distance
    system[:count, count:] = np.concatenate([x, np.ones((count, 1))], axis=1)
    system[count:, :count] = system[:count, count:].T
    right = np.zeros((count + 4, 3))
    right[:count] = images
    return SmoothWarp(x, np.linalg.solve(system, right), origin, size)
