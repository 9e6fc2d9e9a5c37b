"""A face unrolled from a cylinder around the head's vertical axis."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..arrays import FloatArray
from ..mpeg4.fapu import Fapu
from ..mpeg4.mean_face import place_missing

MOUTH_ANGLE = np.radians(60)
"""Angular width of every mouth. The paper wants it constant and does not say how wide."""


class Unrolled(NamedTuple):
    """Places in the plane (N, 2), radians to the subject's left and ENS upwards; distance from the axis (N,)."""

    plane: FloatArray
    radius: FloatArray


class Cylinder:
    """The projection of one face: its mouth has a constant angular width, and the tip of its nose the angle 0.

    Parameters
    ----------
    names, positions : (P,), (P, 3) feature points of the neutral; those that the rules need and that are missing are
        placed by the average face.
    axes : (3, 3) of the head.
    fapu : of the face; one scale for the whole face, by ES across and ENS upwards and forward, so that the plane
        is not torn where regions meet.

    References
    ----------
    Pandzic 2001, "Aligning source and target face".
    """

    def __init__(self, names: Sequence[str], positions: FloatArray, axes: FloatArray, fapu: Fapu) -> None:
        self._to_units = axes.T / (fapu.es, fapu.ens, fapu.ens)
        needed = place_missing(names, positions, ("8.3", "8.4", "9.3"))
        left, right, nose = (needed[name] @ self._to_units for name in ("8.3", "8.4", "9.3"))
        depth = 0.5 * (left[2] + right[2]) - 0.5 * (left[0] - right[0]) / np.tan(0.5 * MOUTH_ANGLE)
        self._centre = np.array([nose[0], nose[1], depth])

    def unroll(self, places: FloatArray) -> Unrolled:
        """Places (N, 3) of the face in the plane."""
        x, y, z = (places @ self._to_units - self._centre).T
        return Unrolled(np.stack([np.arctan2(x, z), y], axis=1), np.hypot(x, z))
