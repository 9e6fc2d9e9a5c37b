"""Imported motion as curves, told apart from the artist's own by their groups."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from bpy.types import ID, Object

from ...core.arrays import FloatArray
from ...core.errors import RetargetError
from ...fap_controls import CONTROLS
from ..bakes.frames import remove_bakes
from ..curves import ensure_curves, find_curves, remove_curves, write_curve
from ..heads import head_parts
from ..shape_keys import remove_keys, value_path
from .head_empty import clear_head

MOTION, CHANNELS = "Imported Motion", "Imported Channels"
"""Groups of curves: of what stays when the motion goes, and of shape keys that go with it."""


def clear_motion(thing: Object) -> None:
    """Take an earlier import or bake off a face and its parts. What it moved rests; own curves and keys stay."""
    remove_bakes([thing, *head_parts(thing)])
    clear_head(thing)
    moved = _drop_group(thing, MOTION)
    for control in CONTROLS:
        if control.path in moved:
            thing[control.name] = 0.0
    keys = thing.data.shape_keys
    if keys is not None:
        moved, baked = _drop_group(keys, MOTION), _drop_group(keys, CHANNELS)
        for key in keys.key_blocks:
            if value_path(key.name) in moved:
                key.value = 0.0
        remove_keys(thing, [key.name for key in keys.key_blocks if value_path(key.name) in baked])


def _drop_group(animated: ID, group: str) -> set[str]:
    """Remove the curves of a group; returns their data paths."""
    bag = find_curves(animated)
    if bag is None:
        return set()
    paths = {curve.data_path for curve in bag.fcurves if curve.group is not None and curve.group.name == group}
    remove_curves(bag, paths)
    return paths


def drive_keys(thing: Object, values: Mapping[str, FloatArray], frames: FloatArray, group: str) -> None:
    """Curves for shape keys: values (F,) at scene frames (F,), in place of the curves that they have."""
    keys = thing.data.shape_keys
    bag = ensure_curves(keys, f"{keys.name} motion")
    remove_curves(bag, {value_path(name) for name in values})
    for name, column in values.items():
        key = keys.key_blocks[name]
        key.slider_min, key.slider_max = min(key.slider_min, column.min()), max(key.slider_max, column.max())
        write_curve(bag, value_path(name), frames, column, group=group)


def check_free(thing: Object, names: Iterable[str]) -> None:
    """RetargetError if a driver holds one of the shape keys: curves would not move it."""
    keys = thing.data.shape_keys
    animation = keys.animation_data if keys is not None else None
    driven = {driver.data_path for driver in animation.drivers} if animation is not None else set()
    held = [name for name in names if value_path(name) in driven]
    if held:
        raise RetargetError(
            f"{len(held)} shape keys of object {thing.name!r} follow drivers, such as {held[0]!r}; expected keys that "
            "curves can move"
        )
