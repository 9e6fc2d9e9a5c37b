"""Folds and tears of a retargeted frame, smoothed away where the source has none."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from .arrays import BoolArray, FloatArray, IntArray
from .defects import Defects
from .mesh import TriMesh

ROUNDS = 12
SWEEPS = 3
"""Rounds of smoothing, and how often each takes the mean with the neighbours' motion."""
GROWS = 3
"""Rounds after which the smoothed patches grow by a ring of vertices ..."""
MOST_RINGS = 3
"""... up to so many."""
MOST_CHANGE = 2.0
"""A patch that would have to move by more edges than this is left as it was: it is no mere fold."""
FLAT = 1e-6
"""Faces of less area than this, as a share of the mean one's, have no side to be turned over from."""


class Unfolding:
    """Mends frames of one pair of faces.

    Vertices of turned faces and torn edges take the mean of their neighbours' motion, until nothing is turned or torn
    any more. A face that is turned because the source's own faces are there, as in rolled lips, is left.

    Parameters
    ----------
    source, target : neutral faces.
    counterpart : (Vt,) the source vertex nearest to each target vertex's counterpart, -1 for none.
    """

    def __init__(self, source: TriMesh, target: TriMesh, counterpart: IntArray) -> None:
        self._target = target
        self._defects = Defects(source, target, counterpart)
        self._edge = np.maximum(target.vertex_edge_length, 1e-12 * max(target.size, 1e-300))
        self._sided = target.face_areas > FLAT * target.face_areas.mean()
        graph = target.graph.copy()
        graph.data = 1 / np.maximum(graph.data, 1e-3 * target.edge_lengths.mean())
        self._mean = (sp.diags(1 / np.maximum(np.asarray(graph.sum(axis=1)).ravel(), 1e-300)) @ graph).tocsr()
        self._rest = target.vertices.astype(np.float32)
        self._faces_at, self._edges_at = (
            _incidence(part, len(graph.indptr) - 1) for part in (target.faces, target.edges)
        )

    def mend(self, displacements: FloatArray, source: FloatArray) -> FloatArray:
        """Displacements (F, Vt, 3), mended in place, of frames (F, Vs, 3) of the source."""
        for moved, frame in zip(displacements, source, strict=True):
            positions = self._rest + moved
            turned, stretched = self._defects.turned(positions) & self._sided, self._defects.stretched(positions)
            if turned.any() or stretched.any():
                self._mend(moved, frame, np.flatnonzero(turned), np.flatnonzero(stretched))
        return displacements

    def _mend(self, moved: FloatArray, frame: FloatArray, turned: IntArray, stretched: IntArray) -> None:
        calm, rolled = self._defects.calm(frame), self._defects.turned_at_counterpart(frame)
        before, now = moved.astype(np.float64), moved.astype(np.float64)
        bad = self._bad(now, calm, rolled, turned, stretched)
        for done in range(ROUNDS):
            if not bad.any():
                break
            patch = bad
            for _ in range(min(done // GROWS, MOST_RINGS)):
                patch = patch | (self._mean @ patch.astype(float) > 0)
            rows = np.flatnonzero(patch)
            mean = self._mean[rows]
            for _ in range(SWEEPS):
                now[rows] = 0.5 * (now[rows] + mean @ now)
            around = (np.unique(incidence[rows].indices) for incidence in (self._faces_at, self._edges_at))
            bad = self._bad(now, calm, rolled, *around)
        self._keep_far(before, now)
        moved[:] = now

    def _bad(
        self, displacement: FloatArray, calm: BoolArray, rolled: BoolArray, faces: IntArray, edges: IntArray
    ) -> BoolArray:
        """(V,) vertices of those of the faces that are turned, and of those of the edges that are torn."""
        positions = self._target.vertices + displacement
        upright = self._sided[faces] & ~rolled[self._target.faces[faces]].all(axis=1)
        bad = np.zeros(len(positions), bool)
        bad[self._target.faces[faces[self._defects.turned(positions, faces) & upright]]] = True
        bad[self._target.edges[edges[self._defects.torn(positions, calm, edges)]]] = True
        return bad

    def _keep_far(self, before: FloatArray, now: FloatArray) -> None:
        """Take back, in place, what was done to patches that it moved too far."""
        change = np.sqrt(np.square(now - before).sum(axis=1)) / self._edge
        touched = np.flatnonzero(change > 0)
        if not len(touched):
            return
        count, patch = connected_components(self._target.graph[touched][:, touched], directed=False)
        farthest = np.zeros(count)
        np.maximum.at(farthest, patch, change[touched])
        back = touched[(farthest > MOST_CHANGE)[patch]]
        now[back] = before[back]


def _incidence(members: IntArray, count: int) -> sp.csr_matrix:
    """(count, N) which of N faces or edges (N, k) each vertex belongs to."""
    rows = np.repeat(np.arange(len(members)), members.shape[1])
    return sp.csr_matrix((np.ones(members.size, bool), (members.ravel(), rows)), shape=(count, len(members)))
