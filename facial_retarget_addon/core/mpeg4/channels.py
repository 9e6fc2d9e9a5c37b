"""FAPs as motion of feature points, and back."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import BoolArray, FloatArray
from .faps import FAPS, X, Y
from .fapu import PARTS, Fapu
from .fdps import FDPS

LIDS = {"3.1": "3.3", "3.3": "3.1", "3.2": "3.4", "3.4": "3.2"}
"""A lid's middle -> the middle of the lid that it closes on."""

FOLLOWERS: dict[int, dict[str, float]] = {
    16: {"2.8": 0.75, "2.9": 0.75, "2.4": 0.15, "2.5": 0.15, "8.3": 0.15, "8.4": 0.15},
    17: {"2.6": 0.75, "2.7": 0.75, "2.4": 0.15, "2.5": 0.15, "8.3": 0.15, "8.4": 0.15},
}
"""Shares of a lip's forward push that its other points follow with; the standard states its middle alone."""


class PointChannels:
    """What each FAP does to a face's feature points; linear in the FAPs.

    A lid's FAP leads from its own middle to the other lid's, so that 1024 shuts each eye whatever its size; the
    standard's vertical path would pass through the eyeball. Turns of head and eyes are not among the channels.

    Parameters
    ----------
    names : (P,) of the points.
    positions : (P, 3) on the neutral face.
    axes : (3, 3) of the head.
    fapu : of the face.
    """

    def __init__(self, names: Sequence[str], positions: FloatArray, axes: FloatArray, fapu: Fapu) -> None:
        self.names, self.axes = tuple(names), np.asarray(axes, np.float64)
        self._row = {name: row for row, name in enumerate(self.names)}
        places = np.asarray(positions, np.float64) @ self.axes.T
        self._motion = np.zeros((len(FAPS), len(self.names), 3))
        self.measurable: BoolArray = np.zeros(len(FAPS), bool)
        for fap in FAPS:
            if fap.kind == "translation" and fap.points[0] in self._row:
                self._translate(fap.number - 1, places, fapu)
            elif fap.kind == "roll":
                self._roll(fap.number - 1, places, fapu)
        self._read = self._inverse()

    def displacements(self, values: FloatArray) -> FloatArray:
        """Displacements (F, P, 3) of the points, in the object's axes and units, of FAPs (F, 68)."""
        moved: FloatArray = np.tensordot(np.asarray(values, np.float64), self._motion, axes=1) @ self.axes
        return moved

    def values(self, displacements: FloatArray) -> FloatArray:
        """FAPs (F, 68) of displacements (F, P, 3) of the points; 0 for those that cannot be measured."""
        inside = np.asarray(displacements, np.float64) @ self.axes.T
        found: FloatArray = np.tensordot(inside, self._read, axes=([1, 2], [0, 1]))
        return found

    @property
    def acting(self) -> BoolArray:
        """(P, 3) whether a FAP moves the point along the head's axis."""
        acts: BoolArray = np.abs(self._motion).max(axis=0) > 0
        return acts

    def _translate(self, column: int, places: FloatArray, fapu: Fapu) -> None:
        fap = FAPS[column]
        name, axis = fap.points[0], fap.axis or X
        row = self._row[name]
        motion = self._motion[column]
        other = self._row.get(LIDS.get(name, ""))
        if other is not None:
            motion[row] = (places[other] - places[row]) / PARTS
        else:
            motion[row, axis] = fap.sign * fapu.unit(fap.unit)
        for rider, at in self._row.items():
            if rider in FDPS and FDPS[rider].rides_on == name:
                motion[at] = motion[row]
        for follower, share in FOLLOWERS.get(fap.number, {}).items():
            if follower in self._row:
                motion[self._row[follower]] = share * motion[row]
        self.measurable[column] = name not in ("3.5", "3.6") and motion[row].any()

    def _roll(self, column: int, places: FloatArray, fapu: Fapu) -> None:
        """The tongue's borders turn about its middle line (6.2): upwards, for a small angle."""
        fap = FAPS[column]
        middle = self._row.get("6.2")
        for name in fap.points:
            if middle is not None and name in self._row:
                away = abs(places[self._row[name], X] - places[middle, X])
                self._motion[column, self._row[name], Y] = fapu.unit(fap.unit) * away

    def _inverse(self) -> FloatArray:
        """(P, 3, 68) what reads each measurable FAP off its point."""
        read = np.zeros((len(self.names), 3, len(FAPS)))
        for column in np.flatnonzero(self.measurable):
            fap = FAPS[column]
            row, axis = self._row[fap.points[0]], fap.axis or X
            step = 1 / self._motion[column, row, axis]
            read[row, axis, column] = step
            carrier = FDPS[fap.points[0]].rides_on
            if carrier in self._row:
                read[self._row[carrier], axis, column] -= step
        return read
