"""Eyelids: skin that turns about the eyeball until the rims meet."""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray
from .chart import Lens
from .muscles import SIDES, column
from .sculpt import Sculpture
from .smooth import step

_MEET = 0.14
"""Where shut lids meet, from the lower rim (0) to the upper (1)."""
_ASIDE = 0.07
"""How far, in radians, the middle of a lid goes along when the eye looks aside."""


class Lids:
    """Upper and lower lid of one eye, on material points.

    Parameters
    ----------
    sculpture : the face.
    lens : the eye's opening.
    side : "l" or "r".
    places : (N, 2) chart places of the points.
    """

    def __init__(self, sculpture: Sculpture, lens: Lens, side: str, places: FloatArray) -> None:
        self._columns = [
            column(f"{name}_{side}") for name in ("blink", "widen", "squint", "tighten", "look_up", "look_aside")
        ]
        centre = sculpture.eye_centre(SIDES[side])
        u = (places[:, 0] - lens.x) / lens.half_width
        above = places[:, 1] > lens.y
        high_rim, low_rim = (lens.arc(u, upper) for upper in (True, False))
        gap = np.where(above, places[:, 1] - high_rim[:, 1], low_rim[:, 1] - places[:, 1])
        share = (1.0 - step(gap, 0.0, np.where(above, 0.20, 0.17))) * (np.abs(u) < 1)
        rows = np.flatnonzero(share)
        share, above = share[rows], above[rows]
        # The rims at each place's own x: the angle between them is what the lids have to close.
        high, low = (sculpture.surface(rim[rows]) - centre for rim in (high_rim, low_rim))
        opening = _elevation(high) - _elevation(low)
        shut = _turned(low, _MEET * opening) - _turned(high, (_MEET - 1.0) * opening)
        self._rows = rows
        self._above = above
        self._turn = (share * opening).astype(np.float32)
        self._position = (sculpture.surface(places[rows]) - centre).astype(np.float32)
        self._rest = np.where(above, share, 0.0)[:, None] * shut
        self._aside = (_ASIDE * share * (1.0 - u[rows] ** 2) ** 2).astype(np.float32)

    def add(self, table: FloatArray, displacement: FloatArray) -> None:
        """Add what the lids do under contractions (F, A) to displacements (F, N, 3)."""
        blink, widen, squint, tighten, look, aside = (table[:, k, None] for k in self._columns)
        up, down = np.maximum(look, 0.0), np.maximum(-look, 0.0)
        # Shut lids meet in one place, whatever else acts on them.
        upper = (_MEET - 1.0) * blink + (0.30 * widen - 0.16 * tighten + 0.24 * up - 0.46 * down) * (1.0 - blink)
        lower = _MEET * blink + (0.26 * squint + 0.36 * tighten - 0.08 * widen + 0.10 * up - 0.16 * down) * (
            1.0 - blink
        )
        angle = np.where(self._above, upper, lower).astype(np.float32) * self._turn
        turned = _turned(self._position, angle)
        # What the turn leaves open, because the two rims are not equally far from the axis.
        turned += blink[..., None] * self._rest
        # The cornea pushes the lids aside.
        sideways = aside.astype(np.float32) * self._aside
        sine, versine = np.sin(sideways), 2 * np.sin(0.5 * sideways) ** 2
        x, z = turned[..., 0].copy(), turned[..., 2].copy()
        turned[..., 0] += sine * z - versine * x
        turned[..., 2] -= sine * x + versine * z
        displacement[:, self._rows] += turned - self._position


def _elevation(from_centre: FloatArray) -> FloatArray:
    return np.asarray(np.arctan2(from_centre[:, 1], from_centre[:, 2]))


def _turned(from_axis: FloatArray, angle: FloatArray) -> FloatArray:
    """Positions (N, 3), relative to an axis along x, turned upwards by angles (..., N)."""
    sine, cosine = np.sin(angle), np.cos(angle)
    x, y, z = from_axis.T
    return np.stack([np.broadcast_to(x, angle.shape), cosine * y + sine * z, cosine * z - sine * y], axis=-1)
