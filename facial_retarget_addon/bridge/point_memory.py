"""The points of an object as they were, to go back to: what Esc does."""

from __future__ import annotations

from typing import NamedTuple

from bpy.types import Object

StoredPoint = tuple[str, tuple[int, ...], tuple[float, ...]]


class PointMemory(NamedTuple):
    """Placed and proposed points, skipped names, and the row of the active point."""

    points: list[StoredPoint]
    proposals: list[StoredPoint]
    skipped: list[str]
    active: int


def remember_points(thing: Object) -> PointMemory:
    """The points of an object as they are."""
    face = thing.facial_retarget
    points, proposals = (
        [(point.name, tuple(point.vertices), tuple(point.weights)) for point in stored]
        for stored in (face.points, face.proposals)
    )
    return PointMemory(points, proposals, face.skipped.keys(), face.active_point)


def put_back_points(thing: Object, memory: PointMemory) -> None:
    """Give an object the points that it had, bit by bit."""
    face = thing.facial_retarget
    for stored, kept in ((face.points, memory.points), (face.proposals, memory.proposals)):
        stored.clear()
        for name, vertices, weights in kept:
            point = stored.add()
            point.name, point.vertices, point.weights = name, vertices, weights
    face.skipped.clear()
    for name in memory.skipped:
        face.skipped.add().name = name
    face.active_point = memory.active
