"""Shortest paths on a surface between two places."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import dijkstra

from .arrays import FloatArray, IntArray
from .closest_point import Nearest, SurfaceFinder
from .geodesic import shortcut_graph
from .mesh import TriMesh

_ROUNDS = 8
_SAMPLES = 48
_REACH = 4.0
"""The search ends this many times the straight distance away."""


class SurfacePaths:
    """Finds smooth, continuous paths on one mesh."""

    def __init__(self, mesh: TriMesh) -> None:
        self._mesh = mesh

    @cached_property
    def _graph(self) -> sp.csr_matrix:
        return shortcut_graph(self._mesh)

    def path(self, start: Nearest, stop: Nearest) -> tuple[FloatArray, SurfaceFinder]:
        """Path between two single places.

        The shortest path along the graph, smoothed within the strip of faces around it.

        Returns
        -------
        Polyline (s, 3) on the surface, and a finder for the strip. Where there is no path within reach: the straight
        line moved to the faces of the two places.
        """
        first, last = self._mesh.faces[start.face[0]], self._mesh.faces[stop.face[0]]
        vertices = self._vertices(first, last, start.point[0], stop.point[0])
        marked = np.zeros(len(self._mesh.vertices), bool)
        marked[np.concatenate([vertices, first, last])] = True
        strip = SurfaceFinder(self._mesh, np.flatnonzero(marked[self._mesh.faces].any(axis=1)))
        line = np.concatenate([start.point, self._mesh.vertices[vertices], stop.point])
        line = resample(line, np.linspace(0, 1, _SAMPLES))
        for _ in range(_ROUNDS):
            line[1:-1] = 0.25 * line[:-2] + 0.5 * line[1:-1] + 0.25 * line[2:]
            line[1:-1] = strip.closest(line[1:-1]).point
        return line, strip

    def _vertices(self, first: IntArray, last: IntArray, start: FloatArray, stop: FloatArray) -> IntArray:
        """Vertices of the shortest path from one face to another; none if it is out of reach."""
        reach = _REACH * float(np.linalg.norm(stop - start)) + 2 * float(self._mesh.edge_lengths.mean())
        distance, before, _ = dijkstra(
            self._graph, directed=False, indices=first, min_only=True, return_predecessors=True, limit=reach
        )
        rest = np.linalg.norm(self._mesh.vertices[last] - stop, axis=1)
        end = int(last[np.argmin(distance[last] + rest)])
        if not np.isfinite(distance[end]):
            return np.empty(0, np.int64)
        path = [end]
        while before[path[-1]] >= 0:
            path.append(int(before[path[-1]]))
        return np.array(path[::-1], np.int64)


def line_length(line: FloatArray) -> float:
    """Length of a polyline (s, 3)."""
    return float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())


def resample(line: FloatArray, shares: FloatArray) -> FloatArray:
    """Points (m, 3) of a polyline (s, 3) at shares (m,) of its length."""
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    wanted = shares * length[-1]
    return np.stack([np.interp(wanted, length, line[:, c]) for c in range(3)], axis=1)
