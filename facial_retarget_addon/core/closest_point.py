"""Closest point on a surface, exact, for many queries at once."""

from __future__ import annotations

from functools import cached_property
from itertools import chain
from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from .arrays import FloatArray, IntArray
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

    Exact: large triangles stand in the search as several pieces of like size, and a search goes on until the next
    piece is too far away to hold a closer point. Points that see no agreeing face nearby go on to search the faces
    by the octants of their normals, where most candidates agree.
    """

    def __init__(self, mesh: TriMesh, faces: IntArray | None = None) -> None:
        """Search the whole mesh, or only the faces (indices) given."""
        chosen = np.arange(len(mesh.faces)) if faces is None else np.asarray(faces, np.int64)
        if not len(chosen):
            raise RetargetError("a surface without faces has no closest point")
        self._mesh = mesh
        self._faces = chosen
        self._corners = mesh.vertices[mesh.faces]
        self._whole = _Pieces(self._corners, chosen)

    def normals(self, faces: IntArray) -> FloatArray:
        """(N, 3) normals of faces (N,) of the mesh."""
        normals: FloatArray = self._mesh.face_normals[faces]
        return normals

    @cached_property
    def _octants(self) -> dict[int, _Pieces]:
        octant = (self._mesh.face_normals[self._faces] > 0) @ _OCTANT
        return {int(k): _Pieces(self._corners, self._faces[octant == k]) for k in np.unique(octant)}

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
        points = np.ascontiguousarray(points, np.float64)
        search = _Search(self._mesh, self._corners, points, normals, agreement, limit)
        active, whole = np.arange(len(points)), self._whole
        if np.isfinite(limit):
            # Asked for several neighbours of a place far from all, the tree looks at most of them.
            active = np.flatnonzero(
                np.isfinite(whole.tree.query(points, distance_upper_bound=limit + whole.largest)[0])
            )
        rest = search.run(whole, active, _NEIGHBOURS if normals is not None else len(self._faces))
        if len(rest) and normals is not None:
            own = (normals[rest] > 0) @ _OCTANT
            for octant, pieces in self._octants.items():
                search.run(pieces, rest[own == octant], len(pieces.face))
            for octant, pieces in self._octants.items():
                search.run(pieces, rest[own != octant], len(pieces.face))
        return search.result()

    def on_faces(self, points: FloatArray, faces: IntArray) -> Nearest:
        """Closest place of a face (N,) given for each point (N, 3); nothing for those of face -1."""
        found = faces >= 0
        corners = self._corners[np.maximum(faces, 0)]
        weights = closest_on_triangles(points, corners) * found[:, None]
        place = np.einsum("nk,nkc->nc", weights, corners)
        distance = np.where(found, np.linalg.norm(points - place, axis=1), np.inf)
        return Nearest(distance, faces, weights, place)


def closest_agreeing(
    finder: SurfaceFinder,
    points: FloatArray,
    normals: FloatArray,
    agreement: float,
    limit: FloatArray | float = np.inf,
) -> Nearest:
    """Closest place (N) whose normal agrees; the closest of all where none within the limit (N,) agrees."""
    near = finder.closest(points, normals, agreement)
    lost = (near.face < 0) | (near.distance > limit)
    if lost.any():
        for mine, other in zip(near, finder.closest(points[lost]), strict=True):
            mine[lost] = other
    return near


def some_places(places: Nearest, rows: IntArray | list[int]) -> Nearest:
    """The places of some rows."""
    return Nearest(places.distance[rows], places.face[rows], places.weights[rows], places.point[rows])


_NEIGHBOURS = 24
_FIRST = 6
_OCTANT = np.array([1, 2, 4])
_BLOCK = 1 << 21


class _Pieces:
    """Faces cut into pieces of like size, and a tree of their centres."""

    def __init__(self, corners: FloatArray, faces: IntArray) -> None:
        piece, face = corners[faces], faces
        radius = _radius(piece)
        largest = 1.5 * np.median(radius)
        done_piece: list[FloatArray] = []
        done_face: list[IntArray] = []
        while len(piece):
            # Cutting more than some 2^7 pieces from one triangle costs more than a wide search.
            large = (radius > largest) & (len(done_piece) < 7)
            done_piece.append(piece[~large])
            done_face.append(face[~large])
            piece, face = _halves(piece[large]), np.repeat(face[large], 2)
            radius = _radius(piece)
        piece = np.concatenate(done_piece)
        self.face = np.concatenate(done_face)
        self.radius = _radius(piece)
        self.largest = float(self.radius.max())
        self.tree = cKDTree(piece.mean(axis=1))


def _radius(pieces: FloatArray) -> FloatArray:
    """(N,) distance of the farthest corner from the centre of triangles (N, 3, 3)."""
    gap = pieces - pieces.mean(axis=1, keepdims=True)
    radius: FloatArray = np.sqrt(np.einsum("nkc,nkc->nk", gap, gap).max(axis=1, initial=0))
    return radius


def _blocks(rows: IntArray, size: int) -> list[IntArray]:
    return [rows[start : start + size] for start in range(0, len(rows), size)]


def _halves(triangles: FloatArray) -> FloatArray:
    """(2N, 3, 3) both halves of triangles (N, 3, 3), cut at the middle of their longest sides."""
    side = triangles[:, [1, 2, 0]] - triangles
    first = np.einsum("nkc,nkc->nk", side, side).argmax(axis=1)
    a, b, c = (triangles[np.arange(len(triangles)), (first + k) % 3] for k in range(3))
    middle = 0.5 * (a + b)
    return np.stack([np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)], axis=1).reshape(-1, 3, 3)


class _Search:
    """The best places found so far."""

    def __init__(
        self,
        mesh: TriMesh,
        corners: FloatArray,
        points: FloatArray,
        normals: FloatArray | None,
        agreement: float,
        limit: float,
    ) -> None:
        self._mesh, self._corners = mesh, corners
        self._points, self._normals, self._agreement = points, normals, agreement
        self._best = np.full(len(points), float(limit))
        self._face = np.full(len(points), -1, np.int64)
        self._weights = np.zeros((len(points), 3))

    def run(self, pieces: _Pieces, active: IntArray, most: int) -> IntArray:
        """Search the pieces for the points `active`; gives back the points that agree with none of `most` neighbours.

        The nearest pieces give a first bound; the pieces that may be closer than it are then tried once each.
        """
        bound = self._face[active] >= 0
        self._sweep(pieces, active[bound])
        active = active[~bound]
        done, take, total = 0, _FIRST, len(pieces.face)
        most = min(most, total)
        while len(active) and done < most:
            take = min(take, most)
            left = []
            for rows in _blocks(active, max(1, _BLOCK // take)):
                distance, rank = pieces.tree.query(self._points[rows], k=np.arange(done + 1, take + 1))
                untried = self._improve(pieces, rows, distance, rank)
                # Two tries may both lie beyond the limit while a third does not.
                again = (self._face[rows] < 0) & (untried < self._best[rows])
                self._try_all(rows[again], pieces.face[rank[again]])
                unseen = distance[:, -1] - pieces.largest
                unbound = self._face[rows] < 0
                left.append(rows[unbound & (unseen < self._best[rows])])
                self._sweep(pieces, rows[~unbound & (np.minimum(untried, unseen) < self._best[rows])])
            active = np.concatenate(left)
            done, take = take, 4 * take
        return active if most < total else active[:0]

    def _sweep(self, pieces: _Pieces, rows: IntArray) -> None:
        """Try every piece that may hold a closer place for the points `rows`, which have a bound."""
        for some in _blocks(rows, 4096):
            reach = self._best[some] + pieces.largest
            near = pieces.tree.query_ball_point(self._points[some], reach, return_sorted=False)
            size = np.fromiter(map(len, near), np.int64, len(some))
            rank = np.fromiter(chain.from_iterable(near), np.int64, int(size.sum()))
            query, face = np.repeat(some, size), pieces.face[rank]
            gap = self._points[query] - pieces.tree.data[rank]
            may = np.flatnonzero(_dot(gap, gap) < (self._best[query] + pieces.radius[rank]) ** 2)
            if self._normals is not None:
                agree = _dot(self._mesh.face_normals[face[may]], self._normals[query[may]]) >= self._agreement
                may = may[agree]
            self._try(query[may], face[may])

    def _try_all(self, rows: IntArray, faces: IntArray) -> None:
        """Try every agreeing one of the faces (N, K) for the points `rows` (N,)."""
        query, face = np.repeat(rows, faces.shape[1]), faces.ravel()
        if self._normals is not None:
            agree = _dot(self._mesh.face_normals[face], self._normals[query]) >= self._agreement
            query, face = query[agree], face[agree]
        self._try(query, face)

    def _improve(self, pieces: _Pieces, rows: IntArray, distance: FloatArray, rank: IntArray) -> FloatArray:
        """Try the two nearest agreeing ones of the pieces `rank` (N, K); the least distance of the others, (N,)."""
        face = pieces.face[rank]
        bound = distance - pieces.radius[rank]
        if self._normals is not None:
            agree = np.einsum("nkc,nc->nk", self._mesh.face_normals[face], self._normals[rows]) >= self._agreement
            bound[~agree] = np.inf
        at = np.arange(len(rows))
        for _ in range(2):
            first = bound.argmin(axis=1)
            agreeing = np.isfinite(bound[at, first])
            self._try(rows[agreeing], face[at, first][agreeing])
            bound[at, first] = np.inf
        least: FloatArray = bound.min(axis=1)
        return least

    def _try(self, query: IntArray, face: IntArray) -> None:
        """Exact distances of faces (M,) from the points `query` (M,); the closest are kept, lower face first."""
        gap = self._points[query] - self._corners[face, 0]
        height = np.abs(np.einsum("nc,nc->n", gap, self._mesh.face_normals[face]))
        may = height < self._best[query]
        query, face = query[may], face[may]
        corners = self._corners[face]
        place = closest_on_triangles(self._points[query], corners)
        gap = np.einsum("nk,nkc->nc", place, corners) - self._points[query]
        distance = np.sqrt(_dot(gap, gap))
        order = np.lexsort((face, distance, query))
        first = order[np.unique(query[order], return_index=True)[1]]
        closer = first[distance[first] < self._best[query[first]]]
        kept = query[closer]
        self._best[kept], self._face[kept], self._weights[kept] = distance[closer], face[closer], place[closer]

    def result(self) -> Nearest:
        found = self._face >= 0
        point = np.einsum("nk,nkc->nc", self._weights, self._corners[self._face])
        return Nearest(
            np.where(found, self._best, np.inf), self._face, self._weights, np.where(found[:, None], point, 0.0)
        )
