"""What a vertex's neighbours say about it: means, medians, softened normals, motion spread from a boundary."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from ..arrays import BoolArray, FloatArray, IntArray
from ..mesh import TriMesh


def adjacency(mesh: TriMesh) -> sp.csr_matrix:
    """(V, V) csr: 1 where two vertices share an edge."""
    i, j = np.concatenate([mesh.edges, mesh.edges[:, ::-1]]).T
    return sp.csr_matrix((np.ones(len(i)), (i, j)), shape=(len(mesh.vertices),) * 2)


def incidence(mesh: TriMesh) -> sp.csr_matrix:
    """(V, F) csr: 1 where a face touches a vertex; takes face vectors to vertex normals, not yet of unit length."""
    faces = np.repeat(np.arange(len(mesh.faces)), 3)
    shape = (len(mesh.vertices), len(mesh.faces))
    return sp.csr_matrix((np.ones(mesh.faces.size), (mesh.faces.ravel(), faces)), shape=shape)


def edge_lengths_around(neighbours: sp.csr_matrix, positions: FloatArray) -> FloatArray:
    """(V,) mean length of the edges at each vertex; 0 for a vertex without any."""
    degree = np.diff(neighbours.indptr)
    row = np.repeat(np.arange(len(degree)), degree)
    lengths = np.linalg.norm(positions[row] - positions[neighbours.indices], axis=1)
    mean: FloatArray = np.bincount(row, lengths, len(degree)) / np.maximum(degree, 1)
    return mean


def mean_of_known(neighbours: sp.csr_matrix, unknown: IntArray) -> sp.csr_matrix:
    """Matrix (K, V) that makes K unknown vertices the mean of their neighbours, all at once.

    The means of unknown vertices beside each other are repeated until they rest: a harmonic fill.
    """
    count = neighbours.shape[0]
    if not len(unknown):
        return sp.csr_matrix((0, count))
    rows = neighbours[unknown]
    degree = np.asarray(rows.sum(axis=1)).ravel()
    among = rows[:, unknown]
    is_known = np.ones(count)
    is_known[unknown] = 0.0
    from_known = (rows @ sp.diags(is_known)).tocsr()
    from_known.eliminate_zeros()
    columns = np.unique(from_known.indices)
    # A trace of the degree keeps a patch without a known neighbour solvable; its mean is zero.
    system = sp.diags(degree + 1e-12) - among
    weights = splu(system.tocsc()).solve(from_known[:, columns].toarray())
    row, column = np.nonzero(weights > 1e-9)
    filled = sp.csr_matrix((weights[row, column], (row, columns[column])), shape=(len(unknown), count))
    total = np.asarray(filled.sum(axis=1)).ravel()
    return (sp.diags(1 / np.maximum(total, 1e-300)) @ filled).tocsr()


def neighbour_median(neighbours: sp.csr_matrix, values: FloatArray, known: BoolArray) -> FloatArray:
    """(V,) lower median of the known neighbours' values; nan without any."""
    degree = np.diff(neighbours.indptr)
    slot = np.arange(neighbours.nnz) - np.repeat(neighbours.indptr[:-1], degree)
    table = np.full((len(degree), int(degree.max(initial=1))), np.inf)
    row = np.repeat(np.arange(len(degree)), degree)
    table[row, slot] = np.where(known[neighbours.indices], values[neighbours.indices], np.inf)
    table.sort(axis=1)
    number = np.isfinite(table).sum(axis=1)
    middle = table[np.arange(len(degree)), np.maximum(number - 1, 0) // 2]
    return np.where(number > 0, middle, np.nan)


def pick(vertices: IntArray, count: int) -> sp.csr_matrix:
    """(K, count) matrix that takes K of `count` rows."""
    entries = (np.ones(len(vertices)), (np.arange(len(vertices)), vertices))
    return sp.csr_matrix(entries, shape=(len(vertices), count))


def widen(weights: sp.csr_matrix, neighbours: sp.csr_matrix, rounds: int) -> sp.csr_matrix:
    """Weights of vertices (K, V), spread to their neighbours for some rounds; rows add up to 1."""
    for _ in range(rounds):
        weights = weights + weights @ neighbours
        weights = sp.diags(1 / np.asarray(weights.sum(axis=1)).ravel()) @ weights
    return weights.tocsr()


def spread_inwards(neighbours: sp.csr_matrix, boundary: IntArray, rounds: int) -> sp.csr_matrix:
    """(V, B) matrix that spreads displacements of boundary vertices over some rings inside; zero on the boundary."""
    count = neighbours.shape[0]
    degree = np.maximum(np.asarray(neighbours.sum(axis=1)).ravel(), 1)
    degree[boundary] = np.inf
    mean = sp.diags(1 / degree) @ neighbours
    own = sp.csr_matrix((np.ones(len(boundary)), (boundary, np.arange(len(boundary)))), shape=(count, len(boundary)))
    spread = sp.csr_matrix((count, len(boundary)))
    for _ in range(rounds):
        spread = mean @ (spread + own)
    spread.eliminate_zeros()
    return spread.tocsr()
