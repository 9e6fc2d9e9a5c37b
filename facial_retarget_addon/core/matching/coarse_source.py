"""Motion of a source that is coarser than the target: smooth over its vertices instead of kinked at its edges."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray
from ..mesh import TriMesh

WIDTH = 3.0
"""How far the smoothing reaches, in edges of a source that is much coarser than the target."""
KINKS = 12
"""Steps along the target, at most, that round off what is left of the source's edges."""
STEP = 0.5
"""Share of the neighbours' mean in one step: half of it damps at once what changes from vertex to vertex."""
LEAST = 0.02
"""Edges whose squares differ by less, as a share, are alike."""


def smooth_coarse_source(
    matrix: sp.csr_matrix, source: TriMesh, target: TriMesh, scale: float
) -> tuple[sp.csr_matrix | None, sp.csr_matrix]:
    """How a carry (Vt, Vs) smooths what a source does that is coarser than the target.

    Barycentric weights put a kink at every edge of the source. On a finer target that shows as facets, and tears where
    large triangles of the source bridge two lips; and what one artist's coarse mesh does from vertex to vertex says
    little about another face. With r the source's edge over the target's, a vertex of the source takes
    WIDTH² (1 - 1/r²) steps and one of the target r² - 1, up to KINKS; none where the source is as fine.

    Parameters
    ----------
    scale : target units for one unit of the source.

    Returns
    -------
    (Vs, Vs) what smooths the source's displacements, None for nothing, and the carry (Vt, Vs) that takes them on. The
    product of both has many times as many entries.
    """
    ours, theirs = scale * source.vertex_edge_length, target.vertex_edge_length
    coarser = _coarser(ours, _carried(matrix.T.tocsr(), theirs))
    if not coarser.any():
        return None, matrix
    finer = _coarser(_carried(matrix, ours), theirs)
    rounds_off = _smoothing(target, np.minimum(finer / np.maximum(1 - finer, 1e-9), KINKS))
    return _smoothing(source, WIDTH**2 * coarser), (rounds_off @ matrix).tocsr()


def _carried(matrix: sp.csr_matrix, values: FloatArray) -> FloatArray:
    """(N,) mean of values (M,) by the weights of each row, 0 for rows without any."""
    total = np.asarray(matrix.sum(axis=1)).ravel()
    mean: FloatArray = np.where(total > 1e-6, (matrix @ values) / np.maximum(total, 1e-6), 0.0)
    return mean


def _coarser(source_edge: FloatArray, target_edge: FloatArray) -> FloatArray:
    """(N,) 1 - 1/r² for the ratio r of two edges, 0 where one is unknown or the source's is no longer."""
    known = (source_edge > 0) & (target_edge > 0)
    share = 1 - (target_edge / np.where(known, source_edge, 1.0)) ** 2
    coarser: FloatArray = np.where(known & (share > LEAST), share, 0.0)
    return coarser


def _smoothing(mesh: TriMesh, steps: FloatArray) -> sp.csr_matrix:
    """(V, V) means with the neighbours, near ones counting more, as many steps (V,) at each vertex."""
    mean = mesh.neighbours_mean
    smoothing = sp.identity(len(mesh.vertices), format="csr")
    left = steps.copy()
    while left.any():
        rows = np.flatnonzero(left)
        share = np.minimum(left[rows], 1.0)
        left[rows] -= share
        to_rows = sp.csr_matrix((STEP * share, (rows, np.arange(len(rows)))), shape=(len(left), len(rows)))
        smoothing = (smoothing + to_rows @ (mean[rows] @ smoothing - smoothing[rows])).tocsr()
    return smoothing
