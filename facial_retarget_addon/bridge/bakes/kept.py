"""Earlier bakes that stay on a head, turned off, until the artist plays one of them again or removes it.

Shape keys are muted and get names of their own, curves lie in an action of their own, modifiers are turned off.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import bpy
from bpy.types import Action, ActionChannelbag, Modifier, Object, PropertyGroup

from ...core.errors import RetargetError
from ..cloning.curve_copies import copy_curve
from ..curves import ensure_bag, ensure_curves, find_bag, find_curves, remove_curves
from ..key_sets import LONGEST, free_name, shortened
from ..shape_keys import remove_keys, value_path
from .frames import check_own_keys, remove_bakes, remove_cache_modifier
from .names import MODIFIER, baked_keys, cache_modifier, moved_keys, record_bake

EVALUATION = "eval_time"
"""Data path of the curve that plays absolute shape keys."""


def plays_bake(things: Sequence[Object]) -> bool:
    """Whether a head plays a bake."""
    return any(baked_keys(thing) or moved_keys(thing) or cache_modifier(thing) for thing in things)


def keep_bake(things: Sequence[Object]) -> None:
    """Keep the bake that a head plays, turned off; the head's face comes first. Nothing happens where it plays none."""
    if not plays_bake(things):
        return
    face = things[0]
    kept = [item for thing in things for item in thing.facial_retarget.kept_bakes]
    number = max((item.number for item in kept), default=0) + 1
    action: Action | None = None
    for thing in things:
        item = thing.facial_retarget.kept_bakes.add()
        item.number, item.name, item.kind = number, f"Bake {number}", face.facial_retarget.bake or "frames"
        _keep_modifier(thing, item)
        action = _keep_keys(thing, item, action or f"{face.name} bake {number}") or action
    face.facial_retarget.bake = ""


def play_bake(things: Sequence[Object], number: int) -> None:
    """Play an earlier bake again; the one that plays now is kept.

    Raises
    ------
    RetargetError : if no such bake is kept, if a part of it is gone, or if its absolute keys would turn own ones off.
    """
    face, found = things[0], _kept(things, number)
    kind = found[face].kind
    for thing, item in found.items():
        _check_there(thing, item)
        check_own_keys(thing, kind == "absolute" and bool(item.kept))
    keep_bake(things)
    action: Action | None = None
    # Adding to a collection may move what is in it.
    for thing, item in _kept(things, number).items():
        _play_modifier(thing, item)
        action = _play_keys(thing, item, action) or action
    _forget(things, number)
    face.facial_retarget.bake = kind


def remove_kept_bake(things: Sequence[Object], number: int) -> None:
    """Remove an earlier bake; the files of a cache stay.

    Raises
    ------
    RetargetError : if no such bake is kept.
    """
    for thing, item in _kept(things, number).items():
        remove_cache_modifier(thing, thing.modifiers.get(item.modifier))
        remove_keys(thing, item.kept.split("\n"))
    _forget(things, number)


def remove_playing_bake(things: Sequence[Object]) -> None:
    """Remove the bake that a head plays; earlier ones and the files of a cache stay.

    Raises
    ------
    RetargetError : if it plays none.
    """
    if not plays_bake(things):
        raise RetargetError(f"object {things[0].name!r} plays no bake, expected one to remove")
    remove_bakes(things)


def free_file(things: Sequence[Object], path: Path, keep: bool) -> Path:
    """A cache's file that no kept bake of a head plays: `path`, or the same with a number behind its name.

    keep : whether the bake that plays now will be kept.
    """
    taken = {
        _file(modifier)
        for thing in things
        for modifier in (
            *(thing.modifiers.get(item.modifier) for item in thing.facial_retarget.kept_bakes),
            cache_modifier(thing) if keep else None,
        )
        if modifier is not None
    }
    free, number = path, 0
    while free in taken:
        number += 1
        free = path.with_name(f"{path.stem}.{number:03d}{path.suffix}")
    return free


def _file(modifier: Modifier) -> Path | None:
    """The file that a cache's modifier plays."""
    held = modifier.cache_file if modifier.type == "MESH_SEQUENCE_CACHE" else modifier
    return None if held is None else Path(bpy.path.abspath(held.filepath))


def _kept(things: Sequence[Object], number: int) -> dict[Object, PropertyGroup]:
    """What the objects of a head have of an earlier bake."""
    every = ((thing, item) for thing in things for item in thing.facial_retarget.kept_bakes)
    found = {thing: item for thing, item in every if item.number == number}
    if things[0] not in found:
        raise RetargetError(f"object {things[0].name!r} keeps no earlier bake of number {number}")
    return found


def _forget(things: Sequence[Object], number: int) -> None:
    """Take an earlier bake off the lists, and its action with it where nothing else uses it."""
    actions = set()
    for thing in things:
        kept = thing.facial_retarget.kept_bakes
        for row in reversed(range(len(kept))):
            if kept[row].number == number:
                actions.add(kept[row].action)
                kept.remove(row)
    for action in actions - {None}:
        action.use_fake_user = False
        if not action.users:
            bpy.data.actions.remove(action)


def _check_there(thing: Object, item: PropertyGroup) -> None:
    keys = thing.data.shape_keys
    there = set() if keys is None else set(keys.key_blocks.keys())
    lost = [name for name in (*item.kept.split("\n"), *item.moved.split("\n")) if name and name not in there]
    if lost:
        raise RetargetError(f"shape key {lost[0]!r} of {item.name!r} is gone from object {thing.name!r}")
    if item.modifier and thing.modifiers.get(item.modifier) is None:
        raise RetargetError(f"modifier {item.modifier!r} of {item.name!r} is gone from object {thing.name!r}")


def _keep_modifier(thing: Object, item: PropertyGroup) -> None:
    modifier = cache_modifier(thing)
    if modifier is not None:
        modifier.name = f"{MODIFIER} {item.number}"
        modifier.show_viewport = modifier.show_render = False
        item.modifier = modifier.name


def _play_modifier(thing: Object, item: PropertyGroup) -> None:
    if item.modifier:
        modifier = thing.modifiers[item.modifier]
        modifier.name = MODIFIER
        modifier.show_viewport = modifier.show_render = True
        thing.modifiers.move(thing.modifiers.find(modifier.name), 0)


def _keep_keys(thing: Object, item: PropertyGroup, action: Action | str) -> Action | None:
    """Turn an object's baked keys off; returns the action that has their curves: this one, or a new one so named."""
    keys = thing.data.shape_keys
    baked, moved = baked_keys(thing), moved_keys(thing)
    if not baked and not moved:
        return None
    taken = set(keys.key_blocks.keys())
    names = {}
    for name in baked:
        wanted = shortened(f"bake_{item.number}_{name}", LONGEST)
        names[name] = free_name(wanted, taken) if wanted in taken else wanted
        taken.add(names[name])
    item.keys, item.kept, item.moved = "\n".join(names), "\n".join(names.values()), "\n".join(moved)
    paths = {value_path(old): value_path(new) for old, new in names.items()}
    paths |= {value_path(name): value_path(name) for name in moved} | ({EVALUATION: EVALUATION} if baked else {})
    bag = find_curves(keys)
    if bag is not None and any(curve.data_path in paths for curve in bag.fcurves):
        if isinstance(action, str):
            action = bpy.data.actions.new(action)
            action.use_fake_user = True
        slot = action.slots.new(id_type="KEY", name=keys.name)
        item.action, item.slot = action, slot.identifier
        _copy_curves(bag, ensure_bag(action, slot), paths)
        remove_curves(bag, set(paths))
    there = {key.name: key for key in keys.key_blocks}
    for old, new in names.items():
        there[old].name, there[old].mute = new, True
    for name in moved:
        keys.key_blocks[name].value = 0.0
    if baked:
        keys.use_relative = True
    record_bake(thing, ())
    thing.data.update()
    return item.action


def _play_keys(thing: Object, item: PropertyGroup, shared: Action | None) -> Action | None:
    """Turn an object's kept keys on; returns the action that has their curves: its own, or the head's."""
    keys = thing.data.shape_keys
    if keys is None or not (item.kept or item.moved):
        return None
    moved = item.moved.split("\n") if item.moved else []
    paths = {value_path(name): value_path(name) for name in moved} | {EVALUATION: EVALUATION}
    played, there = [], {key.name: key for key in keys.key_blocks}
    for old, new in zip(item.kept.split("\n"), item.keys.split("\n"), strict=True) if item.kept else ():
        key = there[old]
        key.name, key.mute = new, False
        played.append(key.name)  # Blender numbers it where the artist has taken the name
        paths[value_path(old)] = value_path(key.name)
    if item.kept:
        keys.use_relative = item.kind != "absolute"
    record_bake(thing, played, moved)
    thing.data.update()
    if keys.animation_data is not None and keys.animation_data.action == item.action:
        return item.action  # the artist has chosen it by hand, and Blender has renamed what its curves move
    slot = None if item.action is None else item.action.slots.get(item.slot)
    kept = None if slot is None else find_bag(item.action, slot)
    if kept is None:
        return None
    bag = ensure_curves(keys, f"{keys.name} retargeted", shared)
    remove_curves(bag, set(paths.values()))
    _copy_curves(kept, bag, paths)  # a copy of the object may keep the same action
    return keys.animation_data.action


def _copy_curves(one: ActionChannelbag, other: ActionChannelbag, paths: dict[str, str]) -> None:
    """Copy the curves of some data paths from one place to another, under other paths."""
    for curve in one.fcurves:
        if curve.data_path in paths:
            copy_curve(curve, other, paths[curve.data_path])
