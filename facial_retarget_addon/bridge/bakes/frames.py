"""Frames to shape keys, one for each: relative ones that are shown on their frames, or absolute ones on one curve."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from bpy.types import Action, Object

from ...core.arrays import FloatArray
from ...core.errors import RetargetError
from ...guide import FRAME_NAMES
from ..curves import ensure_curves, find_curves, remove_curves, write_curve
from ..heads import Head
from ..key_sets import key_names
from ..meshes import from_face_space
from ..shape_keys import ensure_basis, ensure_key, remove_keys, value_path, write_key
from .names import baked_keys, frame_key_name, record_bake

STILL = 1e-6
"""Motion of a part below this share of the head's size is none."""


def write_frames(
    thing: Object, frames: FloatArray, first: int, pattern: str = FRAME_NAMES, absolute: bool = False
) -> None:
    """Bake frames as shape keys of an object; an earlier bake is replaced.

    Parameters
    ----------
    frames : (F, V, 3) float32 positions in face space.
    first : the scene frame of the first, the others follow one by one.
    pattern, absolute : as `write_head_frames`.

    Raises
    ------
    RetargetError : if the frames have another number of vertices than the object, or as `write_head_frames`.
    """
    times = range(first, first + len(frames))
    _check_count(thing, frames)
    _write_own(thing, from_face_space(thing, frames), times, pattern, absolute, None)


def write_head_frames(
    head: Head, frames: FloatArray, times: Sequence[float], pattern: str = FRAME_NAMES, absolute: bool = False
) -> None:
    """Bake frames (F, V, 3) of a head on its face and on each part that they move; an earlier bake is replaced.

    All objects share the action of the face, in which each has its slot.

    Parameters
    ----------
    times : (F,) scene frames, at equal steps.
    pattern : of the keys' names; see `frame_key_name`.
    absolute : one evaluation-time curve plays the keys, much faster; else each key is on at its own frame only.

    Raises
    ------
    RetargetError : for a bad pattern; if an object has shape keys of its own, which absolute ones would turn off.
    """
    moved = check_frames(head, frames, times, pattern, absolute)
    face, action = head.things[0], None
    for thing in head.things:
        if thing not in moved:
            remove_bake(thing)
    for thing, own in moved.items():
        _write_own(thing, own_positions(head, thing, frames[:, own]), times, pattern, absolute, action)
        action = face.data.shape_keys.animation_data.action


def check_frames(
    head: Head, frames: FloatArray, times: Sequence[float], pattern: str, absolute: bool
) -> dict[Object, slice]:
    """RetargetError if `write_head_frames` would refuse; else what `moved_objects` finds."""
    _check_count(head.things[0], frames[:, : head.starts[1]])
    moved = moved_objects(head, frames)
    for thing in moved:
        _check_own_keys(thing, absolute)
    for time in (times[0], times[-1]):
        frame_key_name(pattern, time)
    return moved


def own_positions(head: Head, thing: Object, frames: FloatArray) -> FloatArray:
    """(F, v, 3) in own coordinates: an object whose vertices stand at frames (F, v, 3) of the head."""
    row = head.things.index(thing)
    if row == 0:
        return from_face_space(thing, frames)
    rest = head.face.mesh.vertices[head.starts[row] : head.starts[row + 1]]
    return head.positions(thing, frames - rest.astype(np.float32))


def time_step(times: Sequence[float]) -> float:
    """Scene frames from one of some equally spaced times to the next; 1 for a single one."""
    return times[1] - times[0] if len(times) > 1 else 1


def moved_objects(head: Head, frames: FloatArray) -> dict[Object, slice]:
    """The face, and each part that frames (F, V, 3) move -> its vertices among the head's."""
    slices = list(head.slices())
    moved = {slices[0][0]: slices[0][1]}
    for thing, own, _ in slices[1:]:
        moves = frames[:, own] - head.face.mesh.vertices[own].astype(np.float32)
        if np.abs(moves).max(initial=0.0) > STILL * head.face.mesh.size:
            moved[thing] = own
    return moved


def _check_count(thing: Object, frames: FloatArray) -> None:
    if frames.shape[1] != len(thing.data.vertices):
        raise RetargetError(
            f"frames of {frames.shape[1]} vertices arrived for object {thing.name!r}, "
            f"expected its {len(thing.data.vertices)}"
        )


def _check_own_keys(thing: Object, absolute: bool) -> None:
    own = [name for name in key_names(thing) if name not in baked_keys(thing)]
    if absolute and own:
        raise RetargetError(
            f"object {thing.name!r} has shape keys of its own, {own[0]!r} among them, which absolute keys would turn "
            "off; expected another kind of bake"
        )


def _write_own(
    thing: Object,
    positions: FloatArray,
    times: Sequence[float],
    pattern: str,
    absolute: bool,
    shared: Action | None,
) -> None:
    """Bake positions (F, V, 3) in own coordinates; curves go into a slot of `shared` where there is no action yet."""
    names = [frame_key_name(pattern, time) for time in times]
    ensure_basis(thing)
    remove_bake(thing, keep=set(names))
    for name, places in zip(names, positions, strict=True):
        write_key(ensure_key(thing, name), places)
    keys = thing.data.shape_keys
    keys.use_relative = not absolute
    bag = ensure_curves(keys, f"{keys.name} retargeted", shared)
    if absolute:
        # Blender spaces absolute keys by adding up tenths: what each one's moment came to is read back.
        moments = [keys.key_blocks[name].frame for name in names]
        write_curve(bag, "eval_time", np.array(times, float), np.array(moments))
    else:
        step = time_step(times)
        for time, name in zip(times, names, strict=True):
            # On at its own frame, off at the two beside it.
            write_curve(bag, value_path(name), np.array([time - step, time, time + step]), np.array([0, 1, 0]))
    record_bake(thing, names)
    thing.data.update()


def remove_bake(thing: Object, keep: set[str] = frozenset()) -> None:
    """Remove the shape keys of an earlier bake, but not those to keep, and the curves of all of them."""
    keys = thing.data.shape_keys
    if keys is None:
        return
    baked = baked_keys(thing)
    bag = find_curves(keys)
    if bag is not None:
        remove_curves(bag, {value_path(name) for name in baked} | ({"eval_time"} if baked else set()))
    remove_keys(thing, [name for name in baked if name not in keep])
    if baked:
        keys.use_relative = True
