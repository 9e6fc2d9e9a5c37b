"""The points of an object as they were, to go back to: what Esc does."""

from __future__ import annotations

from typing import Any, NamedTuple

from bpy.types import Object, PropertyGroup

FIELDS = ("name", "vertices", "weights", "topology", "anchored", "anchor", "anchor_normal", "doubt")
"""All that a stored point knows of itself."""

StoredPoint = dict[str, Any]


class PointMemory(NamedTuple):
    """Placed and proposed points, skipped names, and the row of the active point."""

    points: list[StoredPoint]
    proposals: list[StoredPoint]
    skipped: list[str]
    active: int


def remember_points(thing: Object) -> PointMemory:
    """The points of an object as they are."""
    face = thing.facial_retarget
    points, proposals = ([_kept(point) for point in stored] for stored in (face.points, face.proposals))
    return PointMemory(points, proposals, face.skipped.keys(), face.active_point)


def put_back_points(thing: Object, memory: PointMemory) -> None:
    """Give an object the points that it had, bit by bit."""
    face = thing.facial_retarget
    for stored, kept in ((face.points, memory.points), (face.proposals, memory.proposals)):
        stored.clear()
        for values in kept:
            point = stored.add()
            for field, value in values.items():
                setattr(point, field, value)
    face.skipped.clear()
    for name in memory.skipped:
        face.skipped.add().name = name
    face.active_point = memory.active


def _kept(point: PropertyGroup) -> StoredPoint:
    values = {field: getattr(point, field) for field in FIELDS}
    return {field: value if isinstance(value, str | bool) else tuple(value) for field, value in values.items()}
