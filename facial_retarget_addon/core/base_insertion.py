"""Points inserted into a triangulation that lies on two faces at once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .arrays import FloatArray, IntArray
from .closest_point import closest_on_triangles
from .mesh import TriMesh

_RIM = 0.02
"""A point whose weight inside a border triangle is below this lies on the border or outside."""


def insert_points(faces: IntArray, rows: IntArray, positions: Sequence[FloatArray]) -> IntArray:
    """Triangulation with more of the points as vertices.

    Each point splits the triangle that is nearest to it on all faces together; edges are then flipped until
    the triangulation is intrinsically Delaunay. Boundary loops stay as they are.

    Parameters
    ----------
    faces : (F, 3) manifold triangulation of some of the P points.
    rows : (K,) points to insert.
    positions : for each face the points' positions (P, 3), in any unit.

    Returns
    -------
    (F + 2 K', 3); points on the border or outside are in no triangle.
    """
    scaled = [p / _mean_edge(p, faces) for p in positions]
    for row in rows.tolist():
        weights, gap = _nearest(faces, row, scaled)
        best = int(np.argmin(gap))
        if _on_border(faces, best, weights[best]):
            continue
        a, b, c = faces[best].tolist()
        faces = np.concatenate([np.delete(faces, best, axis=0), [[a, b, row], [b, c, row], [c, a, row]]])
        faces = _flip_around(faces, row, scaled)
    return faces


def _mean_edge(positions: FloatArray, faces: IntArray) -> float:
    return max(float(TriMesh(positions, faces).edge_lengths.mean()), 1e-300)


def _nearest(faces: IntArray, row: int, positions: Sequence[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Mean weights (F, 3) of the place in each triangle nearest to a point, and the summed squared distance (F,)."""
    weights = np.zeros((len(faces), 3))
    gap = np.zeros(len(faces))
    for p in positions:
        corners = p[faces]
        here = closest_on_triangles(np.broadcast_to(p[row], (len(faces), 3)), corners)
        weights += here / len(positions)
        gap += ((np.einsum("fk,fkc->fc", here, corners) - p[row]) ** 2).sum(axis=1)
    return weights, gap


def _on_border(faces: IntArray, face: int, weights: FloatArray) -> bool:
    """Whether a place touches a boundary edge of its triangle."""
    corners = faces[face]
    for k in range(3):
        a, b = corners[k], corners[(k + 1) % 3]
        shared = ((faces == a).any(axis=1) & (faces == b).any(axis=1)).sum()
        if shared == 1 and weights[(k + 2) % 3] < _RIM:
            return True
    return False


def _flip_around(faces: IntArray, row: int, positions: Sequence[FloatArray]) -> IntArray:
    """Lawson's flips of the edges opposite to a new vertex, until none of them wants to flip."""
    faces = faces.copy()
    open_edges = [tuple(np.roll(f, -int(np.flatnonzero(f == row)[0]))[1:].tolist()) for f in faces if row in f]
    while open_edges:
        a, b = open_edges.pop()
        mine = np.flatnonzero((faces == a).any(axis=1) & (faces == b).any(axis=1) & (faces == row).any(axis=1))
        other = np.flatnonzero((faces == a).any(axis=1) & (faces == b).any(axis=1) & ~(faces == row).any(axis=1))
        if not len(mine) or not len(other):
            continue
        c = int(faces[other[0]].sum() - a - b)
        joined = ((faces == row).any(axis=1) & (faces == c).any(axis=1)).any()
        if joined or not _wants_flip(a, b, row, c, positions):
            continue
        faces[mine[0]] = [row, a, c]
        faces[other[0]] = [row, c, b]
        open_edges += [(a, c), (c, b)]
    return faces


def _wants_flip(a: int, b: int, c: int, d: int, positions: Sequence[FloatArray]) -> bool:
    """Whether the angles opposite to edge ab, at c and d, add up to more than pi on average."""
    total = sum(_angle(p, c, a, b) + _angle(p, d, a, b) for p in positions)
    turned = max(max(_angle(p, a, c, b) + _angle(p, a, d, b), _angle(p, b, c, a) + _angle(p, b, d, a)) for p in positions)
    return total > len(positions) * np.pi * (1 + 1e-9) and turned < np.pi


def _angle(p: FloatArray, at: int, a: int, b: int) -> float:
    u, v = p[a] - p[at], p[b] - p[at]
    return float(np.arctan2(np.linalg.norm(np.cross(u, v)), u @ v))
