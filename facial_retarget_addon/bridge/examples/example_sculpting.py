"""An example's shape key in Sculpt Mode, and everything as it was afterwards."""

from __future__ import annotations

import bpy
from bpy.types import Context, Object

from ...core.errors import RetargetError
from ..heads import head_parts
from ..key_sets import check_editable
from ..performance import is_shown
from ..points.geometry_watch import changed
from ..shape_keys import ensure_key, find_key


def start_sculpting(context: Context, name: str, side: str) -> Object:
    """Enter Sculpt Mode on an example's shape key, made if it is missing, shown alone and in full.

    Parameters
    ----------
    side : SOURCE or TARGET. The face object is sculpted, or the active object if it is a part of that head.

    Returns
    -------
    The object that is sculpted; `stop_sculpting` gives back what was.

    Raises
    ------
    RetargetError : if the object is hidden or linked, has absolute or locked keys, or Multires takes the strokes.
    """
    task = context.scene.facial_retarget
    stop_sculpting(context)
    face = task.source if side == "SOURCE" else task.target
    before = context.view_layer.objects.active
    thing = before if before in head_parts(face) else face
    _check(thing, name, context)
    sculpting = task.sculpting
    sculpting.thing, sculpting.example, sculpting.side, sculpting.before = thing, name, side, before
    ensure_key(thing, name)
    sculpting.key, sculpting.pinned = thing.active_shape_key.name, thing.show_only_shape_key
    context.view_layer.objects.active = thing
    thing.active_shape_key_index = thing.data.shape_keys.key_blocks.find(name)
    thing.show_only_shape_key = True
    bpy.ops.object.mode_set(mode="SCULPT")
    return thing


def stop_sculpting(context: Context) -> None:
    """Leave Sculpt Mode, and give back the pin, the active shape key and the active object that were before."""
    sculpting = context.scene.facial_retarget.sculpting
    thing, before, objects = sculpting.thing, sculpting.before, context.view_layer.objects
    there = thing is not None and objects.get(thing.name) == thing
    if there and thing.mode == "SCULPT":
        objects.active = thing
        bpy.ops.object.mode_set(mode="OBJECT")
        # Undoing back to a stroke, Blender enters Sculpt Mode on whatever is active, and restores nothing else: the
        # step before the stroke must have all as it was in Sculpt Mode.
        bpy.ops.ed.undo_push(message="Leave Sculpt Mode")
    sculpting.thing = sculpting.before = None
    changed()
    if not there:
        return
    thing.show_only_shape_key = sculpting.pinned
    if find_key(thing, sculpting.key) is not None:
        thing.active_shape_key_index = thing.data.shape_keys.key_blocks.find(sculpting.key)
    if before is not None and objects.get(before.name) == before:
        objects.active = before


def _check(thing: Object, name: str, context: Context) -> None:
    check_editable(thing)
    if not is_shown(thing, context.view_layer):
        raise RetargetError(f"object {thing.name!r} is hidden, expected it visible to be sculpted")
    takers = [modifier.name for modifier in thing.modifiers if modifier.type == "MULTIRES" and modifier.total_levels]
    if takers:
        raise RetargetError(
            f"object {thing.name!r} has the Multires modifier {takers[0]!r}, which takes the strokes, "
            "expected one whose shape keys can be sculpted"
        )
    key = find_key(thing, name)
    if key is not None and key.lock_shape:
        raise RetargetError(f"shape key {name!r} of object {thing.name!r} is locked, expected it unlocked")
