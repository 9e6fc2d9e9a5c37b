"""Facial Animation Parameter Units: the lengths of a face that its FAPs are measured in."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..errors import RetargetError
from .mean_face import place_missing

PARTS = 1024
"""A FAP of this value moves its point by the whole length."""
ANGLE = 1e-5
"""Radians of one AU."""

_LENGTHS: dict[str, tuple[tuple[tuple[str, ...], tuple[str, ...]], ...]] = {
    "IRISD": ((("3.1",), ("3.3",)), (("3.2",), ("3.4",))),
    "ES": ((("3.5",), ("3.6",)),),
    "ENS": ((("3.5", "3.6"), ("9.15",)),),
    "MNS": ((("9.15",), ("2.2",)),),
    "MW": ((("8.3",), ("8.4",)),),
}
"""Unit -> the gaps that it is the mean of, each between the middles of two groups of points."""
_AXIS = {"IRISD": 1, "ES": 0, "ENS": 1, "MNS": 1, "MW": 0}
_STAND_INS = {"3.5": ("3.7", "3.11"), "3.6": ("3.8", "3.12")}
"""A pupil that has no point lies between the corners of its eye, on a face with two eyes."""


@dataclass(frozen=True)
class Fapu:
    """The five lengths of a neutral face (FAPU0), in its object's units.

    Attributes
    ----------
    irisd : upper lid to lower lid, mean of the eyes that have both.
    es : pupil to pupil.
    ens : pupils to the nose's lower edge.
    mns : the nose's lower edge to the upper lip's inner middle.
    mw : mouth corner to mouth corner, outer.
    taken : unit -> the points that gave it, and which of them had to be placed.
    """

    irisd: float
    es: float
    ens: float
    mns: float
    mw: float
    taken: dict[str, str]

    def length(self, unit: str) -> float:
        """FAPU0 of a unit of length."""
        length: float = getattr(self, unit.lower())
        return length

    def unit(self, name: str) -> float:
        """What one unit of a FAP is: a length, or an angle in radians for AU."""
        return ANGLE if name == "AU" else self.length(name) / PARTS


def measure_fapu(names: Sequence[str], positions: FloatArray, axes: FloatArray) -> Fapu:
    """Measure a neutral face: eyes open, mouth closed.

    Parameters
    ----------
    names : (P,) of its points; pupils that are missing are taken between their eye's corners, other missing points are
        placed by the average face. `taken` says so.
    positions : (P, 3).
    axes : (3, 3) of the head, from `head_axes`.

    Raises
    ------
    RetargetError : if a length is not greater than zero: points changed sides, or the neutral is not neutral.

    References
    ----------
    ISO/IEC 14496-2, FAPU.
    """
    points = {
        name: np.asarray(axes @ position, np.float64)
        for name, position in zip(names, np.asarray(positions), strict=True)
    }
    found: dict[str, float] = {}
    taken: dict[str, str] = {}
    for unit, gaps in _LENGTHS.items():
        whole = [gap for gap in gaps if all(name in points for name in gap[0] + gap[1])] or list(gaps)
        notes: list[str] = []
        sizes = [_middle(points, high, notes) - _middle(points, low, notes) for high, low in whole]
        found[unit] = float(np.mean(sizes, axis=0)[_AXIS[unit]])
        used = " and ".join(f"{'/'.join(high)} to {'/'.join(low)}" for high, low in whole)
        taken[unit] = "; ".join([used, *dict.fromkeys(notes)])
        if not found[unit] > 0:
            raise RetargetError(
                f"the unit {unit} of the neutral face is {found[unit]:.4g} ({used}), expected a length greater than "
                "zero: eyes open, mouth closed, and left points on the subject's left"
            )
    return Fapu(**{unit.lower(): length for unit, length in found.items()}, taken=taken)


def _middle(points: dict[str, FloatArray], group: Sequence[str], notes: list[str]) -> FloatArray:
    """Middle of a group of points (3,), those that are missing put in their place."""
    places = []
    two_eyes = all(corner in points for corners in _STAND_INS.values() for corner in corners)
    for name in group:
        corners = _STAND_INS.get(name, ())
        if name in points:
            places.append(points[name])
        elif corners and two_eyes:
            places.append(np.mean([points[corner] for corner in corners], axis=0))
            notes.append(f"{name} taken between {corners[0]} and {corners[1]}")
        else:
            places.append(place_missing(list(points), np.array(list(points.values())), [name])[name])
            notes.append(f"{name} placed by the average face")
    middle: FloatArray = np.mean(places, axis=0)
    return middle
