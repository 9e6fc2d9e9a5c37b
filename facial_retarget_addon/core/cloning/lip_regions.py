"""Which vertices belong to the upper and which to the lower lip, in the plane."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray

UPPER = ("2.4", "2.6", "2.2", "2.7", "2.5", "9.2", "9.1")
LOWER = ("2.4", "2.8", "2.3", "2.9", "2.5", "2.12", "2.11")
"""Polygons: the inner contour of a lip, and the sides of the nose or of the chin."""
LOWER_BY_JAW = ("2.4", "2.8", "2.3", "2.9", "2.5", "2.14", "2.1", "2.13")
"""For faces without points at the sides of the chin: down to the jaw, which other points can place."""

_NUDGE = np.array([0.0, 1e-6])
"""Points of the inner contours are corners of the regions: this far into their lip, rounding does not decide."""


def lip_outlines(names: Collection[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """FDPs around the region of the upper and of the lower lip, for a face with these points."""
    return UPPER, LOWER if {"2.11", "2.12"} <= set(names) else LOWER_BY_JAW


def lip_regions(upper: FloatArray, lower: FloatArray, plane: FloatArray) -> IntArray:
    """1 for places (N, 2) in the region of the upper lip, -1 in that of the lower lip, 0 elsewhere and in both.

    Parameters
    ----------
    upper, lower : (K, 2) corners of the regions in the same plane, in the order of `lip_outlines`.

    References
    ----------
    Pandzic 2001, "Treating the lip region".
    """
    return _inside(upper, plane + _NUDGE).astype(np.int64) - _inside(lower, plane - _NUDGE)


def _inside(polygon: FloatArray, places: FloatArray) -> BoolArray:
    """(N,) true for places within a polygon (K, 2): its sides are crossed an odd number of times on the way out."""
    inside = np.zeros(len(places), bool)
    x, y = places.T
    for (ax, ay), (bx, by) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        crosses = (ay > y) != (by > y)
        inside ^= crosses & (x < ax + (y - ay) * (bx - ax) / np.where(crosses, by - ay, 1.0))
    return inside
