"""Triangle meshes: the shape every method works on."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from .arrays import BoolArray, FloatArray, IntArray, cross, unit_vectors
from .errors import RetargetError


@dataclass(frozen=True, eq=False)
class TriMesh:
    """A triangle mesh on the artist's own vertices.

    Attributes
    ----------
    vertices : (V, 3) float64, in the object's own units.
    faces : (F, 3) int64 corners, counter-clockwise seen from outside.
    polygons : (F,) int64, the artist's polygon that each triangle was cut from. Vertices are never
        added, dropped or reordered, so vertex i is the artist's vertex i.
    """

    vertices: FloatArray
    faces: IntArray
    polygons: IntArray = field(default_factory=lambda: np.empty(0, np.int64))

    def __post_init__(self) -> None:
        vertices = np.ascontiguousarray(self.vertices, np.float64)
        faces = np.ascontiguousarray(self.faces, np.int64)
        if vertices.ndim != 2 or vertices.shape[1] != 3:
            raise RetargetError(f"mesh vertices have shape {vertices.shape}, expected (V, 3)")
        if faces.ndim != 2 or faces.shape[1] != 3:
            raise RetargetError(f"mesh faces have shape {faces.shape}, expected (F, 3)")
        polygons = np.asarray(self.polygons, np.int64)
        if len(polygons) != len(faces):
            polygons = np.arange(len(faces))
        object.__setattr__(self, "vertices", vertices)
        object.__setattr__(self, "faces", faces)
        object.__setattr__(self, "polygons", polygons)

    @classmethod
    def from_polygons(cls, vertices: FloatArray, counts: IntArray, corners: IntArray) -> TriMesh:
        """Triangulate polygons, keeping the artist's vertices and the map to the polygons.

        Parameters
        ----------
        vertices : (V, 3) positions.
        counts : (P,) corners of each polygon, at least 3.
        corners : (sum of counts,) vertex indices, polygon after polygon.

        Raises
        ------
        RetargetError : if a polygon has fewer than 3 corners, if the counts do not add up to the
            number of corners, or if a corner is no vertex.
        """
        vertices = np.asarray(vertices, np.float64)
        counts = np.asarray(counts, np.int64)
        corners = np.asarray(corners, np.int64)
        if counts.sum() != len(corners):
            raise RetargetError(f"polygons name {counts.sum()} corners, but {len(corners)} arrived")
        if len(counts) and counts.min() < 3:
            bad = int(np.argmin(counts))
            raise RetargetError(f"polygon {bad} has {counts[bad]} corners, expected at least 3")
        _check_range(corners, len(vertices))
        start = np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(np.int64)
        faces: list[IntArray] = []
        owners: list[IntArray] = []
        for size in np.unique(counts):
            polygon = np.flatnonzero(counts == size)
            ring = corners[start[polygon][:, None] + np.arange(size)]
            if size == 4:
                ring = _turn_quads(vertices, ring)
            if size <= 4:
                for k in range(1, int(size) - 1):
                    faces.append(ring[:, [0, k, k + 1]])
                    owners.append(polygon)
            else:
                for p, one in zip(polygon, ring, strict=True):
                    triangles = _clip_ears(vertices, one)
                    faces.append(triangles)
                    owners.append(np.full(len(triangles), p))
        if not faces:
            return cls(vertices, np.empty((0, 3), np.int64))
        owner = np.concatenate(owners)
        order = np.argsort(owner, kind="stable")
        return cls(vertices, np.concatenate(faces)[order], owner[order])

    def checked(self, what: str) -> TriMesh:
        """The mesh itself, if every method can work on it.

        Parameters
        ----------
        what : how to name the mesh in the message, such as "target neutral 'head.obj'".

        Raises
        ------
        RetargetError : if it is empty, holds NaN or infinite vertices, or face indices out of range.
        """
        if not len(self.vertices) or not len(self.faces):
            raise RetargetError(
                f"{what} has {len(self.vertices)} vertices and {len(self.faces)} faces, expected a surface"
            )
        bad = np.flatnonzero(~np.isfinite(self.vertices).all(axis=1))
        if len(bad):
            raise RetargetError(
                f"{what} has {len(bad)} vertices that are NaN or infinite, the first is vertex {bad[0]}; "
                "expected finite positions"
            )
        _check_range(self.faces, len(self.vertices), what)
        return self

    def with_vertices(self, vertices: FloatArray) -> TriMesh:
        """The same faces on other positions (V, 3)."""
        if np.shape(vertices) != self.vertices.shape:
            raise RetargetError(f"mesh vertices have shape {np.shape(vertices)}, expected {self.vertices.shape}")
        moved = TriMesh(vertices, self.faces, self.polygons)
        # What depends on the faces alone is not worked out again.
        kept = self.__dict__.keys() & {"half_edges", "_edge_table", "boundary_edges", "boundary_vertices", "components"}
        moved.__dict__.update({name: self.__dict__[name] for name in kept})
        return moved

    # ---- measures -------------------------------------------------------------------------------
    @cached_property
    def face_vectors(self) -> FloatArray:
        """(F, 3) face normals times twice the area."""
        a, b, c = (self.vertices[self.faces[:, k]] for k in range(3))
        return cross(b - a, c - a)

    @cached_property
    def face_normals(self) -> FloatArray:
        """(F, 3) unit normals; zero for a face without area."""
        return unit_vectors(self.face_vectors)

    @cached_property
    def face_areas(self) -> FloatArray:
        """(F,) areas, in square units."""
        areas: FloatArray = 0.5 * np.linalg.norm(self.face_vectors, axis=1)
        return areas

    @cached_property
    def vertex_normals(self) -> FloatArray:
        """(V, 3) area-weighted unit normals; zero for a vertex of no face."""
        return unit_vectors(self.corner_sum(self.face_vectors))

    @cached_property
    def vertex_areas(self) -> FloatArray:
        """(V,) a third of the area of the faces around each vertex."""
        return np.bincount(self.faces.ravel(), np.repeat(self.face_areas / 3, 3), len(self.vertices)).astype(np.float64)

    @cached_property
    def area(self) -> float:
        """Surface area, in square units."""
        return float(self.face_areas.sum())

    @cached_property
    def size(self) -> float:
        """Longest side of the bounding box of the vertices that carry faces."""
        return float(np.ptp(self.vertices[np.unique(self.faces)], axis=0).max())

    def corner_sum(self, values: FloatArray) -> FloatArray:
        """Sum of face values (F, 3) over the faces around each vertex, (V, 3)."""
        index = self.faces.ravel()
        return np.stack([np.bincount(index, np.repeat(values[:, k], 3), len(self.vertices)) for k in range(3)], axis=1)

    # ---- connectivity ---------------------------------------------------------------------------
    @cached_property
    def half_edges(self) -> IntArray:
        """(3F, 2) directed edges, the three of face 0 first."""
        edges: IntArray = self.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        return edges

    @cached_property
    def _edge_table(self) -> tuple[IntArray, IntArray, IntArray]:
        low = self.half_edges.min(axis=1)
        key = low * len(self.vertices) + self.half_edges.max(axis=1)
        unique, inverse, count = np.unique(key, return_inverse=True, return_counts=True)
        edges = np.stack([unique // len(self.vertices), unique % len(self.vertices)], axis=1)
        return edges, inverse.reshape(-1, 3), count

    @property
    def edges(self) -> IntArray:
        """(E, 2) undirected edges, lower vertex first, sorted."""
        return self._edge_table[0]

    @property
    def face_edges(self) -> IntArray:
        """(F, 3) for face (a, b, c) the edges ab, bc, ca as rows of `edges`."""
        return self._edge_table[1]

    @property
    def edge_face_count(self) -> IntArray:
        """(E,) faces at each edge: 1 on a boundary, 2 inside, more where the mesh is not manifold."""
        return self._edge_table[2]

    @cached_property
    def edge_lengths(self) -> FloatArray:
        """(E,) lengths of `edges`."""
        lengths: FloatArray = np.linalg.norm(self.vertices[self.edges[:, 0]] - self.vertices[self.edges[:, 1]], axis=1)
        return lengths

    @cached_property
    def vertex_edge_length(self) -> FloatArray:
        """(V,) mean length of the edges at each vertex; the mesh's mean for a vertex of no edge."""
        index = self.edges.ravel()
        count = np.bincount(index, minlength=len(self.vertices))
        total = np.bincount(index, np.repeat(self.edge_lengths, 2), len(self.vertices))
        mean = self.edge_lengths.mean() if len(self.edge_lengths) else 0.0
        return np.where(count > 0, total / np.maximum(count, 1), mean)

    @cached_property
    def graph(self) -> sp.csr_matrix:
        """(V, V) symmetric matrix of edge lengths; a zero-length edge keeps a tiny length."""
        i, j = self.edges.T
        length = np.maximum(self.edge_lengths, 1e-12 * max(self.size, 1e-300))
        half = sp.coo_matrix((length, (i, j)), shape=(len(self.vertices),) * 2)
        return (half + half.T).tocsr()

    @cached_property
    def neighbours_mean(self) -> sp.csr_matrix:
        """(V, V) mean of each vertex's neighbours, near ones counting more; no row for a vertex without edges."""
        nearness = self.graph.copy()
        nearness.data = 1 / np.maximum(nearness.data, 1e-3 * self.edge_lengths.mean())
        total = np.asarray(nearness.sum(axis=1)).ravel()
        return (sp.diags(1 / np.maximum(total, 1e-300)) @ nearness).tocsr()

    @cached_property
    def boundary_edges(self) -> IntArray:
        """(B, 2) directed boundary edges, in the direction of their face."""
        single = self.edge_face_count == 1
        return self.half_edges[single[self.face_edges.ravel()]]

    @cached_property
    def boundary_vertices(self) -> BoolArray:
        """(V,) true for vertices on a boundary edge."""
        mask = np.zeros(len(self.vertices), bool)
        mask[self.boundary_edges.ravel()] = True
        return mask

    @cached_property
    def boundary_loops(self) -> list[IntArray]:
        """Closed boundary polylines as vertex indices, longest (by edge length) first.

        Edges run in the direction of their faces. A vertex where several loops touch is passed
        once by each of them.
        """
        following: dict[int, list[int]] = {}
        for a, b in self.boundary_edges.tolist():
            following.setdefault(a, []).append(b)
        loops: list[IntArray] = []
        for first in list(following):
            while following.get(first):
                loop = [first]
                vertex = following[first].pop()
                while vertex != first and following.get(vertex):
                    loop.append(vertex)
                    vertex = following[vertex].pop()
                loops.append(np.array(loop, np.int64))
        return sorted(loops, key=lambda loop: -self._loop_length(loop))

    def _loop_length(self, loop: IntArray) -> float:
        p = self.vertices[loop]
        return float(np.linalg.norm(p - np.roll(p, -1, axis=0), axis=1).sum())

    @cached_property
    def components(self) -> IntArray:
        """(V,) label of the connected component of each vertex."""
        labels: IntArray = connected_components(self.graph, directed=False)[1].astype(np.int64)
        return labels

    @cached_property
    def is_edge_manifold(self) -> bool:
        """Whether at most two faces, of opposite direction, meet at each edge."""
        return bool(self.edge_face_count.max(initial=0) <= 2) and self.is_oriented

    @cached_property
    def is_oriented(self) -> bool:
        """Whether no directed edge is used twice."""
        key = self.half_edges[:, 0] * len(self.vertices) + self.half_edges[:, 1]
        return len(np.unique(key)) == len(key)


def _check_range(index: IntArray, count: int, what: str = "mesh") -> None:
    bad = np.flatnonzero((index.ravel() < 0) | (index.ravel() >= count))
    if len(bad):
        value = int(index.ravel()[bad[0]])
        raise RetargetError(f"{what} has a face with vertex {value}, expected 0 to {count - 1}")


def _turn_quads(vertices: FloatArray, quads: IntArray) -> IntArray:
    """Quads (Q, 4) turned so that cutting from corner 0 to 2 gives no flipped triangle, or the shorter cut."""
    p = vertices[quads]
    normal = cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1])

    def smallest(i: int, j: int, k: int, m: int) -> FloatArray:
        one = np.einsum("ij,ij->i", cross(p[:, j] - p[:, i], p[:, k] - p[:, i]), normal)
        two = np.einsum("ij,ij->i", cross(p[:, k] - p[:, i], p[:, m] - p[:, i]), normal)
        return np.minimum(one, two)

    first, second = smallest(0, 1, 2, 3), smallest(1, 2, 3, 0)
    cut_02 = np.linalg.norm(p[:, 0] - p[:, 2], axis=1)
    cut_13 = np.linalg.norm(p[:, 1] - p[:, 3], axis=1)
    convex = (first > 0) & (second > 0)
    turn = np.where(convex, cut_13 < cut_02 * (1 - 1e-9), second > first)
    turned: IntArray = np.where(turn[:, None], quads[:, [1, 2, 3, 0]], quads)
    return turned


def _clip_ears(vertices: FloatArray, ring: IntArray) -> IntArray:
    """Triangles (n - 2, 3) of one polygon (n,), convex or not: the best-shaped ear is cut off until three are left."""
    p = vertices[ring]
    normal = cross(p, np.roll(p, -1, axis=0)).sum(axis=0)
    axis = int(np.argmax(np.abs(normal)))
    u, v = ((1, 2), (2, 0), (0, 1))[axis]
    q = p[:, [u, v]] * (1.0 if normal[axis] >= 0 else -1.0) ** np.array([1, 0])

    def area(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
        ab, ac = b - a, c - a
        twice: FloatArray = ab[..., 0] * ac[..., 1] - ab[..., 1] * ac[..., 0]
        return twice

    count = len(ring)
    before, after = np.roll(np.arange(count), 1), np.roll(np.arange(count), -1)
    left = np.ones(count, bool)
    score = np.zeros(count)
    blocked = np.zeros((count, count), bool)  # [ear, corner that lies inside it]

    def look(ear: IntArray) -> None:
        corners = np.stack([before[ear], ear, after[ear]])
        a, b, c = q[corners]
        turn = area(a, b, c)
        longest = np.max([((s - t) ** 2).sum(axis=1) for s, t in ((a, b), (b, c), (c, a))], axis=0)
        score[ear] = np.divide(turn, longest, out=np.zeros(len(ear)), where=longest > 0)
        a, b, c = a[:, None], b[:, None], c[:, None]
        inside = (area(a, b, q) >= 0) & (area(b, c, q) >= 0) & (area(c, a, q) >= 0) & (turn > 0)[:, None]
        inside[np.arange(len(ear)), corners] = False
        blocked[ear] = inside & left

    look(np.arange(count))
    triangles: list[tuple[int, int, int]] = []
    for _ in range(count - 3):
        ear = int(np.argmax(np.where(left, np.where(blocked.any(axis=1), -1e300, score), -np.inf)))
        one, other = int(before[ear]), int(after[ear])
        triangles.append((one, ear, other))
        left[ear] = False
        blocked[:, ear] = False
        after[one], before[other] = other, one
        look(np.array([one, other]))
    last = int(np.argmax(left))
    triangles.append((last, int(after[last]), int(before[last])))
    return ring[np.array(triangles)]
