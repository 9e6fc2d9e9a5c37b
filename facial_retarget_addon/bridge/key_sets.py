"""Whole sets of shape keys: what each one is beside its shape, and sets written in one go."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import NamedTuple

import numpy as np
from bpy.types import Object, ShapeKey

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from .bakes.names import baked_keys, kept_keys
from .shape_keys import PREVIEW_KEY, ensure_basis, ensure_key, find_key, key_displacement, write_key

LONGEST = 63
"""Bytes that Blender keeps of a shape key's name."""


class KeyTraits(NamedTuple):
    """What a shape key is beside its shape.

    low, high : its slider's range.
    group : the vertex group that masks it, "" for none.
    relative : the key that its shape is relative to, "" for the Basis.
    """

    low: float = 0.0
    high: float = 1.0
    value: float = 0.0
    mute: bool = False
    group: str = ""
    relative: str = ""


def check_editable(thing: Object) -> None:
    """RetargetError if an object's shape keys cannot be written: it is linked, or its keys are absolute."""
    check_local(thing)
    check_relative(thing)


def check_local(thing: Object) -> None:
    """RetargetError if an object is linked from another file: its shape keys cannot be written."""
    if not thing.data.is_editable:
        raise RetargetError(
            f"object {thing.name!r} is linked from another file, expected one whose mesh can be changed"
        )


def check_targets(sources: Collection[Object], targets: Collection[Object], over_bake: bool = False) -> None:
    """RetargetError if targets cannot be written, or one has its mesh in common: writing one would change the other.

    over_bake : what is written replaces an earlier bake, so that one of absolute shape keys is no hindrance.
    """
    holders = {thing.data.name_full: thing for thing in sources}
    for thing in targets:
        check_local(thing)
        if not over_bake or set(key_names(thing)) - {*baked_keys(thing), *kept_keys(thing)}:
            check_relative(thing)
        mesh = thing.data.name_full
        if mesh in holders:
            raise RetargetError(
                f"mesh {mesh!r} is that of object {holders[mesh].name!r} and of object {thing.name!r}, "
                "expected a target with a mesh of its own, on one head"
            )
        holders[mesh] = thing


def check_relative(thing: Object) -> None:
    """RetargetError if an object's shape keys are absolute: they follow each other and cannot be mixed."""
    keys = thing.data.shape_keys
    if keys is not None and not keys.use_relative:
        raise RetargetError(f"the shape keys of object {thing.name!r} are absolute, expected relative ones")


def key_names(thing: Object) -> list[str]:
    """Names of an object's shape keys, without the Basis and what carries the live preview."""
    keys = thing.data.shape_keys
    own = () if keys is None else keys.key_blocks
    return [key.name for key in own if key != keys.reference_key and key.name != PREVIEW_KEY]


def read_traits(key: ShapeKey) -> KeyTraits:
    """What a shape key is beside its shape."""
    relative = "" if key.relative_key == key.id_data.reference_key else key.relative_key.name
    return KeyTraits(key.slider_min, key.slider_max, key.value, key.mute, key.vertex_group, relative)


def write_traits(thing: Object, key: ShapeKey, traits: KeyTraits) -> None:
    """Give a shape key its traits; a group and a relative key that the object lacks are left out."""
    key.slider_max = max(key.slider_max, traits.high)  # Blender lets neither end pass the other
    key.slider_min, key.slider_max = traits.low, traits.high
    key.value, key.mute = traits.value, traits.mute
    key.vertex_group = traits.group if traits.group in thing.vertex_groups else ""
    key.relative_key = find_key(thing, traits.relative) or thing.data.shape_keys.reference_key


def group_weights(thing: Object, name: str) -> FloatArray:
    """(V,) weights of a vertex group, 0 outside it."""
    index = thing.vertex_groups[name].index
    # Blender has no block access to vertex groups.
    found = [(v.index, g.weight) for v in thing.data.vertices for g in v.groups if g.group == index]
    weights = np.zeros(len(thing.data.vertices))
    if found:
        rows, values = zip(*found, strict=True)
        weights[list(rows)] = values
    return weights


def write_keys(thing: Object, shapes: Mapping[str, FloatArray], traits: Mapping[str, KeyTraits]) -> None:
    """Set shape keys, made where they are missing. Other keys that are relative to them go on moving what they moved.

    Parameters
    ----------
    shapes : name -> (V, 3) displacement in own coordinates, from the key that it is relative to.
    traits : name -> what the key is beside its shape; keys without them keep what they have.
    """
    ensure_basis(thing)
    for name in shapes:
        ensure_key(thing, name)
    moves = {name: key_displacement(find_key(thing, name)) for name in _dependents(thing, shapes)} | dict(shapes)
    for name in shapes:
        if name in traits:
            write_traits(thing, find_key(thing, name), traits[name])
    for name in _bases_first(thing):
        if name in moves:
            key = find_key(thing, name)
            write_key(key, _positions(key.relative_key) + moves[name])
    thing.data.update()


def _dependents(thing: Object, names: Collection[str]) -> set[str]:
    """The keys that are relative to some keys, or to others that are."""
    found = set(names)
    for name in _bases_first(thing):
        if find_key(thing, name).relative_key.name in found:
            found.add(name)
    return found - set(names)


def _bases_first(thing: Object) -> list[str]:
    """An object's keys, each after the one that it is relative to; of those in a ring the first one first."""
    waiting, ordered = dict.fromkeys(key_names(thing)), []
    while waiting:
        base = {name: find_key(thing, name).relative_key.name for name in waiting}
        for name in [name for name in base if base[name] == name or base[name] not in base] or list(waiting)[:1]:
            ordered.append(name)
            del waiting[name]
    return ordered


def _positions(key: ShapeKey) -> FloatArray:
    flat = np.empty(3 * len(key.points), np.float32)
    key.points.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def free_name(name: str, taken: Collection[str]) -> str:
    """A name as Blender would number it, joy.001, that is not among those taken."""
    number = 1
    while (found := f"{shortened(name, LONGEST - 4)}.{number:03d}") in taken:
        number += 1
    return found


def shortened(name: str, length: int = LONGEST) -> str:
    """A name cut so that its UTF-8 has at most so many bytes."""
    return name.encode()[:length].decode(errors="ignore")
