"""The list of a head's parts, and what an object is by its name."""

from __future__ import annotations

import re
from collections.abc import Iterable

from bpy.types import Object

from .heads import BY_PLACE

_UPPER, _LOWER = r"upper|top|maxill", r"lower|bottom|mandib"
_TEETH, _EYE = r"teeth|tooth|gum|dentur", r"eye|cornea|iris|pupil|sclera"
_LEFT, _RIGHT = r"left|(?<![a-z])l(?![a-z])", r"right|(?<![a-z])r(?![a-z])"
ROLES_BY_NAME = (
    ("lashes", ("lash",)),
    ("brows", ("brow",)),
    ("moustache", ("moustache|mustache",)),
    ("beard", ("beard",)),
    ("tongue", ("tongue",)),
    ("upper teeth", (_TEETH, _UPPER)),
    ("lower teeth", (_TEETH, _LOWER)),
    ("left eyeball", (_EYE, _LEFT)),
    ("right eyeball", (_EYE, _RIGHT)),
)
"""Role -> what the name of an object of that role holds, all of it; the first that fits counts."""


def role_of_name(name: str) -> str:
    """The role that an object's name tells, such as eye.L or Teeth_Upper; `BY_PLACE` if it tells none."""
    small = name.lower()
    fits = (role for role, words in ROLES_BY_NAME if all(re.search(word, small) for word in words))
    return next(fits, BY_PLACE)


def add_parts(face: Object, things: Iterable[Object]) -> int:
    """List objects as parts of a face's head, with the roles that their names tell; returns how many are new."""
    listed = {part.thing for part in face.facial_retarget.parts}
    new = [thing for thing in things if thing.type == "MESH" and thing != face and thing not in listed]
    for thing in new:
        part = face.facial_retarget.parts.add()
        part.name, part.thing, part.role = thing.name, thing, role_of_name(thing.name)
    return len(new)
