"""Closest point on a surface, exact, for many queries at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from .arrays import BoolArray, FloatArray, IntArray
from .errors import RetargetError
from .mesh import TriMesh


class Nearest(NamedTuple):
    """Closest places: distance (N,), face (N,), weights (N, 3) of the face's corners, point (N, 3).

    Where nothing was admissible: distance inf, face -1, weights and point 0.
    """

    distance: FloatArray
    face: IntArray
    weights: FloatArray
    point: FloatArray


def closest_on_triangles(points: FloatArray, corners: FloatArray) -> FloatArray:
    """Barycentric weights (..., 3) of the point of each triangle (..., 3, 3) closest to points (..., 3).

    The regions of Ericson, Real-Time Collision Detection (2005), 5.1.5, all at once.
    """
    a, b, c = corners[..., 0, :], corners[..., 1, :], corners[..., 2, :]
    ab, ac, ap = b - a, c - a, points - a
    d1, d2 = _dot(ab, ap), _dot(ac, ap)
    g11, g12, g22 = _dot(ab, ab), _dot(ab, ac), _dot(ac, ac)
    d3, d4 = d1 - g11, d2 - g12
    d5, d6 = d1 - g12, d2 - g22
    va, vb, vc = d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2
    total = np.maximum(va + vb + vc, 1e-300)
    v, w = vb / total, vc / total
    on_bc = (va <= 0) & (d4 - d3 >= 0) & (d5 - d6 >= 0)
    t = (d4 - d3) / np.maximum((d4 - d3) + (d5 - d6), 1e-300)
    v, w = np.where(on_bc, 1 - t, v), np.where(on_bc, t, w)
    on_ac = (vb <= 0) & (d2 >= 0) & (d6 <= 0)
    v, w = np.where(on_ac, 0, v), np.where(on_ac, d2 / np.maximum(d2 - d6, 1e-300), w)
    on_ab = (vc <= 0) & (d1 >= 0) & (d3 <= 0)
    v, w = np.where(on_ab, d1 / np.maximum(d1 - d3, 1e-300), v), np.where(on_ab, 0, w)
    for at, vv, ww in (
        ((d6 >= 0) & (d5 <= d6), 0, 1),
        ((d3 >= 0) & (d4 <= d3), 1, 0),
        ((d1 <= 0) & (d2 <= 0), 0, 0),
    ):
        v, w = np.where(at, vv, v), np.where(at, ww, w)
    return np.stack([1 - v - w, v, w], axis=-1)


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    product: FloatArray = np.einsum("...i,...i->...", a, b)
    return product


class SurfaceFinder:
    """Finds the closest point of a surface for many points, optionally only where normals agree.

    Exact: triangles are kept in classes of similar size, and a class is searched until its next
    centroid is too far away to hold a closer point.
    """

    def __init__(self, mesh: TriMesh, faces: IntArray | None = None) -> None:
        """Search the whole mesh, or only the faces (indices) given."""
        chosen = np.arange(len(mesh.faces)) if faces is None else np.asarray(faces, np.int64)
        if not len(chosen):
            raise RetargetError("a surface without faces has no closest point")
        self._mesh = mesh
        self._corners = mesh.vertices[mesh.faces]
        centre = self._corners.mean(axis=1)
        radius = np.linalg.norm(self._corners - centre[:, None], axis=2).max(axis=1)
        size_class = np.floor(np.log2(np.maximum(radius[chosen], 1e-12 * max(mesh.size, 1e-300)))).astype(int)
        self._classes = []
        for value in np.unique(size_class):
            members = chosen[size_class == value]
            self._classes.append((members, cKDTree(centre[members]), float(radius[members].max())))
        self._classes.sort(key=lambda entry: -len(entry[0]))

    def closest(
        self,
        points: FloatArray,
        normals: FloatArray | None = None,
        agreement: float = -1.0,
        limit: float = np.inf,
    ) -> Nearest:
        """Closest admissible place for each point.

        Parameters
        ----------
        points : (N, 3).
        normals : (N, 3) unit normals; a face counts only where its normal agrees.
        agreement : smallest dot product of the two normals that agrees.
        limit : places farther away than this do not count.
        """
        points = np.asarray(points, np.float64)
        best = np.full(len(points), np.inf if np.isinf(limit) else limit**2)
        face = np.full(len(points), -1, np.int64)
        weights = np.zeros((len(points), 3))
        for members, tree, radius in self._classes:
            active = np.arange(len(points))
            done, take = 0, min(8, len(members))
            while len(active):
                reach = np.sqrt(best[active]) + radius
                distance, rank = tree.query(points[active], k=np.arange(done + 1, take + 1))
                near = np.isfinite(distance) & (distance <= reach[:, None])
                self._improve(points, normals, agreement, active, members, rank, near, best, face, weights)
                if take == len(members):
                    break
                active = active[distance[:, -1] <= np.sqrt(best[active]) + radius]
                done, take = take, min(4 * take, len(members))
        point = np.einsum("nk,nkc->nc", weights, self._corners[face])
        return Nearest(np.where(face >= 0, np.sqrt(best), np.inf), face, weights, np.where(face[:, None] >= 0, point, 0.0))

    def _improve(
        self,
        points: FloatArray,
        normals: FloatArray | None,
        agreement: float,
        active: IntArray,
        members: IntArray,
        rank: IntArray,
        near: BoolArray,
        best: FloatArray,
        face: IntArray,
        weights: FloatArray,
    ) -> None:
        """Try the candidates (rows of `active`, columns of `rank`) marked near; keep what is closer."""
        row, column = np.nonzero(near)
        candidate = members[rank[row, column]]
        if normals is not None:
            agree = _dot(self._mesh.face_normals[candidate], normals[active[row]]) >= agreement
            row, candidate = row[agree], candidate[agree]
        if not len(row):
            return
        query = active[row]
        corners = self._corners[candidate]
        place = closest_on_triangles(points[query], corners)
        gap = np.einsum("nk,nkc->nc", place, corners) - points[query]
        squared = _dot(gap, gap)
        order = np.lexsort((candidate, squared, query))
        first = order[np.unique(query[order], return_index=True)[1]]
        closer = first[squared[first] < best[query[first]]]
        best[query[closer]], face[query[closer]] = squared[closer], candidate[closer]
        weights[query[closer]] = place[closer]
