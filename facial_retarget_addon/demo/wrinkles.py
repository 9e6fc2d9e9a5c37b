"""Wrinkles that rise as skin is pushed together: heights on the chart, and the contractions that raise them."""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray
from .muscles import SIDES, column
from .smooth import along, bell, step

_RAISED_BY: tuple[tuple[str, ...], ...] = (
    ("frontalis_inner_l", "frontalis_outer_l"),
    ("frontalis_inner_r", "frontalis_outer_r"),
    ("squint_l", "zygomatic_l"),
    ("squint_r", "zygomatic_r"),
    ("zygomatic_l", "levator_l", "nasalis_l"),
    ("zygomatic_r", "levator_r", "nasalis_r"),
    ("corrugator_l", "corrugator_r"),
    ("levator_l", "levator_r", "nasalis_l", "nasalis_r"),
)
"""The contractions that raise each field of `wrinkle_fields`."""


def tension(table: FloatArray) -> FloatArray:
    """How far contractions (F, A) raise each wrinkle field, (F, W): skin folds late, and not without end."""
    pushed = np.stack([table[:, [column(name) for name in names]].sum(axis=1) for names in _RAISED_BY], axis=1)
    pushed = np.maximum(pushed, 0.0)
    raised: FloatArray = pushed**2 / (0.5 + pushed)
    return raised


def wrinkle_fields(places: FloatArray) -> FloatArray:
    """Heights (W, N), in eye separations, at chart places (N, 2); wavelengths are 3 to 4 % of the face's width."""
    x, y = places.T
    sides = [sign * x for sign in SIDES.values()]
    return np.stack(
        [
            *(_forehead(here, y) for here in sides),
            *(_crows_feet(here, y) for here in sides),
            *(_nasolabial_fold(here, y) for here in sides),
            _frown_lines(x, y),
            _nose_root(x, y),
        ]
    )


def _forehead(x: FloatArray, y: FloatArray) -> FloatArray:
    """Lines across one half of the forehead; the halves add up to whole lines."""
    window = step(x, -0.2, 0.2) * (1.0 - step(x, 0.66, 0.98)) * along(y, 0.42, 0.88, 0.09)
    uneven = (1.0 - 0.4 * np.sin(4.0 * x + 9.0 * y) ** 2) * (1.0 - 0.5 * step(y, 0.5, 0.95))
    arch = y + 0.010 * np.cos(2 * np.pi * x / 1.3) + 0.05 * x**2
    return np.asarray(0.0085 * window * uneven * _folds(arch, 0.088))


def _crows_feet(x: FloatArray, y: FloatArray) -> FloatArray:
    """Rays from the outer corner of the eye."""
    dx, dy = x - 0.70, y + 0.01
    angle = np.arctan2(dy, dx)
    window = along(np.hypot(dx, dy), 0.15, 0.34, 0.06) * (1.0 - step(np.abs(angle + 0.05), 0.55, 0.95))
    return 0.0065 * window * _folds(angle, 0.33)


def _nasolabial_fold(x: FloatArray, y: FloatArray) -> FloatArray:
    """A furrow from the nose wing past the corner of the mouth, with the cheek standing over it."""
    line = 0.33 + 0.42 * (-0.60 - y) + 0.10 * (y + 0.60) ** 2
    across = (x - line) / 0.065
    window = along(-y, 0.60, 1.05, 0.10) * step(x, 0.15, 0.25)
    return np.asarray(0.022 * window * across * np.exp(0.5 - across**2))


def _frown_lines(x: FloatArray, y: FloatArray) -> FloatArray:
    """Two upright furrows between the brows."""
    return 0.010 * bell(x, 0.085) * along(y, 0.16, 0.40, 0.08) * _folds(x, 0.088)


def _nose_root(x: FloatArray, y: FloatArray) -> FloatArray:
    """Lines across the root of the nose."""
    return 0.005 * bell(x, 0.17) * along(y, -0.16, 0.08, 0.06) * _folds(y + 0.5 * x**2, 0.07)


def _folds(t: FloatArray, wavelength: float) -> FloatArray:
    """Ridges with narrower furrows, band-limited to twice the base frequency."""
    phase = 2 * np.pi * t / wavelength
    return np.asarray(np.cos(phase) - 0.25 * np.cos(2 * phase))
