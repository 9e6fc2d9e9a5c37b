"""Shape keys that bear ARKit's names, in the usual spellings."""

from __future__ import annotations

import re

from bpy.types import Object

from ...core.mpeg4.arkit import ARKIT_NAMES
from ...core.shapes.sides import arkit_merges
from ..key_sets import key_names

_SIDES = {"_l": "left", "_r": "right"}


def find_arkit_keys(thing: Object) -> dict[str, str]:
    """ARKit's name -> the object's shape key of that name, in the order of a Live Link Face table.

    Capitals do not matter, nor whether a side is spelled out: jawOpen and JawOpen, eyeBlinkLeft and eyeBlink_L.
    """
    keys = thing.data.shape_keys
    if keys is None:
        return {}
    spelled = {_spelling(name): name for name in reversed(keys.key_blocks.keys())}
    exact = set(keys.key_blocks.keys())
    found = {name: name if name in exact else spelled.get(_spelling(name)) for name in ARKIT_NAMES}
    return {name: key for name, key in found.items() if key is not None}


def find_arkit_halves(thing: Object) -> dict[str, tuple[str, ...]]:
    """ARKit's name -> the object's two shape keys, for shapes without sides that it has as a left and a right half.

    Heads are often built so: browInnerUp_L and browInnerUp_R, cheekPuff_L and cheekPuff_R.
    """
    whole = find_arkit_keys(thing)
    return {name: halves for name, halves in arkit_merges(key_names(thing)).items() if name not in whole}


def _spelling(name: str) -> str:
    """A name in small letters alone, its side in full."""
    small = name.lower()
    return re.sub(r"[\W_]", "", small[:-2] + _SIDES.get(small[-2:], small[-2:]))
