"""What each level of a motion adds, as an object beside the target with a slider for each."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
from bpy.types import Object
from mathutils import Matrix

from ...core.level_retargeter import LevelMotion
from ..meshes import from_face_space, name_beside, new_object, read_polygons, read_positions
from ..shape_keys import ensure_key, write_key

BESIDE = 1.2
"""Widths of the target that the object stands away from it."""
MOST = 4.0
"""A slider goes so far, like the gains of the levels."""


def show_levels(thing: Object, levels: Sequence[LevelMotion]) -> Object:
    """Show what levels add to one frame of an object: all sliders at 1 are the whole frame.

    An object made before is taken away, and the new one stands in its place.

    Parameters
    ----------
    levels : displacements (1, V, 3) in face space, the object's own vertices first.
    """
    label = name_beside(thing, " levels")
    step = Matrix.Translation((BESIDE * thing.dimensions.x, 0, 0))
    place = step @ thing.matrix_world
    before = bpy.data.objects.get(label)
    if before is not None and before.type == "MESH":
        place = before.matrix_world.copy()
        bpy.data.meshes.remove(before.data)
    neutral = read_positions(thing.data)
    made = new_object(label, neutral, *read_polygons(thing.data))
    made.data.shade_smooth()
    made.matrix_world = place
    for level in levels:
        key = ensure_key(made, level.name)
        write_key(key, neutral + from_face_space(thing, level.displacements[0, : len(neutral)]))
        key.slider_max, key.value = MOST, 1.0
    made.data.update()
    return made
