"""Motion retargeted in subdivision wavelets: coefficient differences of the source, added to the target's."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray
from ..binding import apply_matrix
from ..carry import Motion
from .lifting import Wavelets


class WaveletMotion:
    """Displacements of the target's finest level for source frames.

    All of it is linear, so the target's own coefficients do not come in: what is added to them is M^0 and m^j, the
    differences of the source's base and coefficients between a frame and its neutral, scaled and turned.

    Parameters
    ----------
    read : (N, Vs) csr, values of the source's vertices to those of its finest level.
    rest : (Vs, 3) the source's neutral.
    wavelets : of the base that both faces share.
    turns : for the base and for the coefficients of each level, (n, 3, 3) rotations times scale and strength.

    References
    ----------
    Min and Jung 2005, equations (2), (3) and (5), steps 1 to 4.
    """

    def __init__(self, read: sp.csr_matrix, rest: FloatArray, wavelets: Wavelets, turns: Sequence[FloatArray]) -> None:
        self._read, self._rest = read.astype(np.float32), rest.astype(np.float32)
        self._wavelets = wavelets.single()
        self._turns = [np.asarray(part, np.float32) for part in turns]

    def __call__(self, frames: FloatArray) -> FloatArray:
        """Displacements (F, N, 3) float32 for source frames (F, Vs, 3)."""
        count = len(frames)
        moved = np.ascontiguousarray((frames - self._rest).transpose(1, 0, 2)).reshape(-1, 3 * count)
        parts = self._wavelets.analyse(self._read @ moved)
        turned = [
            (part.reshape(-1, count, 3) @ turn.transpose(0, 2, 1)).reshape(-1, 3 * count)
            for part, turn in zip(parts, self._turns, strict=True)
        ]
        fine = self._wavelets.synthesise(turned).reshape(-1, count, 3)
        return np.ascontiguousarray(fine.transpose(1, 0, 2))


class RidingMotion:
    """Motion of the artist's vertices: what they ride on, and a motion of their own beside it.

    Parameters
    ----------
    fine : motion of the finest level.
    ride : (Vt, N) csr to the artist's vertices.
    own : what is added there: what is finer than the last level, and all of it beyond the base's border.
    """

    def __init__(self, fine: Motion, ride: sp.csr_matrix, own: Sequence[Motion]) -> None:
        self._fine, self._ride, self._own = fine, ride.astype(np.float32), own

    def __call__(self, frames: FloatArray) -> FloatArray:
        """Displacements (F, Vt, 3) for source frames (F, Vs, 3)."""
        moved = apply_matrix(self._ride, self._fine(frames))
        for own in self._own:
            moved += own(frames)
        return moved
