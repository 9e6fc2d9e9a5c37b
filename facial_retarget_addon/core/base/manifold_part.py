"""The best manifold piece of a set of triangles."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from ..arrays import FloatArray, IntArray
from ..mesh import TriMesh


def manifold_part(faces: IntArray, cost: FloatArray, vertex_count: int) -> IntArray:
    """Triangles that form one oriented manifold piece, the cheapest where several exclude each other.

    Parameters
    ----------
    faces : (F, 3), possibly doubled, crowded at edges or touching at single vertices.
    cost : (F,) what to avoid.

    Returns
    -------
    (F', 3) some of them: no directed edge twice, one fan at every vertex, in one piece.
    """
    faces = faces[np.argsort(cost, kind="stable")]
    used: set[tuple[int, int]] = set()
    kept = []
    for k, (a, b, c) in enumerate(faces.tolist()):
        edges = {(a, b), (b, c), (c, a)}
        if not edges & used:
            used |= edges
            kept.append(k)
    faces = faces[kept]
    while True:
        thinned = _largest_piece(_single_fans(faces, vertex_count), vertex_count)
        if len(thinned) == len(faces):
            return faces
        faces = thinned


def _single_fans(faces: IntArray, vertex_count: int) -> IntArray:
    """Where several fans meet at a vertex, only the largest one."""
    drop: set[int] = set()
    mesh = TriMesh(np.zeros((vertex_count, 3)), faces)
    starts = np.bincount(mesh.boundary_edges[:, 0], minlength=vertex_count)
    fans = np.bincount(mesh.faces.ravel(), minlength=vertex_count)
    for vertex in np.flatnonzero((starts > 1) | ((starts == 1) & (fans > 1))).tolist():
        around = np.flatnonzero((faces == vertex).any(axis=1))
        label = _pieces(faces[around], vertex_count, vertex)
        keep = np.bincount(label).argmax()
        drop |= set(around[label != keep].tolist())
    return np.delete(faces, sorted(drop), axis=0)


def _largest_piece(faces: IntArray, vertex_count: int) -> IntArray:
    label = _pieces(faces, vertex_count)
    largest: IntArray = faces[label == np.bincount(label).argmax()]
    return largest


def _pieces(faces: IntArray, vertex_count: int, through: int | None = None) -> IntArray:
    """(F,) label of the pieces that hang together by edges, or by the edges at one vertex."""
    mesh = TriMesh(np.zeros((vertex_count, 3)), faces)
    joins = mesh.face_edges.ravel()
    owner = np.repeat(np.arange(len(faces)), 3)
    if through is not None:
        at = (mesh.edges[joins] == through).any(axis=1)
        joins, owner = joins[at], owner[at]
    incidence = sp.csr_matrix((np.ones(len(joins)), (owner, joins)), shape=(len(faces), len(mesh.edges)))
    labels: IntArray = connected_components(incidence @ incidence.T, directed=False)[1].astype(np.int64)
    return labels
