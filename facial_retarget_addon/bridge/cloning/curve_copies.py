"""Curves copied from one action to another, with all that they hold. Blender does it by itself from 5.0 on only."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from bpy.types import ActionChannelbag, FCurve, bpy_prop_collection, bpy_struct

from ..curves import LINEAR

NUMBERS = {"co": 2, "handle_left": 2, "handle_right": 2, "amplitude": 1, "back": 1, "period": 1}
"""What a keyframe holds in numbers, and how many of each."""
CHOICES = ("handle_left_type", "handle_right_type", "interpolation", "easing", "type")
"""And what it chooses."""
CURVE = ("auto_smoothing", "color_mode", "color", "extrapolation", "hide", "lock", "mute")


def copy_curve(curve: FCurve, bag: ActionChannelbag, path: str) -> FCurve:
    """A new curve of this data path, like another one: keyframes with their handles, modifiers, group."""
    made = bag.fcurves.new(path, index=curve.array_index)
    if curve.group is not None:
        made.group = bag.groups.get(curve.group.name) or bag.groups.new(curve.group.name)
    copy_properties(curve, made, CURVE)
    copy_keyframes(curve, made)
    for modifier in curve.modifiers:
        copied = made.modifiers.new(modifier.type)
        copy_properties(modifier, copied, _plain(modifier))
        for point in getattr(modifier, "control_points", ()):
            copy_properties(point, copied.control_points.add(point.frame), _plain(point))
    return made


def copy_keyframes(curve: FCurve, made: FCurve) -> None:
    """Give a curve without keyframes those of another one; baked samples become keyframes on straight lines."""
    points = made.keyframe_points
    if len(curve.sampled_points):
        points.add(len(curve.sampled_points))
        points.foreach_set("co", _numbers(curve.sampled_points, "co", 2))
        points.foreach_set("interpolation", np.full(len(points), LINEAR, np.int32))
    else:
        points.add(len(curve.keyframe_points))
        for name in CHOICES:
            choices = np.empty(len(points), np.int32)
            curve.keyframe_points.foreach_get(name, choices)
            points.foreach_set(name, choices)
        for name, size in NUMBERS.items():
            points.foreach_set(name, _numbers(curve.keyframe_points, name, size))
    made.update()


def copy_properties(one: bpy_struct, other: bpy_struct, names: Iterable[str]) -> None:
    """Give one thing some properties of another."""
    for name in names:
        setattr(other, name, getattr(one, name))


def _numbers(points: bpy_prop_collection, name: str, size: int) -> np.ndarray:
    flat = np.empty(size * len(points), np.float32)
    points.foreach_get(name, flat)
    return flat


def _plain(thing: bpy_struct) -> list[str]:
    """Names of the properties that can be set as they are."""
    properties = thing.bl_rna.properties
    return [p.identifier for p in properties if p.type not in ("COLLECTION", "POINTER") and not p.is_readonly]
