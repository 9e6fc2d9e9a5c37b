"""Values spread over a surface from where they are known."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import splu

from ..arrays import BoolArray, FloatArray
from ..mesh import TriMesh

_BLOCK = 64


class HarmonicFill:
    """Spreads values from known vertices over the others, harmonically: short edges tie their ends together.

    The unknown values x solve sum_j (x_i - x_j) / l_ij + decay_i x_i = 0 with l the edge lengths. Vertices that no
    known one reaches get zero.
    """

    def __init__(self, mesh: TriMesh, known: BoolArray, decay: FloatArray) -> None:
        """Factor the system.

        Parameters
        ----------
        known : (V,) vertices whose values are kept.
        decay : (V,) pull of the unknown values to zero, per unit of length; 0 for none.
        """
        self._known = np.asarray(known, bool)
        graph = mesh.graph.copy()
        graph.data = 1 / np.maximum(graph.data, 1e-3 * mesh.edge_lengths.mean())
        # What no known vertex reaches stays out of the system.
        unknown = sp.diags((~self._known).astype(float))
        labels = connected_components(unknown @ graph @ unknown, directed=False)[1]
        touched = np.zeros(len(known), bool)
        touched[labels[~self._known & (graph @ self._known.astype(float) > 0)]] = True
        self._free = np.flatnonzero(~self._known & touched[labels])
        self._pieces = np.unique(labels[self._free], return_inverse=True)[1]
        between = graph[self._free]
        self._rim = np.flatnonzero(self._known & (between.T @ np.ones(len(self._free)) > 0))
        self._between = between[:, self._rim].tocsr()
        if len(self._free):
            degree = np.asarray(between.sum(axis=1)).ravel() + decay[self._free]
            # The matrix is symmetric and dominated by its diagonal: no pivoting is needed.
            self._solver = splu(
                (sp.diags(degree) - between[:, self._free]).tocsc(),
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )

    def values(self, values: FloatArray) -> FloatArray:
        """Values (V, C) with the unknown ones filled."""
        filled = np.where(self._known[:, None], values, 0.0)
        if len(self._free):
            filled[self._free] = self._solver.solve(self._between @ values[self._rim])
        return filled

    def matrix(self, cut: float = 0.01) -> sp.csr_matrix:
        """(V, V) matrix that does the same, its rows without weights below `cut` of their greatest."""
        keep = np.flatnonzero(self._known)
        rows, columns, weights = [keep], [keep], [np.ones(len(keep))]
        if len(self._free):
            row, rim, weight = self._weights(cut)
            rows.append(self._free[row])
            columns.append(self._rim[rim])
            weights.append(weight)
        entries = (np.concatenate(weights), (np.concatenate(rows), np.concatenate(columns)))
        return sp.csr_matrix(entries, shape=(len(self._known),) * 2)

    def _weights(self, cut: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        # Pieces of unknown vertices do not touch: the k-th rim vertices of all of them share one right side.
        entry = self._between.tocoo()
        piece = self._pieces[entry.row]
        pair, pair_of = np.unique(piece * len(self._rim) + entry.col, return_inverse=True)
        pair_piece, pair_rim = pair // len(self._rim), pair % len(self._rim)
        first = np.searchsorted(pair_piece, np.arange(self._pieces.max() + 1))
        turn = np.arange(len(pair)) - first[pair_piece]
        right = sp.csc_matrix((entry.data, (entry.row, turn[pair_of])), shape=(len(self._free), int(turn.max()) + 1))
        size = np.bincount(pair_piece)[self._pieces]
        found = []
        greatest = np.zeros(len(self._free))
        for start in range(0, right.shape[1], _BLOCK):
            active = np.flatnonzero(size > start)
            solved = self._solver.solve(right[:, start : start + _BLOCK].toarray())[active]
            solved[np.arange(start, start + solved.shape[1]) >= size[active, None]] = 0.0
            greatest[active] = np.maximum(greatest[active], solved.max(axis=1))
            row, column = np.nonzero(solved >= cut * greatest[active, None])
            positive = solved[row, column] > 0
            row, column = row[positive], column[positive]
            found.append((active[row], column + start, solved[row, column]))
        row, column, weight = (np.concatenate(part) for part in zip(*found, strict=True))
        large = weight >= cut * greatest[row]
        row, column, weight = row[large], column[large], weight[large]
        whole = self._solver.solve(np.asarray(self._between.sum(axis=1)).ravel())
        weight *= (whole / np.maximum(np.bincount(row, weight, len(self._free)), 1e-300))[row]
        return row, pair_rim[first[self._pieces[row]] + column], weight
