"""The pieces of a head: skin, eyes, teeth, hair."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from ..arrays import IntArray
from ..mesh import TriMesh

SAME = 1e-6
"""Vertices nearer to one another than about this share of the mesh's size lie in one place."""
TORN = 0.5
"""A mesh is torn if its largest component has less than this share of the area that it has once it is welded."""


def pieces_of(mesh: TriMesh) -> IntArray:
    """(V,) label of the piece of each vertex, from 0 on.

    The components; or, if the skin is torn into parts as files often bring it, cut along the seams of its UVs or into
    single triangles, what holds together once vertices in one place are one.
    """
    apart = mesh.components
    welded = _welded(mesh)
    largest = [np.bincount(labels, mesh.vertex_areas).max() for labels in (apart, welded)]
    return welded if largest[0] < TORN * largest[1] else apart


def _welded(mesh: TriMesh) -> IntArray:
    """(V,) label of the component of each vertex once vertices in one place are one."""
    grid = np.round((mesh.vertices - mesh.vertices.min(axis=0)) / max(SAME * mesh.size, 1e-300)).astype(np.int64)
    place = np.unique(grid, axis=0, return_inverse=True)[1].ravel()
    edges = place[mesh.edges]
    count = int(place.max()) + 1
    links = sp.coo_matrix((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(count, count))
    labels: IntArray = connected_components(links, directed=False)[1].astype(np.int64)[place]
    return labels


def members(labels: IntArray) -> list[IntArray]:
    """The vertices of each piece, in the order of the labels (V,), which are 0, 1, and so on."""
    order = np.argsort(labels, kind="stable")
    return np.split(order, np.cumsum(np.bincount(labels))[:-1])
