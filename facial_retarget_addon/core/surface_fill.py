"""Values spread over a surface from where they are known."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import SuperLU, splu

from .arrays import BoolArray
from .mesh import TriMesh

_BLOCK = 256


def harmonic_fill(mesh: TriMesh, known: BoolArray, active: BoolArray, cut: float = 0.01) -> sp.csr_matrix:
    """Matrix that keeps known values and spreads them harmonically over the other active vertices.

    Parameters
    ----------
    known : (V,) vertices whose values are kept.
    active : (V,) vertices that get a value; the others, and pieces without a known vertex, get zero.
    cut : weights below this share of a row's greatest are dropped, so that rows stay short.

    Returns
    -------
    (V, V) matrix whose rows add up to 1 or 0.
    """
    count = len(mesh.vertices)
    known = known & active
    graph = mesh.graph.copy()
    graph.data = mesh.edge_lengths.mean() / np.maximum(graph.data, 1e-3 * mesh.edge_lengths.mean())
    free = np.flatnonzero(active & ~known)
    rim = np.flatnonzero(known & (graph @ (active & ~known).astype(float) > 0))
    keep = np.flatnonzero(known)
    rows, columns, values = [keep], [keep], [np.ones(len(keep))]
    if len(free) and len(rim):
        between = graph[free][:, rim]
        inside = graph[free][:, free]
        degree = np.asarray(graph[free].sum(axis=1)).ravel()
        # A trace of the identity keeps pieces without a known vertex solvable; their rows come out zero.
        system = sp.diags(degree * (1 + 1e-9) + 1e-9 * degree.mean()) - inside
        symmetric = {"SymmetricMode": True}
        solver = splu(system.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=symmetric)
        weights = _solve_sparse(solver, between, cut)
        rows.append(free[weights.row])
        columns.append(rim[weights.col])
        values.append(weights.data)
    shape = (count, count)
    return sp.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=shape)


def _solve_sparse(solver: SuperLU, right: sp.csr_matrix, cut: float) -> sp.coo_matrix:
    """Solution (U, R) of the system for sparse right sides, its small weights dropped, rows adding up to 1 or 0."""
    blocks = []
    for start in range(0, right.shape[1], _BLOCK):
        block = solver.solve(right[:, start : start + _BLOCK].toarray())
        blocks.append(sp.csr_matrix(np.where(block > 1e-6, block, 0.0)))
    solution = sp.hstack(blocks).tocsr()
    greatest = solution.max(axis=1).toarray().ravel()
    entries = solution.tocoo()
    large = entries.data >= cut * greatest[entries.row]
    row, column, value = entries.row[large], entries.col[large], entries.data[large]
    total = np.bincount(row, value, minlength=right.shape[0])
    return sp.coo_matrix((value / total[row], (row, column)), shape=right.shape)
