"""Which unit measures the motion of a point along each axis of the head, by the region that it lies in."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial import cKDTree

from ..arrays import FloatArray
from ..errors import RetargetError
from .fapu import Fapu
from .fdps import FDPS

Units = tuple[str, str, str]

TEETH = ("9.8", "9.9", "9.10", "9.11")

REGION_UNITS: dict[int, Units] = {
    2: ("MW", "MNS", "MNS"),
    3: ("ES", "IRISD", "ES"),
    4: ("ES", "ENS", "ENS"),
    5: ("ES", "ENS", "ES"),
    6: ("MW", "MNS", "MW"),
    7: ("ES", "ENS", "ES"),
    8: ("MW", "MNS", "MNS"),
    9: ("ENS", "ENS", "ENS"),
    10: ("ENS", "ENS", "ENS"),
    11: ("ES", "ES", "ES"),
}
"""Group of FDPs -> units along x, y, z: those of the FAPs that act in it (Pandzic states the lips' ones)."""

OWN_PARTS = ("3.5", "3.6", "6.1", "6.2", "6.3", "6.4", *TEETH)
"""FDPs that do not lie on the skin: pupils, tongue, teeth."""


def region_units(name: str) -> Units:
    """Units of an FDP along x, y, z."""
    return REGION_UNITS[2] if name in TEETH else REGION_UNITS[int(name.split(".")[0])]


def point_lengths(names: Sequence[str], positions: FloatArray, faces: Sequence[Fapu]) -> list[FloatArray]:
    """Lengths (P, 3) that measure points along the head's axes, on each of several faces.

    A point with a free name is measured like the nearest FDP among them.

    Parameters
    ----------
    names : (P,).
    positions : (P, 3) on the neutral of one of the faces.
    faces : their units.

    Raises
    ------
    RetargetError : if no name is an FDP's.
    """
    known = [row for row, name in enumerate(names) if name in FDPS]
    if not known:
        raise RetargetError(f"none of the {len(names)} feature points has an MPEG-4 name, expected names such as 2.1")
    nearest = cKDTree(np.asarray(positions)[known]).query(positions)[1]
    units = [region_units(names[known[k]]) for k in nearest]
    return [np.array([[fapu.length(unit) for unit in three] for three in units]) for fapu in faces]
