"""What a fit of the live preview came from, as sums that tell whether it has changed since."""

from __future__ import annotations

from zlib import crc32

import numpy as np
from bpy.types import Object, PropertyGroup

from ..heads import head_parts
from ..meshes import read_positions
from ..shape_keys import find_key


def origin_of(task: PropertyGroup) -> dict[str, int]:
    """A sum of each thing that all methods' fits come from, by what the artist calls it."""
    heads = [whole_head(task.source), whole_head(task.target)]
    return {
        "meshes": hash(tuple(_mesh_sum(thing) for things in heads for thing in things)),
        "points": hash(tuple(_point_sum(thing) for things in heads for thing in things)),
        "parts": hash(tuple((part.thing, part.role) for things in heads for part in things[0].facial_retarget.parts)),
        "examples": hash(
            tuple(_key_sum(thing, example.name) for example in task.examples for things in heads for thing in things)
        ),
        "base mesh": 0 if task.base is None else _mesh_sum(task.base),
        "neutral": hash((task.source_neutral, task.neutral_frame)),
    }


def whole_head(face: Object) -> tuple[Object, ...]:
    """A face and its parts."""
    return (face, *head_parts(face))


def _mesh_sum(thing: Object) -> int:
    mesh = thing.data
    return crc32(read_positions(mesh), len(mesh.polygons))


def _point_sum(thing: Object) -> int:
    points = thing.facial_retarget.points
    return hash(tuple((point.name, *point.vertices, *point.weights) for point in points))


def _key_sum(thing: Object, name: str) -> int:
    key = find_key(thing, name)
    if key is None:
        return 0
    flat = np.empty(3 * len(key.points), np.float32)
    key.points.foreach_get("co", flat)
    return hash((name, crc32(flat)))
