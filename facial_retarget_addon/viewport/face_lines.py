"""A face seen from the front as lines, in the coordinates of `core.point_sets`: eye separations, y up."""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray

STEPS = 6
"""Pieces of the curve between two of its places."""

_Places = tuple[tuple[float, float], ...]

_HALF_OUTLINE: _Places = (
    *((0.0, 1.36), (0.45, 1.30), (0.92, 1.02), (1.22, 0.58), (1.33, 0.05), (1.35, -0.35), (1.32, -0.80)),
    *((1.22, -1.20), (0.97, -1.47), (0.62, -1.66), (0.30, -1.76), (0.0, -1.79)),
)
_OUTLINE: _Places = (*((-x, y) for x, y in _HALF_OUTLINE[:0:-1]), *_HALF_OUTLINE[:-1], _HALF_OUTLINE[-1])
_NOSE: _Places = (
    *((0.135, -0.05), (0.15, -0.28), (0.20, -0.47), (0.285, -0.58), (0.27, -0.69), (0.16, -0.70), (0.0, -0.745)),
    *((-0.16, -0.70), (-0.27, -0.69), (-0.285, -0.58), (-0.20, -0.47), (-0.15, -0.28), (-0.135, -0.05)),
)
_MOUTH: tuple[_Places, ...] = (
    ((-0.43, -1.10), (-0.25, -1.0), (-0.085, -0.945), (0.0, -0.97), (0.085, -0.945), (0.25, -1.0), (0.43, -1.10)),
    ((-0.43, -1.10), (-0.25, -1.20), (0.0, -1.24), (0.25, -1.20), (0.43, -1.10)),
    ((-0.43, -1.10), (-0.19, -1.09), (0.0, -1.10), (0.19, -1.09), (0.43, -1.10)),
)
_LEFT: tuple[_Places, ...] = (
    ((0.29, -0.005), (0.385, 0.06), (0.525, 0.095), (0.665, 0.06), (0.76, -0.005)),
    ((0.29, -0.005), (0.385, -0.047), (0.525, -0.07), (0.665, -0.047), (0.76, -0.005)),
    ((0.20, 0.21), (0.41, 0.28), (0.63, 0.305), (0.90, 0.19)),
    ((1.34, 0.06), (1.45, 0.13), (1.49, -0.03), (1.43, -0.36), (1.35, -0.47)),
    ((0.64, -1.66), (0.62, -2.0), (0.72, -2.25)),
)
"""Lids, brow, ear and neck of the subject's left half."""
_IRIS: _Places = tuple(
    (0.525 + 0.075 * float(np.cos(angle)), 0.015 + 0.075 * float(np.sin(angle)))
    for angle in np.linspace(0, 2 * np.pi, 9)
)


def face_lines() -> list[FloatArray]:
    """Polylines (n, 2) of the face."""
    halves = (*_LEFT, _IRIS)
    mirrored = tuple(tuple((-x, y) for x, y in places) for places in halves)
    return [smooth_line(np.array(places)) for places in (_OUTLINE, _NOSE, *_MOUTH, *halves, *mirrored)]


def smooth_line(places: FloatArray) -> FloatArray:
    """A smooth polyline through places (n, 2); closed where the last is the first.

    Catmull and Rom 1974, uniform.
    """
    closed = bool(np.array_equal(places[0], places[-1]))
    before = places[-2] if closed else 2 * places[0] - places[1]
    after = places[1] if closed else 2 * places[-1] - places[-2]
    control = np.concatenate([[before], places, [after]])
    t = np.linspace(0, 1, STEPS, endpoint=False)[:, None]
    pieces = []
    for a, b, c, d in zip(control, control[1:], control[2:], control[3:], strict=False):
        pieces.append(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * (b - c) + d - a) * t**3))
    return np.concatenate([*pieces, places[-1:]])
