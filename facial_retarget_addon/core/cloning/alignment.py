"""One face pulled onto another in the plane, by its feature points."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial import Delaunay

from ..arrays import FloatArray, IntArray
from ..errors import RetargetError
from .interpolation import least_excess

INNER_LIPS = frozenset(("2.2", "2.3", "2.4", "2.5", "2.6", "2.7", "2.8", "2.9"))
"""FDPs around the opening of the mouth."""
_LEAN = 1e-6
"""Left and right points that mirror each other lie on circles through four; leaning decides them alike every time."""


def align(names: Sequence[str], moving: FloatArray, still: FloatArray, places: FloatArray) -> FloatArray:
    """Places (N, 2) on a face after its points (P, 2) `moving` have been drawn onto those of another, `still`.

    Points are triangulated half way between the two faces; the opening of the mouth is left out.

    Parameters
    ----------
    names : (P,) of the points.

    Raises
    ------
    RetargetError : for points that span no triangle.

    References
    ----------
    Pandzic 2001, "Aligning source and target face", where the triangulation is made by hand.
    """
    triangles = _triangulate(names, 0.5 * (moving + still))
    face, weights = least_excess(places, moving[triangles])
    pulled: FloatArray = places + np.einsum("nk,nkc->nc", weights, (still - moving)[triangles[face]])
    return pulled


def _triangulate(names: Sequence[str], plane: FloatArray) -> IntArray:
    spread = plane - plane.mean(axis=0)
    if len(plane) < 3 or np.linalg.svd(spread, compute_uv=False)[1] < 1e-6 * np.abs(spread).max(initial=0.0):
        raise RetargetError(
            f"the {len(plane)} feature points of both faces span no triangle around the head, expected at least 3 "
            "that are not above one another"
        )
    found = Delaunay(plane + _LEAN * plane[:, ::-1] * (1.0, 0.0)).simplices.astype(np.int64)
    around_mouth = np.array([name in INNER_LIPS for name in names])
    kept: IntArray = found[~around_mouth[found].all(axis=1)]
    return kept
