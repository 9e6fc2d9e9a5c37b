"""Lashes of the source turn by themselves: the target's turn as much."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, IntArray
from .follow import Following, following_of
from .known_head import KnownHead
from .riding import Riding, Tips, ride

STATIONS = 3
"""Places along a lid at which its lashes turn by angles of their own; between them by what lies between."""
UPRIGHT = 1e-3
"""Of the least squares: how little lashes turn that hardly show it, as a share of what the mean lash shows."""


@dataclass(frozen=True, eq=False)
class LashTurns:
    """Turns of the source's lashes beyond those that their roots make, and what they do to the target's; linear.

    Attributes
    ----------
    rest : (Vs, 3) the source's neutral, in float32.
    axes : (3, 3) of the source's head and of the target's.
    carriers : (m,) vertices of the source. reads : (T, 3m) their displacements to turns in radians.
    riders : (n,) vertices of the target. turns : (3n, T) what the turns do to them.
    """

    rest: FloatArray
    axes: tuple[FloatArray, FloatArray]
    carriers: IntArray
    reads: FloatArray
    riders: IntArray
    turns: sp.csr_matrix

    def add_to(self, displacements: FloatArray, frames: FloatArray) -> FloatArray:
        """Target displacements (F, Vt, 3) with this added, in place, for source frames (F, Vs, 3)."""
        moved = (frames[:, self.carriers].astype(np.float32) - self.rest[self.carriers]) @ self.axes[0].T
        there = self.turns @ (self.reads @ moved.reshape(len(moved), -1).T)
        displacements[:, self.riders] += there.T.reshape(len(moved), -1, 3) @ self.axes[1]
        return displacements


def fit_lash_turns(source: KnownHead, target: KnownHead, riding: Riding) -> LashTurns | None:
    """Let the target's lashes turn as the source's do; None where one of the heads has none.

    Parameters
    ----------
    riding : what rides on the target's skin.
    """
    ours = ride(source, source.parts)
    theirs = {tips.side: tips for tips in riding.tips if len(tips.vertices)}
    eyes = [(tips, theirs[tips.side]) for tips in ours.tips if tips.side in theirs and len(tips.vertices)]
    if not eyes:
        return None
    beyond = _beyond(source, ours)
    reads = np.concatenate([_read(tips, beyond) for tips, _ in eyes])
    turns = sp.block_diag([_leverage(tips) for _, tips in eyes], format="csr")
    return LashTurns(
        source.mesh.vertices.astype(np.float32),
        (source.axes.astype(np.float32), target.axes.astype(np.float32)),
        beyond.carriers,
        reads.astype(np.float32),
        np.concatenate([tips.vertices for _, tips in eyes]),
        turns.astype(np.float32),
    )


def _beyond(head: KnownHead, riding: Riding) -> Following:
    """Displacements of what rides, less those of its roots and the turns that these make."""
    count = len(head.mesh.vertices)
    return following_of(sp.kron(sp.identity(count) - riding.spread, sp.identity(3)) - riding.turns, head.axes)


def _leverage(tips: Tips) -> sp.csr_matrix:
    """(3n, 6 * STATIONS) what turns of the upper and of the lower lid's lashes do to them."""
    x, y, z = tips.lever.T
    nothing = np.zeros_like(x)
    # w x u is linear in w.
    crossed = np.stack([nothing, z, -y, -z, nothing, x, y, -x, nothing], axis=1).reshape(-1, 3, 3)
    near = np.clip(1 - np.abs(tips.along[:, None] * (STATIONS - 1) - np.arange(STATIONS)), 0, 1)
    lids = np.stack([np.maximum(tips.lid, 0) ** 2, np.minimum(tips.lid, 0) ** 2], axis=1)
    shares = (lids[:, :, None] * near[:, None, :]).reshape(len(x), -1)
    return sp.csr_matrix(np.einsum("nij,ns->nisj", crossed, shares).reshape(3 * len(x), -1))


def _read(tips: Tips, beyond: Following) -> FloatArray:
    """(6 * STATIONS, 3m) what the carriers' displacements show of the turns, in least squares."""
    turns = _leverage(tips)
    square = (turns.T @ turns).toarray()
    shown = np.trace(square) / len(square)
    rows = (3 * np.searchsorted(beyond.riders, tips.vertices)[:, None] + np.arange(3)).ravel()
    right = (turns.T @ beyond.matrix[rows]).toarray()
    solved: FloatArray = np.linalg.solve(square + UPRIGHT * shown * np.eye(len(square)), right)
    return solved
