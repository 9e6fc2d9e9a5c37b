"""Parts that move by themselves: eyeballs that look where the gaze goes, lower teeth and tongue."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from ..core.arrays import FloatArray, IntArray
from .acting import JAW_ANGLE, JAW_SHIFTS, turned_down
from .muscles import SIDES, column
from .parts import Part
from .sculpt import Sculpture
from .smooth import step

_UP, _ASIDE = np.radians(26.0), np.radians(32.0)
"""How far an eye turns at full contraction."""
_LONG = 0.54
"""How much of the tongue's length, from the tip, is drawn out, in eye separations; what lies behind stays."""
_OUT, _LIFT, _DROP = 0.62, 0.02, 0.26
"""How far the tip of the tongue comes out, its back rises over the lip, and the tip drops again; eye separations."""


class MovingPart(Protocol):
    """A part that is ready to move.

    Attributes
    ----------
    rows : (n,) its vertices among the face's.
    columns : of the actions that move it.
    """

    rows: IntArray
    columns: list[int]

    def positions(self, table: FloatArray) -> FloatArray:
        """(F, n, 3) in the sculpture's units, under contractions (F, A)."""
        ...


class Gaze:
    """One eyeball, turning about its centre.

    Parameters
    ----------
    sculpture : the face. side : "l" or "r".
    ball : the eyeball at rest. rows : (n,) its vertices among the face's.
    """

    def __init__(self, sculpture: Sculpture, side: str, ball: Part, rows: IntArray) -> None:
        self.rows = rows
        self.columns = [column(f"{name}_{side}") for name in ("look_up", "look_aside")]
        self._centre = sculpture.eye_centre(SIDES[side])
        self._from_centre = ball.vertices - self._centre

    def positions(self, table: FloatArray) -> FloatArray:
        """(F, n, 3) in the sculpture's units, under contractions (F, A)."""
        up, aside = (table[:, k] for k in self.columns)
        pitch, yaw = _UP * up, _ASIDE * aside
        zero, one = np.zeros(len(table)), np.ones(len(table))
        raised = np.array(
            [[one, zero, zero], [zero, np.cos(pitch), np.sin(pitch)], [zero, -np.sin(pitch), np.cos(pitch)]]
        )
        turned = np.array([[np.cos(yaw), zero, np.sin(yaw)], [zero, one, zero], [-np.sin(yaw), zero, np.cos(yaw)]])
        rotations = np.einsum("ijf,jkf->fik", turned, raised)
        found: FloatArray = self._from_centre @ rotations.transpose(0, 2, 1) + self._centre
        return found


class OnJaw:
    """Lower teeth or tongue: they go with the jaw; the tongue also comes out.

    Parameters
    ----------
    sculpture : the face.
    name : "lower teeth" or "tongue".
    part : at rest. rows : (n,) its vertices among the face's.
    """

    def __init__(self, sculpture: Sculpture, name: str, part: Part, rows: IntArray) -> None:
        self.rows = rows
        self.columns = [column(action) for action in ("tongue_out", "jaw", *JAW_SHIFTS)]
        self._joint = sculpture.jaw_joint
        self._from_joint = part.vertices - self._joint
        out = _out(part.vertices, sculpture.scale) if name == "tongue" else np.zeros_like(part.vertices)
        shifts = (np.broadcast_to(shift, out.shape) for shift, _ in JAW_SHIFTS.values())
        self._moves = sculpture.scale * np.stack([out, *shifts])

    def positions(self, table: FloatArray) -> FloatArray:
        """(F, n, 3) in the sculpture's units, under contractions (F, A)."""
        out, jaw, *shifts = (table[:, k] for k in self.columns)
        moved = np.einsum("af,anc->fnc", np.array([out, *shifts]), self._moves) + self._from_joint
        found: FloatArray = turned_down(moved, JAW_ANGLE * jaw[:, None]) + self._joint
        return found


def _out(tongue: FloatArray, scale: float) -> FloatArray:
    """Displacements (n, 3), in eye separations, of a tongue at (n, 3) that comes out; scale: units in one."""
    forward = tongue[:, 2]
    share = np.clip((forward - forward.max()) / (_LONG * scale) + 1.0, 0.0, 1.0)
    over_lip = _LIFT * step(share, 0.0, 0.65) - _DROP * step(share, 0.78, 1.25)
    return np.stack([0.0 * share, over_lip, _OUT * share], axis=1)
