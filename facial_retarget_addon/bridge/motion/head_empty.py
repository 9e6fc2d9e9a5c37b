"""The turn of the head, FAPs 48 to 50, as the rotation of an empty."""

from __future__ import annotations

import bpy
import numpy as np
from bpy.types import Depsgraph, Object
from mathutils import Matrix, Vector

from ...core.acting.fap_face import FapFace
from ...core.arrays import FloatArray
from ...core.mpeg4.fapu import ANGLE
from ..curves import ensure_curves, find_curves, remove_curves, write_curve
from ..meshes import from_face_space, stretch

ORDER = "ZXY"
"""Blender's name for rolling first, then pitching, then yawing: R = Ry Rx Rz."""
PATH = "rotation_euler"


def find_head(thing: Object) -> Object | None:
    """A face's empty, unless the artist has deleted it: the face alone keeps it then."""
    empty = thing.facial_retarget.head
    return empty if empty is not None and empty.users_collection else None


def write_head(thing: Object, face: FapFace, frames: FloatArray, values: FloatArray, group: str) -> Object:
    """Turn a face's empty by FAPs 48 to 50 (F, 3) at scene frames (F,); it is made and placed if there is none."""
    empty = find_head(thing) or _place(thing, face)
    bag = ensure_curves(empty, f"{empty.name} motion")
    remove_curves(bag, {PATH})
    for index, angles in enumerate(values.T * ANGLE):
        write_curve(bag, PATH, frames, angles, index, group)
    return empty


def clear_head(thing: Object) -> None:
    """Take the motion off a face's empty."""
    empty = find_head(thing)
    bag = find_curves(empty) if empty is not None else None
    if bag is not None:
        remove_curves(bag, {PATH})
        empty.rotation_euler = (0.0, 0.0, 0.0)


def read_head(thing: Object, depsgraph: Depsgraph) -> FloatArray:
    """(3,) FAPs 48 to 50 that a face's empty shows now; 0 without one."""
    empty = find_head(thing)
    return np.zeros(3) if empty is None else np.array(empty.evaluated_get(depsgraph).rotation_euler) / ANGLE


def _place(thing: Object, face: FapFace) -> Object:
    """A new empty where the head turns, at rest along the head's axes: these are its delta rotation."""
    empty = bpy.data.objects.new(f"{thing.name} head", None)
    for collection in thing.users_collection:
        collection.objects.link(empty)
    empty.empty_display_type = "ARROWS"
    empty.rotation_mode = ORDER
    world = np.array(thing.matrix_world, np.float64)[:3, :3]
    turn = world @ np.linalg.inv(stretch(thing))
    scale = np.cbrt(np.linalg.det(turn))
    empty.empty_display_size = float(0.5 * scale * face.mesh.size)
    empty.location = thing.matrix_world @ Vector(from_face_space(thing, face.head_pivot))
    empty.delta_rotation_euler = Matrix((turn / scale) @ face.axes.T).to_euler(ORDER)
    thing.facial_retarget.head = empty
    return empty
