"""Folds and tears of a retargeted frame, smoothed away where the source has none."""

from __future__ import annotations

import numpy as np
from scipy.sparse.csgraph import connected_components

from .arrays import FloatArray, IntArray
from .defects import TORN, Defects, incidence
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
        self._faces_at, self._edges_at = (incidence(part, len(self._rest)) for part in (target.faces, target.edges))
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

    def _mend(self, moved: FloatArray, source: FloatArray, edges: IntArray) -> None:
        faces = self._faces_with(edges)
        positions = self._rest + moved
        edges = edges[self._defects.stretched(positions, edges)]
        faces = faces[self._defects.turned(positions, faces) & self._sided[faces]]
        if not len(edges) and not len(faces):
            return
        now = moved.astype(np.float64)
        bad = first = self._bad(now, source, faces, edges)
        touched = np.zeros(len(now), bool)
        for done in range(ROUNDS):
            if not len(bad):
                break
            rows = bad
            for _ in range(min(done // GROWS, MOST_RINGS)):
                rows = np.union1d(rows, self._mean[rows].indices)
            touched[rows] = True
            mean = self._mean[rows]
            for _ in range(SWEEPS):
                now[rows] = 0.5 * (now[rows] + mean @ now)
            around = (np.unique(incident[rows].indices) for incident in (self._faces_at, self._edges_at))
            bad = self._bad(now, source, *around)
        self._keep_in_vain(moved, now, np.flatnonzero(touched), first, bad)

    def _faces_with(self, edges: IntArray) -> IntArray:
        """(n,) faces that have one of the edges."""
        own = np.zeros(len(self._target.edges), bool)
        own[edges] = True
        a, b, c = self._target.face_edges.T
        return np.flatnonzero(own[a] | own[b] | own[c])

    def _bad(self, displacement: FloatArray, source: FloatArray, faces: IntArray, edges: IntArray) -> IntArray:
        """(n,) vertices of those of the faces that are turned, and of those of the edges that are torn."""
        positions = self._target.vertices + displacement
        faces = faces[self._defects.turned(positions, faces) & self._sided[faces]]
        edges = edges[self._defects.stretched(positions, edges)]
        folded, torn = self._target.faces[faces], self._target.edges[edges]
        if len(faces):
            folded = folded[~self._defects.turned_at(source, folded.ravel()).reshape(-1, 3).all(axis=1)]
        if len(edges):
            torn = torn[self._defects.calm_at(source, torn.ravel()).reshape(-1, 2).all(axis=1)]
        return np.union1d(folded, torn)

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

    def _keep_in_vain(
        self, moved: FloatArray, now: FloatArray, touched: IntArray, first: IntArray, left: IntArray
    ) -> None:
        """Take over into displacements (V, 3) what was done to patches, but not where it moved them too far, or mended
        nothing.

        touched : (n,) vertices of the patches.
        first, left : vertices of what was turned or torn before and after.
        """
        change = np.sqrt(np.square(now[touched] - moved[touched]).sum(axis=1)) / self._edge[touched]
        touched, change = touched[change > 0], change[change > 0]
        if not len(touched):
            return
        count, patch = connected_components(self._target.graph[touched][:, touched], directed=False)
        farthest = np.zeros(count)
        np.maximum.at(farthest, patch, change)
        faults = [np.bincount(patch[np.isin(touched, bad)], minlength=count) for bad in (first, left)]
        mended = touched[((farthest <= MOST_CHANGE) & (faults[1] < faults[0]))[patch]]
        moved[mended] = now[mended]
