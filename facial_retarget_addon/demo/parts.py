"""What lies behind the skin of a built-in face and stays put: eyeballs, teeth, the mouth's dark."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray, IntArray
from .sculpt import Sculpture

_WHITE = (0.82, 0.81, 0.79)
_IRIS = (0.16, 0.22, 0.26)
_PUPIL = (0.015, 0.015, 0.015)
_TOOTH = (0.80, 0.77, 0.68)
_DARK = (0.10, 0.02, 0.02)


@dataclass(frozen=True, eq=False)
class Part:
    """A mesh of quads: vertices (V, 3), quads (Q, 4), uvs (V, 2), linear colours (V, 3)."""

    vertices: FloatArray
    quads: IntArray
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
    """The front of an eyeball, pupil in the middle; the grid of a disc, so that no pole is needed."""
    v, u, quads = _grid(24, 24)
    x, y = 2 * u - 1, 2 * v - 1
    disc = np.stack([x * np.sqrt(1 - 0.5 * y**2), y * np.sqrt(1 - 0.5 * x**2)], axis=1)
    radius = np.hypot(*disc.T)
    angle = np.radians(100.0) * radius
    around = disc / np.maximum(radius, 1e-9)[:, None]
    unit = np.concatenate([np.sin(angle)[:, None] * around, np.cos(angle)[:, None]], axis=1)
    colours = np.where((angle < 0.46)[:, None], _IRIS, _WHITE)
    colours[angle < 0.20] = _PUPIL
    places = sculpture.eye_centre(side) + sculpture.eye_radius * unit
    return Part(places, quads, 0.05 + 0.04 * disc + np.array([0.02, 0.0]) * side, colours)


def _teeth(sculpture: Sculpture) -> Part:
    """The upper row, behind the upper lip."""
    v, u, quads = _grid(4, 64)
    x = 0.56 * (u - 0.5)
    gaps = 1.0 - np.abs(np.sin(10 * np.pi * (u - 0.5))) ** 0.5
    places = np.stack([x, -1.155 + 0.20 * v + 0.02 * gaps * (v < 0.1)], axis=1)
    depth = 0.075 * sculpture.shape.muzzle - 0.125 - 1.2 * x**2 - 0.05 * v - 0.012 * gaps
    return _behind(sculpture, places, depth, 1.0, quads, _TOOTH)


def _wall(sculpture: Sculpture) -> Part:
    """The dark at the back of the mouth."""
    v, u, quads = _grid(12, 16)
    places = np.stack([1.1 * (u - 0.5), -1.66 + 0.90 * v], axis=1)
    return _behind(sculpture, places, np.full(len(places), -0.30), 0.85, quads, _DARK)


def _behind(
    sculpture: Sculpture,
    places: FloatArray,
    depth: FloatArray,
    narrower: float,
    quads: IntArray,
    colour: tuple[float, float, float],
) -> Part:
    """A part that follows the base sheet, `depth` (eye separations) in front of it and narrower."""
    positions = sculpture.sheet(places) * np.array([narrower, 1.0, 1.0])
    positions[:, 2] += sculpture.scale * depth
    low, high = places.min(axis=0), places.max(axis=0)
    uvs = np.array([0.90, 0.02]) + 0.06 * (places - low) / (high - low)
    return Part(positions, quads, uvs, np.tile(colour, (len(positions), 1)))
