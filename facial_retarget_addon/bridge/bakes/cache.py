"""Frames as a cache on disk that a Mesh Cache modifier plays: the .blend stays small, any length plays fast."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import bpy
from bpy.types import Object

from ...core.arrays import FloatArray
from ...files.frames import add_frames
from ...files.whole import Aside
from ..heads import Head
from .frames import moved_objects, own_positions, remove_bake, time_step

MODIFIER = "Facial Retarget"


def cache_paths(head: Head, path: Path, frames: FloatArray) -> dict[Object, Path]:
    """Each object that frames (F, V, 3) move -> its cache: the face's is `path`, a part's has its name behind it."""
    parts = [thing for thing in moved_objects(head, frames) if thing != head.things[0]]
    names = {thing: f"{path.stem}.{bpy.path.clean_name(thing.name)}{path.suffix}" for thing in parts}
    return {head.things[0]: path} | {thing: path.with_name(name) for thing, name in names.items()}


def add_caches(aside: Aside, head: Head, paths: dict[Object, Path], frames: FloatArray) -> None:
    """Write the caches of a head's frames, in each object's own coordinates."""
    for thing, own, _ in head.slices():
        if thing in paths:
            add_frames(aside, own_positions(head, thing, frames[:, own]), paths[thing], None)


def play_caches(paths: dict[Object, Path], times: Sequence[float]) -> None:
    """Let each object play its cache from the first scene frame on; shape keys of an earlier bake are removed."""
    for thing, path in paths.items():
        remove_bake(thing)
        modifier = thing.modifiers.get(MODIFIER) or thing.modifiers.new(MODIFIER, "MESH_CACHE")
        thing.modifiers.move(thing.modifiers.find(MODIFIER), 0)
        modifier.cache_format = path.suffix[1:].upper()
        modifier.filepath = str(path)
        modifier.interpolation = "LINEAR"
        modifier.forward_axis, modifier.up_axis = "POS_Y", "POS_Z"
        modifier.time_mode, modifier.play_mode = "FRAME", "SCENE"
        modifier.frame_start, modifier.frame_scale = times[0], 1 / time_step(times)


def stop_caches(things: Sequence[Object]) -> None:
    """Take away what plays the caches of an earlier bake; the files stay."""
    for thing in things:
        modifier = thing.modifiers.get(MODIFIER)
        if modifier is not None and modifier.type == "MESH_CACHE":
            thing.modifiers.remove(modifier)
