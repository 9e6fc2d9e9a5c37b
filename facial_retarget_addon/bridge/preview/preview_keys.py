"""The shape key that carries the live preview: on the target while it is on, and in no file.

A shape key is what a bake makes too, so that modifiers, materials and the artist's own keys act on it alike. Where the
target has no shape keys yet, the whole block of them is marked as runtime data, which Blender writes into no file.
"""

from __future__ import annotations

from collections.abc import Iterable

import bpy
import numpy as np
from bpy.types import Depsgraph, Object

from ...core.arrays import FloatArray
from ..bakes.names import baked_keys
from ..shape_keys import PREVIEW_KEY, ensure_basis, ensure_key, find_key, key_displacement, write_key


def add_preview_keys(things: Iterable[Object]) -> None:
    """Give objects the key, at rest and locked; their active key stays."""
    for thing in things:
        active = thing.active_shape_key_index
        if thing.data.shape_keys is None:
            ensure_basis(thing)
            thing.data.shape_keys.is_runtime_data = True
        key = ensure_key(thing, PREVIEW_KEY)
        key.value, key.lock_shape = 1.0, True
        thing.active_shape_key_index = active


def remove_preview_keys(things: Iterable[Object]) -> None:
    """Take the key away, and the Basis with it where it was made for the key; the active key stays."""
    for thing in things:
        keep_own_keys(thing)
        key = find_key(thing, PREVIEW_KEY)
        if thing.data.shape_keys is not None and thing.data.shape_keys.is_runtime_data:
            thing.shape_key_clear()
        if key is None or thing.data.shape_keys is None:
            continue
        active = thing.active_shape_key
        name = None if active is None or active == key else active.name
        thing.shape_key_remove(key)
        thing.active_shape_key_index = max(thing.data.shape_keys.key_blocks.find(name), 0) if name else 0


def keep_own_keys(thing: Object) -> None:
    """Let Blender write the shape keys of an object into files once there are others than Basis and preview."""
    keys = thing.data.shape_keys
    if keys is not None and keys.is_runtime_data and len(keys.key_blocks) > 2:
        keys.is_runtime_data = False


def held_in_files(thing: Object) -> bool:
    """Whether a saved file would hold the key."""
    return find_key(thing, PREVIEW_KEY) is not None and not thing.data.shape_keys.is_runtime_data


def write_preview(thing: Object, positions: FloatArray, depsgraph: Depsgraph) -> None:
    """Show positions (V, 3) in the object's own coordinates; what an earlier bake adds is taken off."""
    key = find_key(thing, PREVIEW_KEY)
    write_key(key, positions - _baked(thing, depsgraph))
    thing.data.update_tag()


def _baked(thing: Object, depsgraph: Depsgraph) -> FloatArray | float:
    """(V, 3) what the keys of an earlier bake add now; 0.0 for nothing."""
    keys = thing.data.shape_keys
    blocks = keys.evaluated_get(depsgraph).key_blocks
    values = np.empty(len(blocks), np.float32)
    blocks.foreach_get("value", values)
    added: FloatArray | float = 0.0
    baked = set(baked_keys(thing))
    for row in np.flatnonzero(values).tolist():
        key = keys.key_blocks[row]
        if key.name in baked and not key.mute:
            added = added + values[row] * key_displacement(key).astype(np.float32)
    return added


def remove_every_key() -> None:
    """Take the key away from all objects: from a target of before, from one that Blender saved by itself."""
    remove_preview_keys(thing for thing in bpy.data.objects if thing.type == "MESH" and thing.data.is_editable)
