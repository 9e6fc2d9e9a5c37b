"""Animation curves, written as blocks."""

from __future__ import annotations

from collections.abc import Collection

import bpy
import numpy as np
from bpy.types import ID, Action, ActionChannelbag, ActionSlot, FCurve

from ..core.arrays import FloatArray

LINEAR = 1  # a keyframe's interpolation, as the number that foreach_set wants


def ensure_curves(animated: ID, name: str, shared: Action | None = None) -> ActionChannelbag:
    """Where the curves of something lie: in the action it has, in a slot of `shared`, or in a new action of this name.

    Slots and channelbags exist from Blender 4.4; `Action.fcurves` is gone in 5.0.
    """
    animation = animated.animation_data or animated.animation_data_create()
    if animation.action is None:
        animation.action = shared or bpy.data.actions.new(name)
        animation.action_slot = None  # Blender may have chosen the slot of another one
    action = animation.action
    if animation.action_slot is None:
        animation.action_slot = action.slots.new(id_type=animated.id_type, name=animated.name)
    return ensure_bag(action, animation.action_slot)


def ensure_bag(action: Action, slot: ActionSlot) -> ActionChannelbag:
    """Where an action's curves of a slot lie, made if they have no place yet."""
    layer = action.layers[0] if action.layers else action.layers.new("Layer")
    strip = layer.strips[0] if layer.strips else layer.strips.new(type="KEYFRAME")
    return strip.channelbag(slot, ensure=True)


def find_bag(action: Action, slot: ActionSlot) -> ActionChannelbag | None:
    """Where an action's curves of a slot lie, if it has any."""
    strips = [strip for layer in action.layers for strip in layer.strips]
    return strips[0].channelbag(slot) if strips else None


def find_curves(animated: ID) -> ActionChannelbag | None:
    """Where the curves of something lie, if it is animated."""
    animation = animated.animation_data
    if animation is None or animation.action is None or animation.action_slot is None:
        return None
    return find_bag(animation.action, animation.action_slot)


def remove_curves(bag: ActionChannelbag, paths: Collection[str]) -> None:
    """Remove every curve of these data paths."""
    for curve in [curve for curve in bag.fcurves if curve.data_path in paths]:
        bag.fcurves.remove(curve)


def write_curve(
    bag: ActionChannelbag, path: str, frames: FloatArray, values: FloatArray, index: int = 0, group: str = ""
) -> FCurve:
    """A new curve through (F,) values at (F,) scene frames, on straight lines, shown in a group."""
    curve = bag.fcurves.new(path, index=index)
    if group:
        curve.group = bag.groups.get(group) or bag.groups.new(group)
    curve.keyframe_points.add(len(frames))
    curve.keyframe_points.foreach_set("co", np.column_stack([frames, values]).astype(np.float32).ravel())
    curve.keyframe_points.foreach_set("interpolation", np.full(len(frames), LINEAR, np.int32))
    curve.update()
    return curve
