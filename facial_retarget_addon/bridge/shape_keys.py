"""Shape keys: made, written and read as blocks, removed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from bpy.types import FCurve, Object, ShapeKey
from bpy.utils import escape_identifier

from ..core.arrays import FloatArray

PREVIEW_KEY = "facial_retarget_preview"
"""Name of the shape key that carries the live preview; no other key has it."""


def ensure_basis(thing: Object) -> ShapeKey:
    """The object's Basis, made if it has no shape keys."""
    if thing.data.shape_keys is None:
        thing.shape_key_add(name="Basis", from_mix=False)
    return thing.data.shape_keys.reference_key


def find_key(thing: Object, name: str) -> ShapeKey | None:
    """The shape key of this name, if there is one."""
    keys = thing.data.shape_keys
    return None if keys is None else keys.key_blocks.get(name)


def ensure_key(thing: Object, name: str) -> ShapeKey:
    """The shape key of this name; a new one equals the Basis and has value 0."""
    return ensure_keys(thing, [name])[0]


def ensure_keys(thing: Object, names: Sequence[str]) -> list[ShapeKey]:
    """As `ensure_key`, for many keys: Blender goes through all of them to find one by its name."""
    ensure_basis(thing)
    there = {key.name: key for key in thing.data.shape_keys.key_blocks}
    for name in names:
        if name not in there:
            there[name] = thing.shape_key_add(name=name, from_mix=False)
            there[name].value = 0.0  # from Blender 5.0 a new key starts at 1
    return [there[name] for name in names]


def write_key(key: ShapeKey, positions: FloatArray) -> None:
    """Set a shape key: positions (V, 3) in the object's own coordinates."""
    # key.points copies float32 as a block; key.data is two orders slower.
    key.points.foreach_set("co", np.ascontiguousarray(positions, np.float32).ravel())


def key_displacement(key: ShapeKey) -> FloatArray:
    """(V, 3) float64 how a shape key moves the vertices, in the object's own coordinates."""
    start, end = (np.empty(3 * len(key.points), np.float32) for _ in range(2))
    key.relative_key.points.foreach_get("co", start)
    key.points.foreach_get("co", end)
    return (end.astype(np.float64) - start).reshape(-1, 3)


def remove_keys(thing: Object, names: Iterable[str]) -> None:
    """Remove the shape keys of these names, where there are any."""
    keys = thing.data.shape_keys
    there = {} if keys is None else {key.name: key for key in keys.key_blocks}
    for name in names:
        if name in there:
            thing.shape_key_remove(there.pop(name))


def key_path(name: str) -> str:
    """Data path of a shape key."""
    return f'key_blocks["{escape_identifier(name)}"]'


def value_path(name: str) -> str:
    """Data path of a shape key's value."""
    return f"{key_path(name)}.value"


def key_curves(curves: Iterable[FCurve], name: str) -> list[FCurve]:
    """Those of some curves or drivers that move a property of a shape key."""
    return [curve for curve in curves if curve.data_path.startswith(f"{key_path(name)}.")]
