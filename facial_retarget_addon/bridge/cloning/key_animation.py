"""Animation of shape keys, copied to the same keys of another head: the action's curves and the NLA's tracks."""

from __future__ import annotations

from collections.abc import Iterable

import bpy
from bpy.types import Action, ActionSlot, Key, NlaStrip, NlaTrack, Object

from ..curves import ensure_bag, ensure_curves, find_bag, find_curves, remove_curves
from ..shape_keys import key_curves, key_path
from .curve_copies import copy_curve, copy_keyframes, copy_properties
from .key_drivers import Renamed

# In this order: Blender works out some of them from those before, and the ends without rounding at last.
STRIP = (
    *("extrapolation", "blend_type", "use_auto_blend", "mute", "use_reverse", "use_animated_influence", "influence"),
    *("action_frame_start", "action_frame_end", "scale", "repeat", "frame_start_raw", "frame_end_raw"),
    *("blend_in", "blend_out"),
)


def copy_animation(source: Object, target: Object, renamed: Renamed, face: Object) -> list[str]:
    """Copy how some keys are animated; curves that those keys have on the target already go.

    All objects of a head share an action, in which each has its slot: glTF then has one animation for the head.

    Parameters
    ----------
    face : the face object of the target's head.
    renamed : target key -> source key, of those to copy.

    Returns
    -------
    What could not be copied, a clause each.
    """
    keys, own = source.data.shape_keys, target.data.shape_keys
    if keys is None or keys.animation_data is None:
        return []
    bag = find_curves(keys)
    found = {} if bag is None else {new: key_curves(bag.fcurves, old) for new, old in renamed.items()}
    if any(found.values()):
        animation = face.data.shape_keys.animation_data
        written = ensure_curves(own, f"{face.name} cloned", animation.action if animation is not None else None)
        for new, curves in found.items():
            for curve in curves:
                path = key_path(new) + curve.data_path[len(key_path(renamed[new])) :]
                if (written, path) != (bag, curve.data_path):
                    remove_curves(written, {path})
                    copy_curve(curve, written, path)
    return _copy_tracks(keys, own, renamed)


def _copy_tracks(keys: Key, own: Key, renamed: Renamed) -> list[str]:
    """Copy the NLA's tracks that move some keys; the target's tracks of the same name stay, and are said."""
    if not keys.animation_data.nla_tracks:
        return []
    animation = own.animation_data or own.animation_data_create()
    unable: list[str] = []
    copies: dict[tuple[Action, str], Action] = {}
    for track in keys.animation_data.nla_tracks:
        strips = [strip for strip in track.strips if _moves(strip, renamed.values())]
        if any(strip.type != "CLIP" for strip in track.strips):
            unable.append(f"strips of NLA track {track.name!r} that are no clips are left out")
        if strips and track.name in animation.nla_tracks:
            unable.append(f"NLA track {track.name!r} of {own.name!r} stays as it is")
        elif strips:
            made = animation.nla_tracks.new()
            copy_properties(track, made, ("name", "mute", "lock"))
            for strip in strips:
                action = strip.action, strip.action_slot.identifier
                if action not in copies:
                    copies[action] = _renamed_action(strip.action, strip.action_slot, renamed)
                _copy_strip(strip, made, copies[action])
    return unable


def _moves(strip: NlaStrip, names: Iterable[str]) -> bool:
    """Whether a strip plays an action that moves one of some keys."""
    if strip.action is None or strip.action_slot is None:
        return False
    bag = find_bag(strip.action, strip.action_slot)
    return bag is not None and any(key_curves(bag.fcurves, name) for name in names)


def _renamed_action(action: Action, slot: ActionSlot, renamed: Renamed) -> Action:
    """A new action like one slot of another, whose curves move the copied keys and nothing else."""
    made = bpy.data.actions.new(action.name)
    bag = ensure_bag(made, made.slots.new(id_type=slot.target_id_type, name=slot.name_display))
    for new, old in renamed.items():
        for curve in key_curves(find_bag(action, slot).fcurves, old):
            copy_curve(curve, bag, key_path(new) + curve.data_path[len(key_path(old)) :])
    return made


def _copy_strip(strip: NlaStrip, track: NlaTrack, action: Action) -> None:
    made = track.strips.new(strip.name, round(strip.frame_start), action)
    made.action_slot = action.slots[0]
    copy_properties(strip, made, STRIP)
    for curve in strip.fcurves:
        own = made.fcurves.find(curve.data_path)
        if own is not None:
            own.keyframe_points.clear()
            copy_keyframes(curve, own)
