"""How strong the motion is, as the panel says: by regions, and by vertex groups that the artist paints."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from bpy.types import Object, PropertyGroup

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from ..core.gains import Gains, Mask
from ..core.methods.settings import RegionGains
from ..preview_state import STATE
from .heads import Head
from .key_sets import group_weights
from .settings import read_group, write_group


def read_gains(
    task: PropertyGroup, target: Head | None, known: Mapping[str, FloatArray] = MappingProxyType({})
) -> Gains:
    """The gains of a task.

    Parameters
    ----------
    target : the head whose vertex groups the masks are; None where all of them are known.
    known : weights (V,) of masks that need not be read again.

    Raises
    ------
    RetargetError : for a mask that is listed twice, or whose vertex group is missing.
    """
    regions = read_group(RegionGains, task.regions)
    masks: dict[str, Mask] = {}
    for mask in task.masks:
        if mask.name in masks:
            raise RetargetError(f"vertex group {mask.name!r} is listed twice as a mask, expected it once")
        weights = known[mask.name] if target is None or mask.name in known else _weights(target, mask.name)
        masks[mask.name] = Mask(weights, read_gain(mask))
    return Gains(regions, masks)


def read_gain(mask: PropertyGroup) -> float:
    """The gain of a mask; Blender keeps float32, so 0.7 is read as the shortest number that means it."""
    return float(str(np.float32(mask.gain)))


def write_gains(task: PropertyGroup, target: Object, gains: Gains) -> None:
    """Set a task's gains; masks become vertex groups of the target."""
    write_group(task.regions, gains.regions)
    task.masks.clear()
    for name, mask in gains.masks.items():
        group = target.vertex_groups.get(name) or target.vertex_groups.new(name=name)
        for weight in np.unique(mask.weights[mask.weights > 0]):
            group.add(np.flatnonzero(mask.weights == weight).tolist(), float(weight), "REPLACE")
        listed = task.masks.add()
        listed.name, listed.gain = group.name, mask.gain


def add_mask(task: PropertyGroup) -> None:
    """List the target's active vertex group as a mask, or its first one that is not listed; one is made if need be."""
    target = task.target
    listed = {mask.name for mask in task.masks}
    active = target.vertex_groups.active
    names = [group.name for group in ([active] if active else []) + list(target.vertex_groups)]
    free = [name for name in names if name not in listed]
    mask = task.masks.add()
    mask.name = free[0] if free else target.vertex_groups.new(name="Mask").name
    target.vertex_groups.active_index = target.vertex_groups[mask.name].index
    task.active_mask = len(task.masks) - 1


def remove_mask(task: PropertyGroup) -> None:
    """Take the active mask off the list; its vertex group stays."""
    task.masks.remove(task.active_mask)
    task.active_mask = max(min(task.active_mask, len(task.masks) - 1), 0)
    STATE.tell("gains")


def _weights(target: Head, name: str) -> FloatArray:
    """(V,) weights of a vertex group on the objects of a head that have it."""
    weights = np.zeros(target.starts[-1])
    having = [(thing, own) for thing, own, _ in target.slices() if name in thing.vertex_groups]
    if not having:
        raise RetargetError(f"object {target.name!r} has no vertex group {name!r}, expected one for the mask")
    for thing, own in having:
        weights[own] = group_weights(thing, name)
    return weights
