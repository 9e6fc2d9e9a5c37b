"""Frames to shape keys with their animation."""

from __future__ import annotations

import re

import bpy
import numpy as np
from bpy.types import ActionChannelbag, Key, Object, ShapeKey
from bpy.utils import escape_identifier

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from .meshes import from_face_space

LINEAR = 1  # a keyframe's interpolation, as the number that foreach_set wants


def key_name(frame: int) -> str:
    """Name of the shape key of a frame."""
    return f"frame_{frame:04d}"


def write_frames(thing: Object, frames: FloatArray, first: int) -> None:
    """Bake frames as relative shape keys, each on at its own frame only; an earlier bake is replaced.

    Parameters
    ----------
    frames : (F, V, 3) float32 positions in face space.
    first : the scene frame of the first.

    Raises
    ------
    RetargetError : if the frames have another number of vertices than the object.
    """
    if frames.shape[1] != len(thing.data.vertices):
        raise RetargetError(
            f"frames of {frames.shape[1]} vertices arrived for object {thing.name!r}, "
            f"expected its {len(thing.data.vertices)}"
        )
    positions = np.ascontiguousarray(from_face_space(thing, frames), np.float32).reshape(len(frames), -1)
    names = [key_name(first + i) for i in range(len(frames))]
    ensure_basis(thing)
    _remove_bake(thing, keep=set(names))
    for name, flat in zip(names, positions, strict=True):
        # key.points copies float32 as a block; key.data is two orders slower.
        ensure_key(thing, name).points.foreach_set("co", flat)
    _write_curves(thing.data.shape_keys, names, first)
    thing.data.update()


def ensure_basis(thing: Object) -> ShapeKey:
    """The object's Basis, made if it has no shape keys."""
    if thing.data.shape_keys is None:
        thing.shape_key_add(name="Basis", from_mix=False)
    return thing.data.shape_keys.reference_key


def ensure_key(thing: Object, name: str) -> ShapeKey:
    """The shape key of this name; a new one equals the Basis and has value 0."""
    ensure_basis(thing)
    key = thing.data.shape_keys.key_blocks.get(name)
    if key is None:
        key = thing.shape_key_add(name=name, from_mix=False)
        key.value = 0.0  # from Blender 5.0 a new key starts at 1
    return key


def _remove_bake(thing: Object, keep: set[str]) -> None:
    """Remove the frames of an earlier bake, and the curves of all of them."""
    baked = [key.name for key in thing.data.shape_keys.key_blocks if re.fullmatch(r"frame_-?\d{3,}", key.name)]
    bag = _channelbag(thing.data.shape_keys)
    paths = {value_path(name) for name in baked}
    for curve in [curve for curve in bag.fcurves if curve.data_path in paths]:
        bag.fcurves.remove(curve)
    for name in baked:
        if name not in keep:
            thing.shape_key_remove(thing.data.shape_keys.key_blocks[name])


def value_path(name: str) -> str:
    """Data path of a shape key's value."""
    return f'key_blocks["{escape_identifier(name)}"].value'


def _write_curves(keys: Key, names: list[str], first: int) -> None:
    """One curve per shape key: 1 at its own frame, 0 at the two beside it."""
    bag = _channelbag(keys)
    for frame, name in enumerate(names, start=first):
        curve = bag.fcurves.new(value_path(name))
        curve.keyframe_points.add(3)
        curve.keyframe_points.foreach_set("co", (frame - 1, 0.0, frame, 1.0, frame + 1, 0.0))
        curve.keyframe_points.foreach_set("interpolation", (LINEAR,) * 3)
        curve.update()


def _channelbag(keys: Key) -> ActionChannelbag:
    """Where the curves of shape keys lie: in the action they have, or in a new one.

    Slots and channelbags exist from Blender 4.4; `Action.fcurves` is gone in 5.0.
    """
    animation = keys.animation_data or keys.animation_data_create()
    if animation.action is None:
        animation.action = bpy.data.actions.new(f"{keys.name} retargeted")
    action = animation.action
    if animation.action_slot is None:
        animation.action_slot = action.slots.new(id_type="KEY", name=keys.name)
    layer = action.layers[0] if action.layers else action.layers.new("Layer")
    strip = layer.strips[0] if layer.strips else layer.strips.new(type="KEYFRAME")
    return strip.channelbag(animation.action_slot, ensure=True)
