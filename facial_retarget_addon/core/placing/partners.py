"""Where the partner of a point lies on the other half of a face: across a plane, then as the known pairs differ."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray
from .symmetry import Mirror
from .template import partner

REACH = 0.4
"""How far the difference of a known pair from mirror images reaches, in eye separations."""
EXACT = 0.02
"""How exactly known pairs are followed, as a share of how much halves differ."""


def closest_mirror(mirrors: Sequence[Mirror], where: dict[str, FloatArray]) -> Mirror:
    """The plane that takes the known points (name -> (3,)) nearest to their partners; the first one without any."""

    def misfit(mirror: Mirror) -> float:
        here, there = _pairs(where, "")
        return float(np.linalg.norm(mirror.apply(here) - there, axis=1).sum()) if len(here) else 0.0

    return min(mirrors, key=misfit)


def across(mirror: Mirror, where: dict[str, FloatArray], name: str, unit: float) -> FloatArray:
    """(3,) the place across from a known point.

    Its mirror image, moved as the mirror images of the known points around it differ from their partners. The partner
    that the point may have already does not count.

    Parameters
    ----------
    where : name -> (3,) of the known points.
    unit : one eye separation.
    """
    image = mirror.apply(where[name][None])
    here, there = _pairs(where, name)
    if not len(here):
        return np.asarray(image[0])
    images = mirror.apply(here)
    system = _nearness(images, images, unit) + EXACT * np.eye(len(images))
    moved: FloatArray = image + _nearness(image, images, unit) @ np.linalg.solve(system, there - images)
    return np.asarray(moved[0])


def _pairs(where: dict[str, FloatArray], but: str) -> tuple[FloatArray, FloatArray]:
    """(N, 3) known points and (N, 3) their partners; those of the middle line are their own."""
    names = [name for name in where if partner(name) in where and but not in (name, partner(name))]
    here = np.array([where[name] for name in names]).reshape(-1, 3)
    return here, np.array([where[partner(name)] for name in names]).reshape(-1, 3)


def _nearness(first: FloatArray, second: FloatArray, unit: float) -> FloatArray:
    squared = ((first[:, None] - second) ** 2).sum(axis=2)
    near: FloatArray = np.exp(-squared / (2 * (REACH * unit) ** 2))
    return near
