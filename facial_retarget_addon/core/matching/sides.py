"""Lips and lids: which side of an opening a vertex belongs to."""

from __future__ import annotations

import numpy as np
from scipy.sparse.csgraph import dijkstra

from ..arrays import BoolArray, FloatArray, IntArray
from ..mesh import TriMesh


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
        near = 0.25 * extent
        position = source.vertices[source_points]
        gap = np.linalg.norm(position[:, None] - position, axis=2)
        along = dijkstra(source.graph, indices=source_points, limit=3 * near)[:, source_points]
        opposite = (gap < near) & (along > 3 * gap) & (along > 0.3 * near)
        # A last row and column for vertices of no region, which are opposite to nothing.
        self._opposite = np.pad(opposite, ((0, 1), (0, 1)))
        self._here = _nearest_point(target, target_points)
        self._there = _nearest_point(source, source_points)
        self._faces, self._graph, self._extent = source.faces, source.graph, extent
        meeting = self._there[source.edges]
        self._touching = np.eye(len(source_points) + 1, dtype=bool)
        self._touching[meeting[:, 0], meeting[:, 1]] = self._touching[meeting[:, 1], meeting[:, 0]] = True
        self._touching[-1] = False

    def crossed(self, place_vertices: IntArray) -> BoolArray:
        """(Vt,) true for target vertices whose places, next to the source vertices given (Vt,), are opposite."""
        crossed: BoolArray = self._opposite[self._here, self._there[place_vertices]]
        return crossed

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


def _nearest_point(mesh: TriMesh, points: IntArray) -> IntArray:
    """(V,) index of the point (P,) nearest along the surface, -1 where none can be reached."""
    distance, _, origin = dijkstra(mesh.graph, indices=points, min_only=True, return_predecessors=True)
    index = np.full(len(mesh.vertices), -1, np.int64)
    index[points] = np.arange(len(points))
    nearest: IntArray = np.where(np.isfinite(distance), index[np.where(np.isfinite(distance), origin, 0)], -1)
    return nearest
