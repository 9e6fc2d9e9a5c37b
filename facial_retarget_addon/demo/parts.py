"""What lies behind the skin of a built-in face: eyeballs, teeth, the mouth's dark."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray, IntArray
from .chart import MOUTH
from .sculpt import Sculpture

_WHITE = (0.82, 0.81, 0.79)
_IRIS = (0.16, 0.22, 0.26)
_PUPIL = (0.015, 0.015, 0.015)
_TOOTH = (0.80, 0.77, 0.68)
_DARK = (0.10, 0.02, 0.02)


@dataclass(frozen=True, eq=False)
class Part:
    """A mesh: vertices (V, 3), polygons (P, corners of each), uvs (V, 2), linear colours (V, 3)."""

    vertices: FloatArray
    polygons: IntArray
    uvs: FloatArray
    colours: FloatArray


def parts(sculpture: Sculpture) -> list[Part]:
    """The eyeballs, the upper teeth and the mouth's back wall of a sculpture, each its own component."""
    return [_eyeball(sculpture, 1.0), _eyeball(sculpture, -1.0), _teeth(sculpture), _wall(sculpture)]


def _grid(rows: int, columns: int) -> tuple[FloatArray, FloatArray, IntArray]:
    """Parameters v, u from 0 to 1 of a grid's vertices, and its quads."""
    v, u = np.meshgrid(np.linspace(0, 1, rows + 1), np.linspace(0, 1, columns + 1), indexing="ij")
    index = np.arange(v.size).reshape(v.shape)
    quads = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1).reshape(-1, 4)
    return v.ravel(), u.ravel(), quads


def _eyeball(sculpture: Sculpture, side: float) -> Part:
    """The front of an eyeball: squares of a grid drawn into rings around the pupil, so that it has no pole."""
    v, u, quads = _grid(32, 32)
    square = np.stack([2 * u - 1, 2 * v - 1], axis=1)
    ring = np.abs(square).max(axis=1)
    round_ = square / np.maximum(np.hypot(*square.T), 1e-9)[:, None]
    angle = np.radians(115.0) * ring**1.4
    # Far behind the lids the ball grows, so that no view past a lid's corner misses it, and no gaze shows it.
    radius = 1.0 + 0.25 * np.maximum(angle - 1.5, 0.0)
    across, forward = radius * np.sin(angle), radius * np.cos(angle)
    unit = np.concatenate([across[:, None] * round_, forward[:, None]], axis=1)
    colours = np.where((angle < 0.385)[:, None], _IRIS, _WHITE)
    colours[angle < 0.165] = _PUPIL
    positions = sculpture.eye_centre(side) + sculpture.eye_radius * unit
    uvs = np.array([0.06 + 0.03 * side, 0.05]) + 0.025 * ring[:, None] * round_
    return Part(positions, quads, uvs, colours)


def _teeth(sculpture: Sculpture) -> Part:
    """The upper row, behind the upper lip."""
    v, u, quads = _grid(4, 84)
    x = 0.80 * (u - 0.5)
    gaps = 1.0 - np.abs(np.sin(14 * np.pi * (u - 0.5))) ** 0.5
    places = np.stack([x, -1.155 + 0.20 * v + 0.02 * gaps * (v < 0.1)], axis=1)
    depth = 0.075 * sculpture.shape.muzzle - 0.160 - 1.7 * x**2 - 0.05 * v - 0.012 * gaps
    return _behind(sculpture, places, depth, 1.0, quads, 0.90, _TOOTH)


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
