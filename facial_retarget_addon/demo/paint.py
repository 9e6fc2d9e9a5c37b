"""Colours of the skin: brows and lips, so that a face reads at a glance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray
from .chart import MOUTH, brow_line
from .smooth import along, bell, step

Colour = tuple[float, float, float]


@dataclass(frozen=True)
class Palette:
    """Linear colours from 0 to 1."""

    skin: Colour
    lip: Colour
    brow: Colour


def skin_colours(places: FloatArray, palette: Palette) -> FloatArray:
    """Linear colours (N, 3) from 0 to 1 of chart places (N, 2)."""
    x, y = np.abs(places[:, 0]), places[:, 1]
    thickness = 0.044 - 0.026 * step(x, 0.40, 0.95)
    brow = 0.85 * bell(y - 0.02 - brow_line(x), thickness) * along(x, 0.17, 0.84, 0.09)
    across = np.clip(1.0 - (x / (MOUTH.half_width + 0.01)) ** 2, 0.0, 1.0)
    height = np.where(y > MOUTH.y, 0.115 * across**0.7, 0.145 * across**0.6)
    lip = 0.75 * (1.0 - step(MOUTH.distance(places), height - 0.022, height + 0.022)) * (x < MOUTH.half_width)
    colours = np.tile(palette.skin, (len(places), 1))
    for share, colour in ((lip, palette.lip), (brow, palette.brow)):
        colours += share[:, None] * (np.array(colour) - colours)
    return colours
