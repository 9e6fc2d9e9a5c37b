"""Names of what a bake makes, and which shape keys an earlier one has made."""

from __future__ import annotations

import re
from collections.abc import Iterable

from bpy.types import Modifier, Object

from ...core.errors import RetargetError

RECORD = "facial_retarget_baked"
"""Property of a shape-key block: the names of the keys that a bake has made, one a line."""
MOVED = "facial_retarget_moved"
"""The same for the keys that were there, and that a bake has given curves."""
MODIFIER = "Facial Retarget"
"""Name of the modifier that plays the cache of a bake."""
LONGEST = 63
"""Bytes of a name that Blender keeps."""


def frame_key_name(pattern: str, frame: float) -> str:
    """Name of the shape key of a scene frame: the # of a pattern become its digits, a part of a frame follows them.

    Raises
    ------
    RetargetError : if the pattern has no # or a line break, or the name is longer than Blender keeps.
    """
    holes = re.search("#+", pattern)
    if holes is None:
        raise RetargetError(f"the pattern of names {pattern!r} has no #, expected some where the frame's number goes")
    if "\n" in pattern:
        raise RetargetError(f"the pattern of names {pattern!r} has a line break, expected a single line")
    whole, part = divmod(abs(frame), 1)
    sign = "-" if frame < 0 else ""
    digits = f"{sign}{int(whole):0{max(len(holes.group()) - len(sign), 1)}d}"
    digits += f"{part:.3f}"[1:].rstrip("0") if part else ""
    name = pattern[: holes.start()] + digits + pattern[holes.end() :]
    if len(name.encode()) > LONGEST:
        raise RetargetError(f"shape key {name!r} has a name of {len(name.encode())} bytes, expected at most {LONGEST}")
    return name


def baked_keys(thing: Object) -> list[str]:
    """Names of an object's shape keys that a bake has made."""
    keys = thing.data.shape_keys
    if keys is None:
        return []
    recorded = set(str(keys.get(RECORD, "")).split("\n"))
    return [key.name for key in keys.key_blocks if key.name in recorded]


def check_free(thing: Object, names: Iterable[str]) -> None:
    """RetargetError if a bake would write over a shape key of the artist's own."""
    keys = thing.data.shape_keys
    own = set() if keys is None else set(keys.key_blocks.keys()) - set(baked_keys(thing))
    taken = next((name for name in names if name in own), None)
    if taken is not None:
        raise RetargetError(
            f"object {thing.name!r} has a shape key {taken!r} of its own, which the bake would replace; expected "
            "another name"
        )


def kept_keys(thing: Object) -> list[str]:
    """Names of an object's shape keys that belong to earlier bakes which are kept, muted."""
    return [name for item in thing.facial_retarget.kept_bakes for name in item.kept.split("\n") if name]


def moved_keys(thing: Object) -> list[str]:
    """Names of an object's own shape keys that a bake has given curves."""
    keys = thing.data.shape_keys
    if keys is None:
        return []
    return [name for name in str(keys.get(MOVED, "")).split("\n") if name in keys.key_blocks]


def cache_modifier(thing: Object) -> Modifier | None:
    """The modifier that plays the cache of a bake."""
    modifier = thing.modifiers.get(MODIFIER)
    return modifier if modifier is not None and modifier.type in ("MESH_CACHE", "MESH_SEQUENCE_CACHE") else None


def record_bake(thing: Object, names: Iterable[str], moved: Iterable[str] = ()) -> None:
    """Remember which shape keys a bake has made on an object, and which of its own it has given curves."""
    keys = thing.data.shape_keys
    there = set(keys.key_blocks.keys())
    keys[RECORD] = "\n".join(name for name in names if name in there)
    keys[MOVED] = "\n".join(moved)
