"""Walking around vertices and over edges: half-edges and their twins."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from ..arrays import IntArray
from ..mesh import TriMesh


class HalfEdges:
    """The directed edges of an edge-manifold, oriented mesh: half-edge 3 f + k leaves corner k of face f.

    Attributes
    ----------
    start, end : (H,) vertices.
    edge : (H,) rows of the mesh's edges.
    twin : (H,) the same edge in the other face, -1 on the boundary.
    """

    def __init__(self, mesh: TriMesh) -> None:
        self.start, self.end = mesh.half_edges.T
        self.edge: IntArray = mesh.face_edges.ravel()
        self._vertex_count = len(mesh.vertices)
        order = np.argsort(self.edge, kind="stable")
        pair = np.flatnonzero(self.edge[order[1:]] == self.edge[order[:-1]])
        self.twin: IntArray = np.full(len(order), -1, np.int64)
        self.twin[order[pair]], self.twin[order[pair + 1]] = order[pair + 1], order[pair]

    @staticmethod
    def after(half: IntArray) -> IntArray:
        """The next half-edges of the same faces."""
        return half - half % 3 + (half + 1) % 3

    @staticmethod
    def before(half: IntArray) -> IntArray:
        """The half-edges before them in the same faces."""
        return half - half % 3 + (half + 2) % 3

    def opposite(self, half: IntArray) -> IntArray:
        """Corners that face the half-edges in their own faces."""
        return self.end[self.after(half)]

    def around(self, half: IntArray) -> IntArray:
        """The next half-edges that leave the same vertices, counter-clockwise; -1 past a boundary."""
        return self.twin[self.before(half)]

    @cached_property
    def boundary_before(self) -> IntArray:
        """(V,) vertex before each on its boundary loop; -1 inside, and where several loops touch."""
        return self._boundary_neighbours(self.end, self.start)

    @cached_property
    def boundary_after(self) -> IntArray:
        """(V,) vertex after each on its boundary loop; -1 inside, and where several loops touch."""
        return self._boundary_neighbours(self.start, self.end)

    def _boundary_neighbours(self, here: IntArray, there: IntArray) -> IntArray:
        border = self.twin < 0
        found = np.full(self._vertex_count, -1, np.int64)
        found[here[border]] = there[border]
        found[np.bincount(here[border], minlength=self._vertex_count) > 1] = -1
        return found
