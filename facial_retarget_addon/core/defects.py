"""Torn edges and turned triangles of a retargeted frame: those that the source's frame does not have."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import scipy.sparse as sp

from .arrays import BoolArray, FloatArray, IntArray, cross
from .mesh import TriMesh

TORN = 3.0
"""An edge is torn where it is stretched beyond this many times its neutral length ..."""
CALM = 1.5
"""... while no source edge around its counterpart is stretched beyond this."""

Rows = IntArray | slice
EVERY = slice(None)


class Defects:
    """Finds the defects of frames of one pair of faces.

    Parameters
    ----------
    source, target : neutral faces.
    counterpart : (Vt,) the source vertex nearest to each target vertex's counterpart, -1 for none.
    """

    def __init__(self, source: TriMesh, target: TriMesh, counterpart: IntArray) -> None:
        self._source, self._target, self._counterpart = source, target, counterpart
        self._face_vectors = target.face_vectors.astype(np.float32)
        self._source_face_vectors = source.face_vectors.astype(np.float32)

    def calm(self, source: FloatArray) -> BoolArray:
        """(Vt,) whether no edge at the counterpart is stretched in a frame (Vs, 3); false where there is none."""
        tight = np.ones(len(self._source.vertices) + 1, bool)
        tight[self._source.edges[edge_stretch(self._source, source) > CALM].ravel()] = False
        tight[-1] = False
        calm: BoolArray = tight[self._counterpart]
        return calm

    def turned_at_counterpart(self, source: FloatArray) -> BoolArray:
        """(Vt,) whether a face at the counterpart is turned over in a frame (Vs, 3) of the source."""
        turned = np.zeros(len(self._source.vertices) + 1, bool)
        turned[self._source.faces[turned_faces(self._source.faces, source, self._source_face_vectors)]] = True
        at_counterpart: BoolArray = turned[self._counterpart]
        return at_counterpart

    def calm_at(self, source: FloatArray, vertices: IntArray) -> BoolArray:
        """(n,) the same as `calm` for some of the target's vertices (n,)."""
        there, place = np.unique(self._counterpart[vertices], return_inverse=True)
        calm = there >= 0
        held, row = _members(self._edges_at, there[calm])
        calm[np.flatnonzero(calm)[row[edge_stretch(self._source, source, held) > CALM]]] = False
        at_vertices: BoolArray = calm[place]
        return at_vertices

    def turned_at(self, source: FloatArray, vertices: IntArray) -> BoolArray:
        """(n,) the same as `turned_at_counterpart` for some of the target's vertices (n,)."""
        there, place = np.unique(self._counterpart[vertices], return_inverse=True)
        known = np.flatnonzero(there >= 0)
        held, row = _members(self._faces_at, there[known])
        turned = np.zeros(len(there), bool)
        turned[known[row[turned_faces(self._source.faces[held], source, self._source_face_vectors[held])]]] = True
        at_vertices: BoolArray = turned[place]
        return at_vertices

    @cached_property
    def _edges_at(self) -> sp.csr_matrix:
        return incidence(self._source.edges, len(self._source.vertices))

    @cached_property
    def _faces_at(self) -> sp.csr_matrix:
        return incidence(self._source.faces, len(self._source.vertices))

    def torn(self, target: FloatArray, calm: BoolArray) -> BoolArray:
        """(E,) torn edges of a frame (Vt, 3)."""
        torn: BoolArray = self.stretched(target) & calm[self._target.edges].all(axis=1)
        return torn

    def stretched(self, target: FloatArray, rows: Rows = EVERY) -> BoolArray:
        """(E,) edges of a frame (Vt, 3) that are torn if the source's are calm there; rows : the edges to look at."""
        return edge_stretch(self._target, target, rows) > TORN

    def turned(self, target: FloatArray, rows: Rows = EVERY) -> BoolArray:
        """(F,) faces of a frame (Vt, 3) that are turned over; rows : the faces to look at."""
        return turned_faces(self._target.faces[rows], target, self._face_vectors[rows])


def edge_stretch(mesh: TriMesh, positions: FloatArray, rows: Rows = EVERY) -> FloatArray:
    """(E,) edge lengths over their neutral lengths; 1 for an edge without length; rows : the edges to look at."""
    i, j = mesh.edges[rows].T
    gap = positions[i] - positions[j]
    length = np.sqrt(np.einsum("ij,ij->i", gap, gap))
    neutral = mesh.edge_lengths[rows]
    return np.divide(length, neutral, out=np.ones(len(length)), where=neutral > 1e-9 * mesh.size)


def turned_faces(faces: IntArray, positions: FloatArray, neutral: FloatArray) -> BoolArray:
    """(F,) faces (F, 3) whose normal at positions (V, 3) points away from their neutral one (F, 3)."""
    a, b, c = (positions[faces[:, k]] for k in range(3))
    turned: BoolArray = np.einsum("fi,fi->f", cross(b - a, c - a), neutral) < 0
    return turned


def incidence(members: IntArray, count: int) -> sp.csr_matrix:
    """(count, N) which of N faces or edges (N, k) each vertex belongs to."""
    rows = np.repeat(np.arange(len(members)), members.shape[1])
    return sp.csr_matrix((np.ones(members.size, bool), (members.ravel(), rows)), shape=(count, len(members)))


def _members(incident: sp.csr_matrix, vertices: IntArray) -> tuple[IntArray, IntArray]:
    """What each of some vertices (n,) belongs to, one after the other, and the row of each in `vertices`."""
    held = incident[vertices]
    return held.indices, np.repeat(np.arange(len(vertices)), np.diff(held.indptr))
