"""Frames to shape keys with their animation."""

from __future__ import annotations

import re

import numpy as np
from bpy.types import Action, Object

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from ..guide import BAKED_KEY
from .curves import ensure_curves, find_curves, remove_curves, write_curve
from .heads import Head
from .meshes import from_face_space
from .shape_keys import ensure_basis, ensure_key, remove_keys, value_path, write_key

STILL = 1e-6
"""Motion of a part below this share of the head's size is none."""


def key_name(frame: int) -> str:
    """Name of the shape key of a frame."""
    return BAKED_KEY.format(frame)


def is_frame_key(name: str) -> bool:
    """Whether a shape key of this name is a frame's."""
    return re.fullmatch(r"frame_-?\d{3,}", name) is not None


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
    _write_own(thing, from_face_space(thing, frames), first, None)


def write_head_frames(head: Head, frames: FloatArray, first: int) -> None:
    """Bake frames (F, V, 3) of a head on its face and on each part that they move; see `write_frames`.

    All objects share the action of the face, in which each has its slot.
    """
    face, size = head.things[0], head.face.mesh.size
    write_frames(face, frames[:, : head.starts[1]], first)
    for thing, own, _ in list(head.slices())[1:]:
        moves = frames[:, own] - head.face.mesh.vertices[own].astype(np.float32)
        if np.abs(moves).max(initial=0.0) > STILL * size:
            action = face.data.shape_keys.animation_data.action
            _write_own(thing, head.positions(thing, moves), first, action)
        else:
            remove_frames(thing)


def _write_own(thing: Object, positions: FloatArray, first: int, shared: Action | None) -> None:
    """Bake positions (F, V, 3) in own coordinates; curves go into a slot of `shared` where there is no action yet."""
    names = [key_name(first + i) for i in range(len(positions))]
    ensure_basis(thing)
    remove_frames(thing, keep=set(names))
    for name, places in zip(names, positions, strict=True):
        write_key(ensure_key(thing, name), places)
    keys = thing.data.shape_keys
    bag = ensure_curves(keys, f"{keys.name} retargeted", shared)
    for frame, name in enumerate(names, start=first):
        # On at its own frame, off at the two beside it.
        write_curve(bag, value_path(name), np.arange(frame - 1, frame + 2), np.array([0, 1, 0]))
    thing.data.update()


def remove_frames(thing: Object, keep: set[str] = frozenset()) -> None:
    """Remove the frames of an earlier bake, but not the keys to keep, and the curves of all of them."""
    keys = thing.data.shape_keys
    if keys is None:
        return
    baked = [key.name for key in keys.key_blocks if is_frame_key(key.name)]
    bag = find_curves(keys)
    if bag is not None:
        remove_curves(bag, {value_path(name) for name in baked})
    remove_keys(thing, [name for name in baked if name not in keep])
