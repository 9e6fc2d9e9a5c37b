"""Points inserted into a triangulation that lies on two faces at once."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray, IntArray
from ..closest_point import closest_on_triangles
from ..mesh import TriMesh
from .placed_points import PlacedPoints

_RIM = 0.05
"""A point whose weight inside a border triangle is below this, on any face, lies on the border or outside."""
_OFF = 0.1
"""A point beside an edge, farther from it along the surface than this many mean edges, lies beyond it."""
_UPRIGHT = 0.1
"""Triangles whose agreement with the surface is above this are fine."""
_FOLD_COST = 0.1
"""What a fold counts against distance, in squared mean edges."""


def insert_points(faces: IntArray, rows: IntArray, placed: Sequence[PlacedPoints]) -> IntArray:
    """Triangulation with more of the points as vertices.

    Each point splits the triangle that is nearest to it on all faces together; edges are then flipped until
    the triangulation is intrinsically Delaunay, but never so that a triangle folds over. Boundary loops stay.

    Parameters
    ----------
    faces : (F, 3) manifold triangulation of some of the P points.
    rows : (K,) points to insert.
    placed : the points on each face, in any unit.

    Returns
    -------
    (F', 3); points on the border, outside, or that would fold it over are in no triangle.

    References
    ----------
    Lawson 1977 (flips).
    """
    scaled = [PlacedPoints(p.positions / _mean_edge(p.positions, faces), p.normals) for p in placed]
    for row in rows.tolist():
        weights, gap = _nearest(faces, row, scaled)
        near = np.flatnonzero(gap <= gap.min() + _FOLD_COST)
        split = np.stack([faces[near][:, [0, 1]], faces[near][:, [1, 2]], faces[near][:, [2, 0]]], axis=1)
        split = np.concatenate([split, np.full((len(near), 3, 1), row)], axis=2)
        upright = _worst(split.reshape(-1, 3), scaled).reshape(-1, 3).min(axis=1)
        chosen = int(np.argmin(gap[near] + _FOLD_COST * (upright < _UPRIGHT)))
        best = int(near[chosen])
        folds = upright[chosen] < min(_UPRIGHT, _worst(faces[best : best + 1], scaled)[0])
        if weights[best].min() < _RIM and _sideways(faces[best], row, scaled) > _OFF:
            continue
        # Inside, flips mend a fold; at the border there is nothing to flip with.
        if not _on_border(faces, best, weights[best], 1.0 if folds else _RIM):
            faces = np.concatenate([np.delete(faces, best, axis=0), split[chosen]])
            faces = _flip_around(faces, row, scaled)
    return faces


def _mean_edge(positions: FloatArray, faces: IntArray) -> float:
    return max(float(TriMesh(positions, faces).edge_lengths.mean()), 1e-300)


def _worst(faces: IntArray, placed: Sequence[PlacedPoints]) -> FloatArray:
    """(F,) least agreement of each triangle on any face."""
    least: FloatArray = np.min([p.agreement(faces) for p in placed], axis=0)
    return least


def _nearest(faces: IntArray, row: int, placed: Sequence[PlacedPoints]) -> tuple[FloatArray, FloatArray]:
    """Least weights (F, 3) of the place in each triangle nearest to a point, and the summed squared distance (F,)."""
    weights = np.ones((len(faces), 3))
    gap = np.zeros(len(faces))
    for p in placed:
        corners, point = p.positions[faces], p.positions[row]
        here = closest_on_triangles(np.broadcast_to(point, (len(faces), 3)), corners)
        np.minimum(weights, here, out=weights)
        gap += ((np.einsum("fk,fkc->fc", here, corners) - point) ** 2).sum(axis=1)
    return weights, gap


def _sideways(face: IntArray, row: int, placed: Sequence[PlacedPoints]) -> float:
    """Distance of a point from its place in a triangle, across the point's normal, the least on any face."""
    found = []
    for p in placed:
        corners, point, normal = p.positions[face], p.positions[row], p.normals[row]
        gap = point - closest_on_triangles(point, corners) @ corners
        found.append(float(np.linalg.norm(gap - (gap @ normal) * normal)))
    return min(found)


def _on_border(faces: IntArray, face: int, weights: FloatArray, rim: float) -> bool:
    """Whether a place's weight across a boundary edge of its triangle is below `rim`."""
    for k in range(3):
        a, b = faces[face, k], faces[face, (k + 1) % 3]
        if len(_touching(faces, a, b)) == 1 and weights[(k + 2) % 3] < rim:
            return True
    return False


def _touching(faces: IntArray, a: int, b: int) -> IntArray:
    """Faces at an edge."""
    return np.flatnonzero((faces == a).any(axis=1) & (faces == b).any(axis=1))


def _flip_around(faces: IntArray, row: int, placed: Sequence[PlacedPoints]) -> IntArray:
    """Lawson's flips of the edges opposite to a new vertex, until none of them wants to flip."""
    faces = faces.copy()
    waiting = [_opposite_edge(face, row) for face in faces if row in face]
    while waiting:
        a, b = waiting.pop()
        sides = _touching(faces, a, b)
        mine = sides[(faces[sides] == row).any(axis=1)]
        other = sides[(faces[sides] != row).all(axis=1)]
        if len(mine) != 1 or len(other) != 1:
            continue
        c = int(faces[other[0]].sum() - a - b)
        after = np.array([[row, a, c], [row, c, b]])
        if len(_touching(faces, row, c)) or not _wants_flip(a, b, row, c, after, placed):
            continue
        faces[mine[0]], faces[other[0]] = after
        waiting += [(a, c), (c, b)]
    return faces


def _opposite_edge(face: IntArray, row: int) -> tuple[int, int]:
    turned = np.roll(face, -int(np.flatnonzero(face == row)[0]))
    return int(turned[1]), int(turned[2])


def _wants_flip(a: int, b: int, c: int, d: int, after: IntArray, placed: Sequence[PlacedPoints]) -> bool:
    """Whether to replace edge ab by cd: it mends a fold, or the angles opposite to ab add up to more than pi."""
    both = _worst(np.concatenate([[[c, a, b], [d, b, a]], after]), placed)
    old, new = both[:2].min(), both[2:].min()
    if new < _UPRIGHT:
        return bool(new > old + 1e-9)
    if old < _UPRIGHT:
        return True
    angles = sum(_angle(p.positions, c, a, b) + _angle(p.positions, d, a, b) for p in placed)
    return angles > len(placed) * np.pi * (1 + 1e-9)


def _angle(p: FloatArray, at: int, a: int, b: int) -> float:
    # Plain numbers: on single vectors arrays cost twenty times as much.
    x, y, z = p[at].tolist()
    (ux, uy, uz), (vx, vy, vz) = p[a].tolist(), p[b].tolist()
    ux, uy, uz, vx, vy, vz = ux - x, uy - y, uz - z, vx - x, vy - y, vz - z
    across = math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx)
    return math.atan2(across, ux * vx + uy * vy + uz * vz)
