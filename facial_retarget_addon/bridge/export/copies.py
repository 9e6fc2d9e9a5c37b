"""Copies of a head for exporters: the artist's own objects stay as they are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from secrets import token_hex

import bpy
import numpy as np
from bpy.types import ID, Collection, Object

from ...core.arrays import FloatArray
from ..curves import ensure_curves, write_curve
from ..key_sets import group_weights, key_names
from ..meshes import read_positions
from ..shape_keys import (
    PREVIEW_KEY,
    ensure_basis,
    ensure_key,
    find_key,
    key_displacement,
    remove_keys,
    value_path,
    write_key,
)
from .key_values import KeyValues, turning_rows


def copy_head(things: Sequence[Object], collection: Collection) -> list[Object]:
    """Copies of a face and its parts with their own meshes, in a collection; parents among them are copies too."""
    made = {}
    for thing in things:
        copy = thing.copy()
        copy.data = thing.data.copy()
        copy.property_unset("facial_retarget")
        copy.hide_select = copy.show_only_shape_key = False
        collection.objects.link(copy)
        remove_keys(copy, [PREVIEW_KEY])
        made[thing] = copy
    for copy in made.values():
        if copy.parent in made:
            inverse = copy.matrix_parent_inverse.copy()
            copy.parent = made[copy.parent]
            copy.matrix_parent_inverse = inverse
    return list(made.values())


def make_plain(
    things: Sequence[Object], copies: Sequence[Object], times: Sequence[float], values: KeyValues, names: dict[str, str]
) -> None:
    """Give copies of a head what every exporter takes: keys relative to the Basis, each with a curve, in one action.

    Masks of keys go into their shapes; drivers and NLA strips into their curves. Armature modifiers stay that are on.

    Parameters
    ----------
    times : (F,) scene frames. values : of the keys of `things` at them.
    names : key -> its name on the copies; without an entry it stays.
    """
    action, frames = None, np.array(times, float)
    for thing, copy in zip(things, copies, strict=True):
        for modifier in list(copy.modifiers):
            if modifier.type != "ARMATURE" or not modifier.show_viewport:
                copy.modifiers.remove(modifier)
        if thing.data.shape_keys is None:
            continue
        own, basis = key_names(thing), read_positions(thing.data)
        _clear_keys(copy)
        copy.data.vertices.foreach_set("co", basis.ravel())
        ensure_basis(copy).name = thing.data.shape_keys.reference_key.name
        made = [ensure_key(copy, names.get(name, name)) for name in own]
        for key, name in zip(made, own, strict=True):
            write_key(key, basis + _masked(thing, name))
        keys = copy.data.shape_keys
        bag = ensure_curves(keys, f"{copy.name} exported", action)
        action = keys.animation_data.action
        for key, played in zip(made, values[thing].T, strict=True):
            key.slider_max = max(1.0, float(np.ceil(played.max())))
            key.slider_min = min(0.0, float(np.floor(played.min())))
            key.value = float(played[0])
            rows = turning_rows(played)
            write_curve(bag, value_path(key.name), frames[rows], played[rows])
        copy.data.update()


def _clear_keys(copy: Object) -> None:
    """Remove all shape keys; up to Blender 5.0 those of a copied mesh have a user too many, and would stay."""
    name = copy.data.shape_keys.name
    copy.shape_key_clear()
    left = bpy.data.shape_keys.get(name)
    if left is not None:
        bpy.data.batch_remove([left])


def _masked(thing: Object, name: str) -> FloatArray:
    key = find_key(thing, name)
    moves = key_displacement(key) if thing.data.shape_keys.use_relative else _from_basis(thing, key)
    if key.vertex_group in thing.vertex_groups and thing.data.shape_keys.use_relative:
        moves *= group_weights(thing, key.vertex_group)[:, None]
    return moves


def _from_basis(thing: Object, key: bpy.types.ShapeKey) -> FloatArray:
    """(V, 3) how an absolute key differs from the first one: it is relative to none."""
    flat = np.empty(3 * len(key.points), np.float32)
    key.points.foreach_get("co", flat)
    return flat.reshape(-1, 3).astype(np.float64) - read_positions(thing.data)


def remove_copies(copies: Sequence[Object]) -> None:
    """Take copies out of the file again, with their meshes, keys and the action that `make_plain` made."""
    for copy in copies:
        mesh, keys = copy.data, copy.data.shape_keys
        action = None if keys is None or keys.animation_data is None else keys.animation_data.action
        bpy.data.objects.remove(copy)
        bpy.data.meshes.remove(mesh)
        if action is not None and not action.users:
            bpy.data.actions.remove(action)


@contextmanager
def names_lent(things: Sequence[Object], copies: Sequence[Object]) -> Iterator[None]:
    """Inside, the copies and their meshes bear the names of the things: a file names them as the artist does."""
    pairs: list[tuple[ID, ID]] = [*zip(things, copies, strict=True)]
    pairs += [(thing.data, copy.data) for thing, copy in pairs]
    before = [(thing, thing.name) for thing in dict.fromkeys(thing for thing, _ in pairs) if thing.library is None]
    try:
        for thing, _ in before:
            thing.name = token_hex(8)
        for thing, copy in pairs:
            copy.name = dict(before).get(thing, thing.name)
        yield
    finally:
        for _, copy in pairs:
            copy.name = token_hex(8)
        for thing, name in before:
            thing.name = name
