"""Lips and lids: which side of an opening a vertex belongs to."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import csgraph_from_dense, dijkstra

from ..arrays import BoolArray, FloatArray, IntArray
from ..mesh import TriMesh

FAR = 4.0
"""Places at the ends of an edge are apart if the way along the source is this many times as long as the edge."""
_BLOCK = 64


class Sides:
    """Regions of feature points on both faces, and which of them lie on opposite sides of an opening.

    Each vertex belongs to the point that is nearest along its surface. Two points are opposite where they are near in
    space and far along the source's surface, as the middles of two lips are.
    """

    def __init__(
        self, source: TriMesh, source_points: IntArray, target: TriMesh, target_points: IntArray, extent: float
    ) -> None:
        """Find the regions.

        Parameters
        ----------
        source_points, target_points : (P,) vertices at the points.
        extent : size of the region that holds the points, in source units.
        """
        self._here = _nearest_point(target, target_points)[0]
        self._there, away = _nearest_point(source, source_points)
        near = 0.25 * extent
        position = source.vertices[source_points]
        gap = np.linalg.norm(position[:, None] - position, axis=2)
        apart = np.maximum(3 * gap, 0.3 * near)
        # A way over the regions between two points is no shorter than the shortest: only what is far by it may be far.
        opposite = (gap < near) & (_over_regions(source, self._there, away, len(source_points)) > apart)
        rows = np.flatnonzero(opposite.any(axis=1))
        if len(rows):
            opposite[rows] &= (
                dijkstra(source.graph, indices=source_points[rows], limit=3 * near)[:, source_points] > apart[rows]
            )
        # A last row and column for vertices of no region, which are opposite to nothing.
        self._opposite = np.pad(opposite, ((0, 1), (0, 1)))
        self._faces, self._graph, self._extent = source.faces, source.graph, extent
        meeting = self._there[source.edges]
        self._touching = np.eye(len(source_points) + 1, dtype=bool)
        self._touching[meeting[:, 0], meeting[:, 1]] = self._touching[meeting[:, 1], meeting[:, 0]] = True
        self._touching[-1] = False

    def crossed(self, place_vertices: IntArray) -> BoolArray:
        """(Vt,) true for target vertices whose places, next to the source vertices given (Vt,), are opposite."""
        crossed: BoolArray = self._opposite[self._here, self._there[place_vertices]]
        return crossed

    def bridged(self, edges: IntArray, place_vertices: IntArray, lengths: FloatArray) -> BoolArray:
        """(Vt,) true at the ends of target edges (E, 2) that lie across an opening that the source has there: their
        places, next to the source vertices given (Vt,), are opposite and far apart along the source.

        If one end alone lies on a side that is neither its own nor its neighbour's, the other is not to blame.

        Parameters
        ----------
        lengths : (E,) of the edges, in source units.
        """
        places = place_vertices[edges]
        opposite = self._opposite[self._there[places[:, 0]], self._there[places[:, 1]]]
        edges, places, lengths = edges[opposite], places[opposite], lengths[opposite]
        ends = np.zeros(len(place_vertices), bool)
        if len(edges):
            far = _farther(self._graph, places, FAR * lengths)
            own, beside = (
                self._opposite[self._here[ends_of], self._there[places]] for ends_of in (edges, edges[:, ::-1])
            )
            astray = own | beside
            ends[edges[far[:, None] & (astray | ~astray[:, ::-1])]] = True
        return ends

    def groups(self, vertices: IntArray) -> list[tuple[IntArray, IntArray, FloatArray]]:
        """For target vertices (N,) in groups: their indices, the source faces around the group on its own side, and
        how deep each source vertex lies in regions opposite to the group, (Vs,), infinite beyond 0.12 of the extent.
        """
        point = self._here[vertices]
        result = []
        for k in np.unique(point):
            allowed = self._touching[k] & ~self._opposite[k]
            faces = np.flatnonzero(allowed[self._there[self._faces]].all(axis=1))
            if len(faces):
                own = np.flatnonzero(~self._opposite[k, self._there])
                depth = dijkstra(self._graph, indices=own, min_only=True, limit=0.12 * self._extent)
                result.append((vertices[point == k], faces, depth))
        return result


def _nearest_point(mesh: TriMesh, points: IntArray) -> tuple[IntArray, FloatArray]:
    """(V,) index of the point (P,) nearest along the surface, -1 where none can be reached, and how far (V,)."""
    distance, _, origin = dijkstra(mesh.graph, indices=points, min_only=True, return_predecessors=True)
    index = np.full(len(mesh.vertices), -1, np.int64)
    index[points] = np.arange(len(points))
    nearest: IntArray = np.where(np.isfinite(distance), index[np.where(np.isfinite(distance), origin, 0)], -1)
    return nearest, distance


def _over_regions(mesh: TriMesh, nearest: IntArray, away: FloatArray, count: int) -> FloatArray:
    """(P, P) lengths of ways over the surface from point to point, by the points whose regions lie between them."""
    first, second = nearest[mesh.edges].T
    meets = np.flatnonzero((first != second) & (first >= 0) & (second >= 0))
    length = away[mesh.edges[meets]].sum(axis=1) + mesh.edge_lengths[meets]
    steps = np.full((count, count), np.inf)
    np.minimum.at(steps, (first[meets], second[meets]), length)
    found: FloatArray = dijkstra(csgraph_from_dense(steps, null_value=np.inf), directed=False)
    return found


def _farther(graph: sp.csr_matrix, pairs: IntArray, lengths: FloatArray) -> BoolArray:
    """(N,) whether the way over a graph between two vertices (N, 2) is longer than given (N,)."""
    starts, start = np.unique(pairs[:, 0], return_inverse=True)
    way = np.full(len(pairs), np.inf)
    for first in range(0, len(starts), _BLOCK):
        found = dijkstra(graph, indices=starts[first : first + _BLOCK], limit=float(lengths.max()))
        here = (start >= first) & (start < first + _BLOCK)
        way[here] = found[start[here] - first, pairs[here, 1]]
    farther: BoolArray = way > lengths
    return farther
