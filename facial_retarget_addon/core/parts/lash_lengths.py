"""Lashes keep their lengths: their turns are linear in the skin's motion, and large ones would stretch them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, IntArray
from ..mesh import TriMesh
from .riding import Riding


@dataclass(frozen=True, eq=False)
class LashLengths:
    """Levers of lashes, from what they take of their roots to themselves.

    Attributes
    ----------
    tips : (n,) vertices that hang on the lids. roots : (m,) vertices that they hang on.
    spread : (n, m) float32, how much of each root a tip takes; rows add up to 1.
    lever : (n, 3) float32, in the neutral.
    hold : (n,) float32, how far a tip keeps its length: 1 on one lid, 0 between both.
    """

    tips: IntArray
    roots: IntArray
    spread: sp.csr_matrix
    lever: FloatArray
    hold: FloatArray

    def hold_in(self, displacements: FloatArray) -> FloatArray:
        """Displacements (F, V, 3) of lashes that were moved, with their lengths restored, in place."""
        for frame in displacements:
            at_root = self.spread @ frame[self.roots]
            now = self.lever + frame[self.tips] - at_root
            length = np.linalg.norm(now, axis=1)
            longer = np.divide(length, np.linalg.norm(self.lever, axis=1), out=np.ones_like(length), where=length > 0)
            frame[self.tips] = at_root - self.lever + now * np.power(longer, -self.hold)[:, None]
        return displacements


def fit_lash_lengths(mesh: TriMesh, riding: Riding) -> LashLengths | None:
    """The lengths of all that hangs on the lids; None where nothing does."""
    if not any(len(eye.vertices) for eye in riding.tips):
        return None
    tips = np.concatenate([eye.vertices for eye in riding.tips])
    hold = np.concatenate([eye.lid for eye in riding.tips]) ** 2
    spread = riding.spread[tips]
    lever = mesh.vertices[tips] - spread @ mesh.vertices
    roots = np.unique(spread.nonzero()[1])
    parts = spread[:, roots].astype(np.float32), lever.astype(np.float32), hold.astype(np.float32)
    return LashLengths(tips, roots, *parts)
