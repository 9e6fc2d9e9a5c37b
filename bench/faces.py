"""The faces that the bench works on: built-in ones of the sizes that the bounds name."""

from __future__ import annotations

from functools import cache

import numpy as np

from facial_retarget_addon import demo
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.problem import Face, Problem

SOURCE_VERTICES, TARGET_VERTICES, POINTS = 26_000, 20_000, 100


@cache
def pair() -> tuple[demo.DemoFace, demo.DemoFace]:
    """The actor with about 26 000 vertices and its known-truth warp with about 20 000."""
    return demo.actor(vertices=SOURCE_VERTICES), demo.warped_actor(np.random.default_rng(3), vertices=TARGET_VERTICES)


def problem() -> Problem:
    """The pair with 100 points and no examples."""
    source, target = pair()
    names = source.face.points.names[:POINTS]
    return Problem(*(Face(face.face.mesh, _only(face.face.points, names)) for face in (source, target)))


def _only(points: FeaturePoints, names: tuple[str, ...]) -> FeaturePoints:
    return points.subset(names)
