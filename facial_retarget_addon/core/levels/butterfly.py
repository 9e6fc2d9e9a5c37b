"""Modified butterfly subdivision as sparse matrices: old vertices stay, new ones come from up to ten around an edge."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray, IntArray
from .half_edges import HalfEdges
from .subdivision import Level, connectivity, split_faces


def butterfly(faces: IntArray, vertex_count: int) -> Level:
    """One step of the modified butterfly scheme, with tension 0.

    Old vertices stay. A new vertex on an edge between regular vertices has 1/2 of the ends, 1/8 of the opposite
    corners and -1/16 of the four corners beyond; on the edge of an interior vertex whose valence is not 6 it has 3/4
    of that one and `extraordinary_weights` of its ring, on an edge between two of them the mean of both; on a
    boundary edge 9/16 of the ends and -1/16 of the boundary vertices before and after.

    What is missing beyond a boundary is a reflection: p + q - o beyond the edge p q of a face with third corner o,
    and 2 a - b past the end a of an edge a b where the boundary does not go on.

    Parameters
    ----------
    faces : (F, 3), edge-manifold and oriented.
    vertex_count : number of coarse vertices V.

    Raises
    ------
    RetargetError : if an edge has more than two faces, or faces of both orientations meet.

    References
    ----------
    Dyn, Levin and Gregory 1990; Zorin, Schroeder and Sweldens 1996; reflections at corners are ours.
    """
    mesh = connectivity(faces, vertex_count)
    half = HalfEdges(mesh)
    on_boundary: BoolArray = mesh.edge_face_count == 1
    valence = np.bincount(mesh.edges.ravel(), minlength=vertex_count)
    special = (valence != 6) & ~mesh.boundary_vertices
    rule = special[mesh.edges].sum(axis=1)
    weights = _Weights(len(mesh.edges), vertex_count)
    one_each = _one_of_each_edge(half, len(mesh.edges))
    _boundary_edges(weights, half, one_each[on_boundary])
    _regular_edges(weights, half, one_each[~on_boundary & (rule == 0)])
    leaving = special[half.start] & ~on_boundary[half.edge]
    _extraordinary_edges(weights, half, np.flatnonzero(leaving), valence, rule)
    matrix = sp.vstack([sp.eye(vertex_count), weights.matrix()]).tocsr()
    matrix.eliminate_zeros()
    matrix.sort_indices()
    return Level(matrix, split_faces(faces, mesh.face_edges, vertex_count), mesh.edges, on_boundary)


def extraordinary_weights(valence: int) -> FloatArray:
    """(K,) weights of the ring of an interior vertex of valence K other than 6, the edge's other end first; sum 1/4."""
    if valence == 3:
        return np.array([5.0, -1.0, -1.0]) / 12
    if valence == 4:
        return np.array([3.0, 0.0, -1.0, 0.0]) / 8
    angle = 2 * np.pi * np.arange(valence) / valence
    return (0.25 + np.cos(angle) + 0.5 * np.cos(2 * angle)) / valence


class _Weights:
    """Collects (edge, vertex, weight)."""

    def __init__(self, edge_count: int, vertex_count: int) -> None:
        self._shape = edge_count, vertex_count
        self._rows: list[IntArray] = []
        self._columns: list[IntArray] = []
        self._values: list[FloatArray] = []

    def add(self, edge: IntArray, vertex: IntArray, weight: float | FloatArray) -> None:
        self._rows.append(edge)
        self._columns.append(vertex)
        self._values.append(np.broadcast_to(weight, edge.shape))

    def matrix(self) -> sp.coo_matrix:
        """(E, V)."""
        places = np.concatenate(self._rows), np.concatenate(self._columns)
        return sp.coo_matrix((np.concatenate(self._values), places), shape=self._shape)


def _one_of_each_edge(half: HalfEdges, edge_count: int) -> IntArray:
    """(E,) one half-edge of each edge."""
    found = np.empty(edge_count, np.int64)
    found[half.edge] = np.arange(len(half.edge))
    return found


def _boundary_edges(weights: _Weights, half: HalfEdges, some: IntArray) -> None:
    edge, a, b = half.edge[some], half.start[some], half.end[some]
    for end, other, beyond in ((a, b, half.boundary_before[a]), (b, a, half.boundary_after[b])):
        goes_on = beyond >= 0
        weights.add(edge, end, 9 / 16)
        weights.add(edge[goes_on], beyond[goes_on], -1 / 16)
        weights.add(edge[~goes_on], end[~goes_on], -2 / 16)
        weights.add(edge[~goes_on], other[~goes_on], 1 / 16)


def _regular_edges(weights: _Weights, half: HalfEdges, some: IntArray) -> None:
    for side in (some, half.twin[some]):
        edge = half.edge[side]
        weights.add(edge, half.start[side], 1 / 2)
        weights.add(edge, half.opposite(side), 1 / 8)
        for wing in (half.after(side), half.before(side)):
            over = half.twin[wing]
            there = over >= 0
            weights.add(edge[there], half.opposite(over[there]), -1 / 16)
            lost, own = wing[~there], edge[~there]
            weights.add(own, half.start[lost], -1 / 16)
            weights.add(own, half.end[lost], -1 / 16)
            weights.add(own, half.opposite(lost), 1 / 16)


def _extraordinary_edges(
    weights: _Weights, half: HalfEdges, leaving: IntArray, valence: IntArray, rule: IntArray
) -> None:
    """Edges with extraordinary ends; leaving : half-edges that leave one; rule : (E,) how many such ends."""
    for size in np.unique(valence[half.start[leaving]]):
        some = leaving[valence[half.start[leaving]] == size]
        edge = half.edge[some]
        share = 1 / rule[edge]
        weights.add(edge, half.start[some], 0.75 * share)
        spoke = some
        for weight in extraordinary_weights(int(size)):
            weights.add(edge, half.end[spoke], weight * share)
            spoke = half.around(spoke)
