"""Colours of the skin: brows and lips, so that a face reads at a glance."""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray
from .chart import MOUTH
from .shapes import along, bell, step

_SKIN = np.array([0.74, 0.60, 0.52])
_LIP = np.array([0.62, 0.36, 0.33])
_BROW = np.array([0.22, 0.15, 0.11])


def skin_colours(places: FloatArray) -> FloatArray:
    """Linear colours (N, 3) from 0 to 1 of chart places (N, 2)."""
    x, y = np.abs(places[:, 0]), places[:, 1]
    line = 0.245 + 0.085 * np.sin(2.9 * np.clip(x - 0.12, 0.0, 1.0))
    thickness = 0.062 - 0.036 * step(x, 0.40, 0.95)
    brow = 0.85 * bell(y - line, 1.0 * thickness) ** 2 * along(x, 0.17, 0.84, 0.09)
    across = np.clip(1.0 - (x / (MOUTH.half_width + 0.01)) ** 2, 0.0, 1.0)
    height = np.where(y > MOUTH.y, 0.115 * across**0.7, 0.145 * across**0.6)
    lip = 0.75 * (1.0 - step(MOUTH.distance(places), height - 0.015, height + 0.015)) * (x < MOUTH.half_width)
    colours = _SKIN + lip[:, None] * (_LIP - _SKIN)
    return np.asarray(colours + brow[:, None] * (_BROW - colours))
