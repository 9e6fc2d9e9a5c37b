"""Interpolation over the triangles of a plane, those that overlap too."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray, IntArray
from ..mesh import TriMesh
from ..raycast import CasterFactory
from .cylinder import Unrolled

_BLOCK = 2_000_000
"""Pairs of a place and a triangle that are looked at together."""
_FLAT = 1e-12
"""Triangles of less area than this hold no place."""


def outermost(
    places: FloatArray, unrolled: Unrolled, faces: IntArray, make_caster: CasterFactory
) -> tuple[IntArray, FloatArray]:
    """The triangle that holds each place, the outermost where several do.

    Parameters
    ----------
    places : (N, 2).
    unrolled : the mesh's vertices. faces : (M, 3).

    Returns
    -------
    (N,) face, -1 where none holds the place; (N, 3) weights of its corners.
    """
    relief = TriMesh(np.column_stack([unrolled.plane, unrolled.radius]), faces)
    above = np.full(len(places), unrolled.radius.max() + 1)
    down = np.tile([0.0, 0.0, -1.0], (len(places), 1))
    hits = make_caster(relief).nearest(np.column_stack([places, above]), down)
    return hits.face, hits.weights


def least_excess(places: FloatArray, corners: FloatArray) -> tuple[IntArray, FloatArray]:
    """The triangle (N,) by which each place (N, 2) lies outside least, and weights (N, 3) of the place drawn into it.

    Outside by the sum of what its barycentric coordinates lie below 0 and above 1, which is no distance: it favours
    large triangles. Coordinates are cut to that range and divided by their sum.

    Parameters
    ----------
    corners : (M, 3, 2) of the triangles.

    References
    ----------
    Pandzic 2001, "Interpolation from a triangle mesh".
    """
    origin = corners[:, 0]
    edges = np.stack([corners[:, 1] - origin, corners[:, 2] - origin], axis=2)
    area = np.linalg.det(edges)
    kept = np.flatnonzero(np.abs(area) > _FLAT)
    inverse, origin = np.linalg.inv(edges[kept]), origin[kept]
    offset = np.einsum("mij,mj->mi", inverse, origin)
    best = np.empty(len(places), np.int64)
    step = max(1, _BLOCK // max(1, len(kept)))
    for first in range(0, len(places), step):
        here = places[first : first + step]
        second, third = (here @ inverse[:, k].T - offset[:, k] for k in (0, 1))
        excess = _outside(second) + _outside(third) + _outside(1 - second - third)
        best[first : first + step] = excess.argmin(axis=1)
    pair = np.einsum("nij,nj->ni", inverse[best], places) - offset[best]
    weights = np.clip(np.column_stack([1 - pair.sum(axis=1), pair]), 0.0, 1.0)
    return kept[best], weights / weights.sum(axis=1, keepdims=True)


def _outside(share: FloatArray) -> FloatArray:
    excess: FloatArray = np.abs(share - np.clip(share, 0.0, 1.0))
    return excess
