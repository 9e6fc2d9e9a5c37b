"""Smooth building blocks of relief: bells, steps, cushions, fillets."""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray


def bell(t: FloatArray, width: float) -> FloatArray:
    """1 at 0, 1/e at `width`."""
    return np.exp(-((t / width) ** 2))


def blob(
    x: FloatArray, y: FloatArray, at_x: float, at_y: float, width: float, height: float, turn: float = 0.0
) -> FloatArray:
    """A bell of height 1, `width` and `height` where it falls to 1/e, turned counter-clockwise by radians."""
    dx, dy = x - at_x, y - at_y
    cosine, sine = np.cos(turn), np.sin(turn)
    return np.exp(-(((cosine * dx + sine * dy) / width) ** 2) - ((cosine * dy - sine * dx) / height) ** 2)


def step(t: FloatArray, start: float, end: FloatArray | float) -> FloatArray:
    """Smoothly 0 before start, 1 after end (either way round)."""
    s = np.clip((t - start) / (end - start), 0.0, 1.0)
    return s * s * s * (s * (6 * s - 15) + 10)


def along(t: FloatArray, start: float, end: float, soft: float) -> FloatArray:
    """1 from start to end, falling off over `soft` on both sides."""
    return step(t, start - soft, start + soft) * (1.0 - step(t, end - soft, end + soft))


def pad(s: FloatArray) -> FloatArray:
    """A cushion: 1 at 0, flat; 0 from 1 on."""
    s = np.clip(s, 0.0, 1.0)
    return (1 - s**2) ** 1.5


def roll(distance: FloatArray, radius: float) -> FloatArray:
    """A quarter round: 0 beyond `radius` from the rim, 1 on it."""
    s = np.clip(1.0 - distance / radius, 0.0, 1.0)
    return 1.0 - np.sqrt(np.maximum(1.0 - s**2, 0.0))


def smooth_max(a: FloatArray, b: FloatArray, soft: float) -> FloatArray:
    """The larger one, with a fillet of width `soft` where they meet."""
    return 0.5 * (a + b + np.sqrt((a - b) ** 2 + soft**2))


def sphere(origin: FloatArray, direction: FloatArray, centre: FloatArray, radius: float) -> FloatArray:
    """Where lines leave a sphere, as distance along them; -inf where they miss it."""
    to = origin - centre
    along = np.einsum("ni,ni->n", to, direction)
    inside = radius**2 - np.einsum("ni,ni->n", to, to) + along**2
    return np.where(inside > 0, -along + np.sqrt(np.maximum(inside, 0.0)), -np.inf)
