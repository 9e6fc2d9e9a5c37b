"""Frames to shape keys, one for each: relative ones that are shown on their frames, or absolute ones on one curve."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from bpy.types import Action, Modifier, Object

from ...core.arrays import FloatArray
from ...core.errors import RetargetError
from ...files.frames import FrameBlocks
from ...guide import FRAME_NAMES
from ..curves import ensure_curves, find_curves, remove_curves, write_curve
from ..heads import Head
from ..key_sets import key_names
from ..meshes import from_face_space
from ..shape_keys import ensure_basis, ensure_keys, remove_keys, value_path, write_key
from .names import baked_keys, cache_modifier, check_free, frame_key_name, kept_keys, moved_keys, record_bake
from .scene_cache import drop_cache

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
    check_free(thing, [frame_key_name(pattern, time) for time in times])
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
    for thing in moved:
        _write_own(thing, OwnFrames(head, thing, frames), times, pattern, absolute, action)
        action = face.data.shape_keys.animation_data.action


def check_frames(head: Head, frames: FloatArray, times: Sequence[float], pattern: str, absolute: bool) -> list[Object]:
    """RetargetError if `write_head_frames` would refuse; else what `moved_objects` finds."""
    _check_count(head.things[0], frames[:, : head.starts[1]])
    moved = moved_objects(head, frames)
    for thing in moved:
        check_own_keys(thing, absolute)
    names = [frame_key_name(pattern, time) for time in times]
    for thing in moved:
        check_free(thing, names)
    return moved


class OwnFrames:
    """Frames (F, V, 3) of a head as positions (F, v, 3) of one of its objects, in the object's own coordinates.

    They are worked out as they are asked for, a few at a time: a copy of all would be as large as the frames.
    """

    def __init__(self, head: Head, thing: Object, frames: FloatArray) -> None:
        row = head.things.index(thing)
        own = slice(head.starts[row], head.starts[row + 1])
        self._head, self._thing, self._frames = head, thing, frames[:, own]
        self._rest = None if row == 0 else head.face.mesh.vertices[own].astype(np.float32)

    @property
    def shape(self) -> tuple[int, ...]:
        """(F, v, 3)."""
        return self._frames.shape

    def __len__(self) -> int:
        return len(self._frames)

    def __getitem__(self, rows: slice) -> FloatArray:
        """(f, v, 3) float32."""
        if self._rest is None:
            return from_face_space(self._thing, self._frames[rows])
        return self._head.positions(self._thing, self._frames[rows] - self._rest)


def time_step(times: Sequence[float]) -> float:
    """Scene frames from one of some equally spaced times to the next; 1 for a single one."""
    return times[1] - times[0] if len(times) > 1 else 1


def moved_objects(head: Head, frames: FloatArray) -> list[Object]:
    """The face, and each part that frames (F, V, 3) move."""
    least = STILL * head.face.mesh.size
    moved = [head.things[0]]
    for thing, own, _ in list(head.slices())[1:]:
        rest = head.face.mesh.vertices[own].astype(np.float32)
        if any(np.abs(frame - rest).max(initial=0.0) > least for frame in frames[:, own]):
            moved.append(thing)
    return moved


def _check_count(thing: Object, frames: FloatArray) -> None:
    if frames.shape[1] != len(thing.data.vertices):
        raise RetargetError(
            f"frames of {frames.shape[1]} vertices arrived for object {thing.name!r}, "
            f"expected its {len(thing.data.vertices)}"
        )


def check_own_keys(thing: Object, absolute: bool) -> None:
    """RetargetError if absolute keys would turn off shape keys of an object that no bake has made."""
    of_bakes = {*baked_keys(thing), *kept_keys(thing)}
    own = [name for name in key_names(thing) if name not in of_bakes]
    if absolute and own:
        raise RetargetError(
            f"object {thing.name!r} has shape keys of its own, {own[0]!r} among them, which absolute keys would turn "
            "off; expected another kind of bake"
        )


def _write_own(
    thing: Object,
    positions: FrameBlocks,
    times: Sequence[float],
    pattern: str,
    absolute: bool,
    shared: Action | None,
) -> None:
    """Bake positions (F, V, 3) in own coordinates; curves go into a slot of `shared` where there is no action yet."""
    names = [frame_key_name(pattern, time) for time in times]
    ensure_basis(thing)
    remove_bake(thing, keep=set(names))
    made = ensure_keys(thing, names)
    for row, key in enumerate(made):
        write_key(key, positions[row : row + 1])
    keys = thing.data.shape_keys
    keys.use_relative = not absolute
    bag = ensure_curves(keys, f"{keys.name} retargeted", shared)
    if absolute:
        # Blender spaces absolute keys by adding up tenths: what each one's moment came to is read back.
        moments = [key.frame for key in made]
        write_curve(bag, "eval_time", np.array(times, float), np.array(moments))
    else:
        step = time_step(times)
        for time, name in zip(times, names, strict=True):
            # On at its own frame, off at the two beside it.
            write_curve(bag, value_path(name), np.array([time - step, time, time + step]), np.array([0, 1, 0]))
    record_bake(thing, names)
    thing.data.update()


def remove_bake(thing: Object, keep: set[str] = frozenset()) -> None:
    """Remove what plays an object's newest bake: its shape keys but those to keep, its curves, a cache's modifier.

    Shape keys of the artist's that the bake moved rest at 0; the files of a cache stay.
    """
    remove_cache_modifier(thing, cache_modifier(thing))
    keys = thing.data.shape_keys
    if keys is None:
        return
    baked, moved = baked_keys(thing), moved_keys(thing)
    bag = find_curves(keys)
    if bag is not None:
        remove_curves(bag, bake_paths(baked, moved))
    for name in moved:
        keys.key_blocks[name].value = 0.0
    remove_keys(thing, [name for name in baked if name not in keep])
    if baked:
        keys.use_relative = True
    record_bake(thing, keep)


def remove_bakes(things: Sequence[Object]) -> None:
    """Remove the newest bake of a head: of its face, which comes first, and of its parts."""
    for thing in things:
        remove_bake(thing)
    things[0].facial_retarget.bake = ""


def bake_paths(baked: Sequence[str], moved: Sequence[str]) -> set[str]:
    """Data paths of the curves of a bake: of the shape keys that it has made, and of those that it moved."""
    return {value_path(name) for name in [*baked, *moved]} | ({"eval_time"} if baked else set())


def remove_cache_modifier(thing: Object, modifier: Modifier | None) -> None:
    """Remove the modifier that plays a bake's cache, if there is one, and a cache file that nothing else plays."""
    if modifier is None:
        return
    cache = modifier.cache_file if modifier.type == "MESH_SEQUENCE_CACHE" else None
    thing.modifiers.remove(modifier)
    if cache is not None:
        drop_cache(cache)
