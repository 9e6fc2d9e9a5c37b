"""Frames as a cache on disk that a modifier plays: the .blend stays small, any length plays fast."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import bpy
from bpy.types import Modifier, Object

from ...core.arrays import FloatArray
from ...core.methods.settings import CACHES
from ...files.frames import add_frames
from ...files.whole import Aside
from ..heads import Head
from ..key_sets import LONGEST, shortened
from .frames import OwnFrames, moved_objects, remove_bake, time_step
from .names import MODIFIER
from .scene_cache import Played, add_scene_cache, load_cache, names_inside, object_path


class Place(NamedTuple):
    """Where an object's frames lie: a file, and the object's name in a file that holds several."""

    path: Path
    name: str = ""


def with_suffix(path: Path, kind: str) -> Path:
    """A cache's file with a suffix of its kind, in place of another kind's."""
    if path.suffix.lower() in CACHES[kind]:
        return path.with_suffix(path.suffix.lower())
    others = {suffix for suffixes in CACHES.values() for suffix in suffixes}
    stem = path.stem if path.suffix.lower() in others else path.name
    return path.with_name(stem + CACHES[kind][0])


def cache_places(head: Head, path: Path, frames: FloatArray) -> dict[Object, Place]:
    """Each object that frames (F, V, 3) move -> its cache.

    Alembic and USD hold all objects. Of the others the face's is `path`, a part's has its name behind it.
    """
    things = moved_objects(head, frames)
    if path.suffix not in (".pc2", ".mdd"):
        return {thing: Place(path, name) for thing, name in zip(things, names_inside(things), strict=True)}
    names = [f"{path.stem}.{name}{path.suffix}" for name in _file_names(things[1:])]
    return {things[0]: Place(path)} | {
        thing: Place(path.with_name(name)) for thing, name in zip(things[1:], names, strict=True)
    }


def _file_names(things: Sequence[Object]) -> list[str]:
    """Names of objects as parts of files' names, told apart on systems too that know no capital letters."""
    names: dict[str, str] = {}
    for thing in things:
        stem = name = shortened(bpy.path.clean_name(thing.name), LONGEST)
        number = 1
        while name.casefold() in names:
            number += 1
            name = f"{stem}_{number}"
        names[name.casefold()] = name
    return list(names.values())


def add_caches(
    aside: Aside, head: Head, places: Mapping[Object, Place], frames: FloatArray, times: Sequence[float]
) -> None:
    """Write the caches of a head's frames, in each object's own coordinates."""
    held = {thing: OwnFrames(head, thing, frames) for thing in places}
    path, name = places[head.things[0]]
    if name:
        played = [Played(thing, places[thing].name, own) for thing, own in held.items()]
        add_scene_cache(aside, path, played, time_step(times))
        return
    for thing, own in held.items():
        add_frames(aside, own, places[thing].path, None)


def play_caches(head: Head, places: Mapping[Object, Place], times: Sequence[float]) -> None:
    """Let each object play its cache from the first scene frame on; an earlier bake is removed."""
    for thing in head.things:
        remove_bake(thing)
    path, name = places[head.things[0]]
    cache = load_cache(path, times, time_step(times)) if name else None
    for thing, place in places.items():
        modifier = thing.modifiers.new(MODIFIER, "MESH_SEQUENCE_CACHE" if name else "MESH_CACHE")
        thing.modifiers.move(thing.modifiers.find(modifier.name), 0)
        if name:
            modifier.cache_file, modifier.object_path = cache, object_path(path, place.name)
            modifier.read_data, modifier.use_vertex_interpolation = {"VERT"}, True
        else:
            _play_points(modifier, place.path, times)


def _play_points(modifier: Modifier, path: Path, times: Sequence[float]) -> None:
    """Let a Mesh Cache modifier play a file."""
    modifier.cache_format, modifier.filepath = path.suffix[1:].upper(), str(path)
    modifier.interpolation = "LINEAR"
    modifier.forward_axis, modifier.up_axis = "POS_Y", "POS_Z"
    modifier.time_mode, modifier.play_mode = "FRAME", "SCENE"
    # Blender scales the scene's frame first, then takes the start off.
    modifier.frame_scale, modifier.frame_start = 1 / time_step(times), times[0] / time_step(times)
