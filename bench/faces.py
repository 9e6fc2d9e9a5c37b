"""The faces that the bench works on: built-in ones of the sizes that the bounds name."""

from __future__ import annotations

from functools import cache

import numpy as np

from facial_retarget_addon import demo
from facial_retarget_addon.core.mesh import TriMesh
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


@cache
def skin(vertices: int) -> tuple[TriMesh, FeaturePoints]:
    """The actor's skin alone, with at least so many vertices and a few percent more at most, and the points on it."""
    actor = demo.actor(round(1.09 * vertices))
    mesh, points = actor.face.mesh, actor.face.points
    on_skin = mesh.components == mesh.components[0]
    row = np.cumsum(on_skin) - 1
    held = on_skin[points.vertices].all(axis=1)
    names = tuple(name for name, holds in zip(points.names, held, strict=True) if holds)
    faces = mesh.faces[on_skin[mesh.faces].all(axis=1)]
    places = FeaturePoints(names, row[points.vertices[held]], points.weights[held])
    return TriMesh(mesh.vertices[on_skin], row[faces]), places
