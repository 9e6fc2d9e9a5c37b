"""Folds and tears of a retargeted frame, smoothed away where the source has none."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from .arrays import BoolArray, FloatArray, IntArray
from .defects import TORN, Defects
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
_BLOCK = 16
"""Frames that are looked at together."""


class _SourceFrame:
    """What the source does in a frame (Vs, 3), worked out where it is asked for."""

    def __init__(self, defects: Defects, frame: FloatArray) -> None:
        self._defects, self._frame = defects, frame

    @cached_property
    def calm(self) -> BoolArray:
        """(Vt,) see `Defects.calm`."""
        return self._defects.calm(self._frame)

    @cached_property
    def rolled(self) -> BoolArray:
        """(Vt,) see `Defects.turned_at_counterpart`."""
        return self._defects.turned_at_counterpart(self._frame)


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
        self._mean = target.neighbours_mean
        self._rest = target.vertices.astype(np.float32)
        self._faces_at, self._edges_at = (_incidence(part, len(self._rest)) for part in (target.faces, target.edges))
        self._faces_of = _incidence(target.face_edges, len(target.edges))
        self._harmless = self._safe_parting().astype(np.float32) ** 2

    def mend(self, displacements: FloatArray, source: FloatArray) -> FloatArray:
        """Displacements (F, Vt, 3), mended in place, of frames (F, Vs, 3) of the source."""
        for first in range(0, len(displacements), _BLOCK):
            block = displacements[first : first + _BLOCK]
            for moved, frame, edges in zip(block, source[first : first + _BLOCK], self._suspects(block), strict=True):
                if len(edges):
                    self._mend(moved, frame, edges)
        return displacements

    def _suspects(self, displacements: FloatArray) -> list[IntArray]:
        """Edges (n,) of each of the frames (F, Vt, 3) whose ends part far enough for a tear or a turned face."""
        count = len(displacements)
        by_vertex = np.ascontiguousarray(displacements.transpose(1, 0, 2)).reshape(-1, 3 * count)
        i, j = self._target.edges.T
        parted = (np.take(by_vertex, i, axis=0) - np.take(by_vertex, j, axis=0)).reshape(-1, count, 3)
        far = np.einsum("efc,efc->fe", parted, parted) > self._harmless
        return [np.flatnonzero(row) for row in far]

    def _mend(self, moved: FloatArray, frame: FloatArray, edges: IntArray) -> None:
        faces = np.unique(self._faces_of[edges].indices)
        positions = self._rest + moved
        edges = edges[self._defects.stretched(positions, edges)]
        faces = faces[self._defects.turned(positions, faces) & self._sided[faces]]
        if not len(edges) and not len(faces):
            return
        acted = _SourceFrame(self._defects, frame)
        before, now = moved.astype(np.float64), moved.astype(np.float64)
        bad = first = self._bad(now, acted, faces, edges)
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
            bad = self._bad(now, acted, *around)
        self._keep_in_vain(before, now, first, bad)
        moved[:] = now

    def _bad(self, displacement: FloatArray, acted: _SourceFrame, faces: IntArray, edges: IntArray) -> BoolArray:
        """(V,) vertices of those of the faces that are turned, and of those of the edges that are torn."""
        positions = self._target.vertices + displacement
        faces = faces[self._defects.turned(positions, faces) & self._sided[faces]]
        edges = edges[self._defects.stretched(positions, edges)]
        if len(faces):
            faces = faces[~acted.rolled[self._target.faces[faces]].all(axis=1)]
        if len(edges):
            edges = edges[acted.calm[self._target.edges[edges]].all(axis=1)]
        bad = np.zeros(len(positions), bool)
        bad[self._target.faces[faces]] = True
        bad[self._target.edges[edges]] = True
        return bad

    def _safe_parting(self) -> FloatArray:
        """(E,) by how much the ends of an edge may part without tearing it or turning a face beside it.

        Edges (a, b) that change by less than d each leave the normal a x b on its side while 2 d L + d² < |a x b|, with
        L the longest edge of the face.
        """
        mesh = self._target
        longest = mesh.edge_lengths[mesh.face_edges].max(axis=1)
        safe = np.sqrt(longest**2 + 2 * mesh.face_areas) - longest
        parting = (TORN - 1) * mesh.edge_lengths
        sided = np.flatnonzero(self._sided)
        np.minimum.at(parting, mesh.face_edges[sided].ravel(), np.repeat(safe[sided], 3))
        return parting

    def _keep_in_vain(self, before: FloatArray, now: FloatArray, first: BoolArray, left: BoolArray) -> None:
        """Take back, in place, what was done to patches that it moved too far, or mended nothing of.

        first, left : (V,) vertices of what was turned or torn before and after.
        """
        change = np.sqrt(np.square(now - before).sum(axis=1)) / self._edge
        touched = np.flatnonzero(change > 0)
        if not len(touched):
            return
        count, patch = connected_components(self._target.graph[touched][:, touched], directed=False)
        farthest = np.zeros(count)
        np.maximum.at(farthest, patch, change[touched])
        faults = [np.bincount(patch, bad[touched], count) for bad in (first, left)]
        back = touched[((farthest > MOST_CHANGE) | (faults[1] >= faults[0]))[patch]]
        now[back] = before[back]


def _incidence(members: IntArray, count: int) -> sp.csr_matrix:
    """(count, N) which of N faces or edges (N, k) each vertex belongs to."""
    rows = np.repeat(np.arange(len(members)), members.shape[1])
    return sp.csr_matrix((np.ones(members.size, bool), (members.ravel(), rows)), shape=(count, len(members)))
