"""Who plays: the shapes, colours and manners of the built-in faces."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..core.arrays import FloatArray
from .chart import MOUTH
from .paint import Palette
from .sculpt import Sculpture, Shape

ACTOR = Sculpture(Shape())
HUMAN = Palette(skin=(0.74, 0.60, 0.52), lip=(0.62, 0.36, 0.33), brow=(0.22, 0.15, 0.11))

APE = Sculpture(
    Shape(
        scale=9.0,
        brow=3.0,
        socket=1.15,
        cheekbone=0.9,
        hollow=0.3,
        nose=0.30,
        nose_width=1.50,
        muzzle=1.9,
        lips=0.7,
        chin=0.1,
        profile=(
            (1.50, -0.22, -0.40, 0.90),
            (1.05, -0.17, -0.34, 0.90),
            (0.60, -0.08, -0.14, 0.94),
            (0.25, 0.0, 0.03, 1.0),
            (0.0, 0.0, 0.0, 1.0),
            (-0.4, -0.02, 0.05, 1.0),
            (-0.75, -0.08, 0.17, 1.06),
            (-1.1, -0.14, 0.24, 1.18),
            (-1.5, -0.15, 0.18, 1.18),
            (-1.8, -0.10, 0.06, 1.12),
            (-2.5, 0.0, 0.0, 1.1),
        ),
    )
)
FUR = Palette(skin=(0.30, 0.215, 0.17), lip=(0.27, 0.155, 0.14), brow=(0.10, 0.07, 0.06))
APE_MANNER = {"zygomatic": 0.8, "jaw": 1.15, "levator": 1.2, "frontalis_outer": 0.8, "pucker": 1.4}

SKULL = Sculpture(
    Shape(
        scale=0.06,
        brow=1.5,
        socket=1.75,
        cheekbone=2.3,
        hollow=4.2,
        temple=2.2,
        nose=0.5,
        nose_width=0.85,
        lips=0.4,
        chin=1.4,
        profile=(
            (1.50, 0.22, 0.02, 1.18),
            (1.05, 0.18, 0.02, 1.16),
            (0.55, 0.08, 0.03, 1.10),
            (0.0, 0.0, 0.0, 1.0),
            (-0.6, 0.04, -0.04, 0.92),
            (-1.1, 0.08, -0.04, 0.80),
            (-1.7, 0.06, 0.0, 0.72),
            (-2.5, 0.06, -0.05, 0.66),
        ),
    )
)
BONE = Palette(skin=(0.74, 0.70, 0.60), lip=(0.60, 0.50, 0.42), brow=(0.66, 0.60, 0.50))
SKULL_MANNER = {"zygomatic": 1.2, "risorius": 1.2, "jaw": 1.1, "frontalis_inner": 0.8, "corrugator": 1.1}

CHILD = Sculpture(
    Shape(
        scale=1.0,
        brow=0.25,
        socket=0.65,
        cheekbone=0.45,
        hollow=-0.5,
        temple=0.4,
        nose=0.62,
        nose_width=0.95,
        muzzle=0.9,
        lips=1.5,
        chin=0.5,
        profile=(
            (1.50, 0.16, 0.02, 1.18),
            (1.05, 0.16, 0.13, 1.16),
            (0.55, 0.07, 0.13, 1.10),
            (0.0, 0.0, 0.0, 1.04),
            (-0.6, 0.10, 0.0, 1.06),
            (-1.1, 0.24, -0.02, 1.06),
            (-1.7, 0.44, -0.06, 0.96),
            (-2.5, 0.50, -0.05, 0.80),
        ),
    )
)
CHERUB = Palette(skin=(0.80, 0.63, 0.52), lip=(0.66, 0.36, 0.32), brow=(0.42, 0.28, 0.16))
CHILD_MANNER = {"jaw": 0.8, "zygomatic": 0.9, "frontalis_inner": 0.9, "corrugator": 0.8, "pucker": 0.9}


def childlike(positions: FloatArray) -> FloatArray:
    """A warp of `CHILD` to a child's proportions, that cannot fold: large eyes, a small mouth, 40 times the size.

    Around each of three places everything is drawn apart or together, less and less with the distance.
    """
    drawn = np.array(positions, np.float64)
    mouth = CHILD.surface(np.array([[MOUTH.x, MOUTH.y]]))[0]
    for centre, growth, reach in (
        (CHILD.eye_centre(1.0), 0.42, 0.50),
        (CHILD.eye_centre(-1.0), 0.42, 0.50),
        (mouth, -0.30, 0.60),
    ):
        away = positions - centre
        drawn += growth * away * np.exp(-(away**2).sum(axis=-1, keepdims=True) / reach**2)
    return 40.0 * drawn


def smooth_warp(rng: np.random.Generator) -> Callable[[FloatArray], FloatArray]:
    """A warp of space that changes proportions and bends, and cannot fold.

    It adds six waves to a stretch; their gradients add up to less than the smallest stretch.
    """
    stretch = np.array([1.12, 0.92, 1.05])
    waves = rng.normal(size=(6, 3))
    waves *= 2.2 / np.linalg.norm(waves, axis=1, keepdims=True)
    ways = rng.normal(size=(6, 3))
    ways *= 0.03 / np.linalg.norm(ways, axis=1, keepdims=True)
    phases = rng.uniform(0, 2 * np.pi, 6)

    def warp(positions: FloatArray) -> FloatArray:
        warped: FloatArray = positions * stretch + np.sin(positions @ waves.T + phases) @ ways
        return warped

    return warp
