"""Eyeballs that look where the gaze goes."""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray, IntArray
from .muscles import SIDES, column
from .parts import Part
from .sculpt import Sculpture

_UP, _ASIDE = np.radians(26.0), np.radians(32.0)
"""How far an eye turns at full contraction."""


class Gaze:
    """One eyeball, ready to turn about its centre.

    Parameters
    ----------
    sculpture : the face. side : "l" or "r".
    ball : the eyeball at rest. rows : (n,) its vertices among the face's.
    """

    def __init__(self, sculpture: Sculpture, side: str, ball: Part, rows: IntArray) -> None:
        self.rows = rows
        self._columns = [column(f"{name}_{side}") for name in ("look_up", "look_aside")]
        self._centre = sculpture.eye_centre(SIDES[side])
        self._from_centre = ball.vertices - self._centre

    def turning(self, table: FloatArray) -> IntArray:
        """Which of the contractions (F, A) turn it."""
        acting: IntArray = np.flatnonzero(table[:, self._columns].any(axis=1))
        return acting

    def positions(self, table: FloatArray) -> FloatArray:
        """(F, n, 3) in the sculpture's units, under contractions (F, A)."""
        up, aside = (table[:, k] for k in self._columns)
        pitch, yaw = _UP * up, _ASIDE * aside
        zero, one = np.zeros(len(table)), np.ones(len(table))
        raised = np.array(
            [[one, zero, zero], [zero, np.cos(pitch), np.sin(pitch)], [zero, -np.sin(pitch), np.cos(pitch)]]
        )
        turned = np.array([[np.cos(yaw), zero, np.sin(yaw)], [zero, one, zero], [-np.sin(yaw), zero, np.cos(yaw)]])
        rotations = np.einsum("ijf,jkf->fik", turned, raised)
        found: FloatArray = self._from_centre @ rotations.transpose(0, 2, 1) + self._centre
        return found
