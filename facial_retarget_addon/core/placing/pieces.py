"""The pieces of a head: skin, eyes, teeth, hair. Vertices in one place hold together, welded or not."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from ..arrays import IntArray
from ..mesh import TriMesh

SAME = 1e-6
"""Vertices nearer to one another than about this share of the mesh's size lie in one place."""


def pieces_of(mesh: TriMesh) -> IntArray:
    """(V,) label of the piece of each vertex: files often bring a skin in parts, cut along the seams of its UVs."""
    grid = np.round((mesh.vertices - mesh.vertices.min(axis=0)) / (SAME * mesh.size)).astype(np.int64)
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
