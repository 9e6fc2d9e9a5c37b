"""What lies behind the skin of a built-in face: eyeballs, tongue, teeth, the mouth's dark."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray, IntArray
from .chart import MOUTH
from .sculpt import Sculpture
from .smooth import bell

_BALL = 0.985
"""Size of an eyeball, of the one that the lids are shaped by: so they lie before it."""
_WHITE = (0.82, 0.81, 0.79)
_IRIS = (0.16, 0.22, 0.26)
_PUPIL = (0.015, 0.015, 0.015)
_TOOTH = (0.80, 0.77, 0.68)
_FLESH = (0.55, 0.20, 0.19)
_DARK = (0.10, 0.02, 0.02)


@dataclass(frozen=True, eq=False)
class Part:
    """A mesh: vertices (V, 3), polygons (P, corners of each), uvs (V, 2), linear colours (V, 3)."""

    vertices: FloatArray
    polygons: IntArray
    uvs: FloatArray
    colours: FloatArray


def skull_parts(sculpture: Sculpture) -> dict[str, Part]:
    """The eyeballs, the upper teeth and the mouth's back wall of a sculpture, each its own component, by name."""
    return {
        "left eyeball": _eyeball(sculpture, 1.0),
        "right eyeball": _eyeball(sculpture, -1.0),
        "upper teeth": _upper_teeth(sculpture),
        "still": _wall(sculpture),
    }


def jaw_parts(sculpture: Sculpture) -> dict[str, Part]:
    """What lies on the jaw of a sculpture, by name: the lower teeth and the tongue."""
    return {"lower teeth": _lower_teeth(sculpture), "tongue": _tongue(sculpture)}


def _grid(rows: int, columns: int) -> tuple[FloatArray, FloatArray, IntArray]:
    """Parameters v, u from 0 to 1 of a grid's vertices, and its quads."""
    v, u = np.meshgrid(np.linspace(0, 1, rows + 1), np.linspace(0, 1, columns + 1), indexing="ij")
    index = np.arange(v.size).reshape(v.shape)
    quads = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1).reshape(-1, 4)
    return v.ravel(), u.ravel(), quads


def _rings(count: int) -> tuple[FloatArray, FloatArray, IntArray]:
    """Squares of a grid drawn into rings around their middle, so that there is no pole.

    Returns
    -------
    How far out (V,) each vertex lies, from 0 to 1; which way (V, 2); the quads.
    """
    v, u, quads = _grid(count, count)
    square = np.stack([2 * u - 1, 2 * v - 1], axis=1)
    return np.abs(square).max(axis=1), square / np.maximum(np.hypot(*square.T), 1e-9)[:, None], quads


def _eyeball(sculpture: Sculpture, side: float) -> Part:
    """The front of an eyeball, in rings around the pupil."""
    ring, round_, quads = _rings(32)
    angle = np.radians(115.0) * ring**1.4
    unit = np.concatenate([np.sin(angle)[:, None] * round_, np.cos(angle)[:, None]], axis=1)
    colours = np.where((angle < 0.385)[:, None], _IRIS, _WHITE)
    colours[angle < 0.165] = _PUPIL
    positions = sculpture.eye_centre(side) + _BALL * sculpture.eye_radius * unit
    uvs = np.array([0.06 + 0.03 * side, 0.05]) + 0.025 * ring[:, None] * round_
    return Part(positions, quads, uvs, colours)


def _tongue(sculpture: Sculpture) -> Part:
    """It lies below the upper teeth, its tip behind them; its thick root goes through the mouth's wall."""
    ring, round_, quads = _rings(20)
    angle = np.radians(125.0) * ring
    x, y = (np.sin(angle) * round_[:, k] for k in (0, 1))
    back = 0.5 * (1.0 - np.cos(angle))
    height = np.where(y > 0, 0.060, 0.060 + 0.30 * back**2) * y
    # A furrow along the middle.
    height -= 0.018 * bell(0.20 * x, 0.05) * (y > 0) * np.sin(angle)
    middle = sculpture.sheet(np.array([[MOUTH.x, MOUTH.y - 0.03]]))[0]
    tip = 0.075 * sculpture.shape.muzzle - 0.305
    positions = middle + sculpture.scale * np.stack([0.20 * x, height, tip - 1.05 * back], axis=1)
    uvs = np.array([0.22, 0.05]) + 0.025 * ring[:, None] * round_
    return Part(positions, quads, uvs, np.tile(_FLESH, (len(positions), 1)))


def _upper_teeth(sculpture: Sculpture) -> Part:
    """The upper row, behind the upper lip."""
    v, u, quads = _grid(4, 84)
    x = 0.80 * (u - 0.5)
    gaps = 1.0 - np.abs(np.sin(14 * np.pi * (u - 0.5))) ** 0.5
    places = np.stack([x, -1.155 + 0.20 * v + 0.02 * gaps * (v < 0.1)], axis=1)
    depth = 0.075 * sculpture.shape.muzzle - 0.160 - 1.7 * x**2 - 0.05 * v - 0.012 * gaps
    return _behind(sculpture, places, depth, 1.0, quads, 0.90, _TOOTH)


def _lower_teeth(sculpture: Sculpture) -> Part:
    """The lower row, behind the upper one and below its edge."""
    v, u, quads = _grid(4, 72)
    x = 0.72 * (u - 0.5)
    gaps = 1.0 - np.abs(np.sin(12 * np.pi * (u - 0.5))) ** 0.5
    places = np.stack([x, -1.350 + 0.19 * v - 0.015 * gaps * (v > 0.9)], axis=1)
    depth = 0.075 * sculpture.shape.muzzle - 0.195 - 1.8 * x**2 - 0.03 * (1.0 - v) - 0.010 * gaps
    return _behind(sculpture, places, depth, 1.0, quads, 0.70, _TOOTH)


def _wall(sculpture: Sculpture) -> Part:
    """The dark at the back of the mouth."""
    v, u, quads = _grid(12, 16)
    places = np.stack([1.3 * (u - 0.5), -1.66 + 0.90 * v], axis=1)
    depth = -0.42 + 0.38 * (2 * u - 1) ** 4 * np.exp(-(((places[:, 1] - MOUTH.y) / 0.22) ** 2))
    return _behind(sculpture, places, depth, 0.85, quads, 0.80, _DARK)


def _behind(
    sculpture: Sculpture,
    places: FloatArray,
    depth: FloatArray,
    narrower: float,
    quads: IntArray,
    u: float,
    colour: tuple[float, float, float],
) -> Part:
    """A part that follows the base sheet, `depth` (eye separations) before it and narrower; u places its texture."""
    positions = sculpture.sheet(places) * np.array([narrower, 1.0, 1.0])
    positions[:, 2] += sculpture.scale * depth
    low, high = places.min(axis=0), places.max(axis=0)
    uvs = np.array([u, 0.02]) + 0.06 * (places - low) / (high - low)
    return Part(positions, quads, uvs, np.tile(colour, (len(positions), 1)))
