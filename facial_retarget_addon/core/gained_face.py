"""The motion of a face, as strong at each vertex as gains say."""

from __future__ import annotations

from dataclasses import astuple
from functools import cached_property

import numpy as np

from .arrays import FloatArray, IntArray
from .errors import RetargetError
from .face_regions import region_weights
from .gains import Gains
from .methods.settings import RegionGains
from .problem import Face


class GainedFace:
    """The motion of a face, as strong at each vertex as gains say.

    Parameters
    ----------
    face : the target.

    Attributes
    ----------
    strength : (V,) of the motion at its vertices.
    """

    def __init__(self, face: Face, gains: Gains) -> None:
        self._face = face
        self._rest = face.mesh.vertices.astype(np.float32)
        self.set(gains)

    def set(self, gains: Gains) -> None:
        """Other gains from now on.

        Raises
        ------
        RetargetError : as `region_weights`, where a region's gain is not 1; for a mask of another vertex count.
        """
        self.strength = self._strength(gains)
        self._rows: IntArray = np.flatnonzero(self.strength != 1.0)
        self._strength_there = self.strength[self._rows, None].astype(np.float32)

    def scale(self, frames: FloatArray) -> FloatArray:
        """Frames (F, V, 3) float32 of the face, their motion scaled in place."""
        if len(self._rows):
            rest = self._rest[self._rows]
            frames[:, self._rows] = rest + self._strength_there * (frames[:, self._rows] - rest)
        return frames

    def scale_displacements(self, displacements: FloatArray) -> FloatArray:
        """Displacements (F, V, 3) from its neutral, scaled in place."""
        if len(self._rows):
            displacements[:, self._rows] *= self._strength_there
        return displacements

    @cached_property
    def _weights(self) -> FloatArray:
        return region_weights(self._face)

    def _strength(self, gains: Gains) -> FloatArray:
        """(V,) strength of the motion: 1 + sum of w (g - 1) over the regions, times the same of each mask."""
        strength = np.ones(len(self._rest))
        if gains.regions != RegionGains():
            strength += self._weights @ (np.array(astuple(gains.regions)) - 1)
        for name, mask in gains.masks.items():
            weights = np.asarray(mask.weights)
            if weights.shape != strength.shape:
                raise RetargetError(
                    f"mask {name!r} has weights of shape {weights.shape}, expected ({len(strength)},) for the target"
                )
            strength *= 1 + weights * (mask.gain - 1)
        return strength
