"""Smooth building blocks of relief and of zones: bells, steps, cushions, fillets."""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray


def bell(t: FloatArray, width: FloatArray | float) -> FloatArray:
    """1 at 0, 1/e at `width`."""
    height: FloatArray = np.exp(-((t / width) ** 2))
    return height


def blob(
    x: FloatArray, y: FloatArray, at_x: float, at_y: float, width: float, height: float, turn: float = 0.0
) -> FloatArray:
    """A bell of height 1, 1/e at `width` and `height` from its middle, turned counter-clockwise by radians."""
    dx, dy = x - at_x, y - at_y
    cosine, sine = np.cos(turn), np.sin(turn)
    return bell(cosine * dx + sine * dy, width) * bell(cosine * dy - sine * dx, height)


def dome(t: FloatArray, power: float) -> FloatArray:
    """exp(-t^power) of a squared distance: a bell with a flatter top and steeper sides as power grows."""
    height: FloatArray = np.exp(-(t**power))
    return height


def step(t: FloatArray, start: FloatArray | float, end: FloatArray | float) -> FloatArray:
    """Smoothly 0 before start, 1 after end (either way round)."""
    s = np.clip((t - start) / (end - start), 0.0, 1.0)
    rise: FloatArray = s * s * s * (s * (6 * s - 15) + 10)
    return rise


def along(t: FloatArray, start: float, end: float, soft: float) -> FloatArray:
    """1 from start to end, falling off over `soft` on both sides."""
    return step(t, start - soft, start + soft) * (1.0 - step(t, end - soft, end + soft))


def cushion(s: FloatArray) -> FloatArray:
    """1 at 0, flat; 0 from 1 on."""
    height: FloatArray = (1.0 - np.clip(s, 0.0, 1.0) ** 2) ** 1.5
    return height


def roll(distance: FloatArray, radius: float) -> FloatArray:
    """A quarter round: 0 beyond `radius` from the rim, 1 on it."""
    s = np.clip(1.0 - distance / radius, 0.0, 1.0)
    depth: FloatArray = 1.0 - np.sqrt(np.maximum(1.0 - s**2, 0.0))
    return depth


def smooth_max(a: FloatArray, b: FloatArray, soft: float) -> FloatArray:
    """The larger one, with a fillet of width `soft` where they meet."""
    larger: FloatArray = 0.5 * (a + b + np.sqrt((a - b) ** 2 + soft**2))
    return larger
