"""A motion of a few shape keys on the objects of a head: the keys, or those that are there, with their curves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from bpy.types import Object

from ...core.errors import RetargetError
from ...core.reduction.bake_keys import BakedKeys, RigKeys
from ..curves import ensure_curves, remove_curves, write_curve
from ..heads import Head
from ..shape_keys import ensure_key, find_key, value_path, write_key
from .frames import STILL, remove_bake
from .names import baked_keys, check_free, kept_keys, record_bake


def rig_keys(head: Head) -> RigKeys:
    """The shape keys of a head that move something, are not muted, and that no driver drives and no bake has made.

    Raises
    ------
    RetargetError : if there is none.
    """
    baked = {name for thing in head.things for name in (*baked_keys(thing), *kept_keys(thing))}
    driven = {curve.data_path for thing in head.things for curve in _drivers(thing)}
    names = [name for name in head.key_names() if name not in baked and value_path(name) not in driven]
    names = [name for name in names if not find_key(head.owner(name), name).mute]
    shapes = head.displacements(names)
    moving = [row for row in range(len(names)) if shapes[row].any()]
    if not moving:
        raise RetargetError(
            f"object {head.name!r} has no shape key that a bake onto its rig could animate, expected some that move a "
            "vertex, are not muted and have no driver"
        )
    kept = tuple(names[row] for row in moving)
    ranges = [find_key(head.owner(name), name) for name in kept]
    low, high = (np.array([getattr(key, side) for key in ranges]) for side in ("slider_min", "slider_max"))
    return RigKeys(kept, shapes[moving], low, high)


def check_keyed(head: Head, baked: BakedKeys) -> None:
    """RetargetError if `write_keyed` would write over shape keys of the artist's own."""
    for thing in head.things:
        check_free(thing, baked.names[len(baked.names) - baked.made :])


def write_keyed(head: Head, baked: BakedKeys, times: Sequence[float]) -> None:
    """Let a head play a motion of shape keys, new ones made on each object that they move; an earlier bake is removed.

    Parameters
    ----------
    times : (F,) scene frames.
    """
    names, keyed, made = baked
    for thing in head.things:
        remove_bake(thing)
    first_new = len(names) - made
    size, action = head.face.mesh.size, None
    for thing, own, _ in head.slices():
        mine = [row for row, name in enumerate(names[:first_new]) if find_key(thing, name) is not None]
        new = [row for row in range(first_new, len(names)) if np.abs(keyed.shapes[row, own]).max() > STILL * size]
        for row in new:
            key = ensure_key(thing, names[row])
            write_key(key, head.positions(thing, keyed.shapes[row, own]))
            key.slider_min = min(-1.0, float(np.floor(keyed.curves[:, row].min())))
        if not mine and not new:
            continue
        keys = thing.data.shape_keys
        bag = ensure_curves(keys, f"{keys.name} retargeted", action)
        action = action or keys.animation_data.action
        moved = [names[row] for row in mine]
        remove_curves(bag, {value_path(name) for name in moved})
        for row in [*mine, *new]:
            write_curve(bag, value_path(names[row]), np.array(times, float), keyed.curves[:, row])
        record_bake(thing, [names[row] for row in new], moved)
        thing.data.update()


def _drivers(thing: Object) -> list:
    keys = thing.data.shape_keys
    return [] if keys is None or keys.animation_data is None else list(keys.animation_data.drivers)
