"""What ARKit calls a shape, whatever an artist calls it."""

from __future__ import annotations

import re

from ..mpeg4.arkit import ARKIT_NAMES

_NUMBERED = re.compile(r"[A-Z]{2}_\d{2}_(?=[A-Z])")
"""Prefix of a numbered set, such as AK_27_MouthClose."""
_SIDED = re.compile(r"(?P<base>.+?)[_. -]?(?P<side>Left|Right|left|right|(?<=[_. -])[LRlr]|(?<=[a-z])[LR])")
_SIDES = {"l": "Left", "r": "Right"}
_SPELLINGS = {"mouthclosed": "mouthclose", "mouthfrom": "mouthfrown", "eyeblinking": "eyeblink"}
"""Other spellings that are in use."""
_ARKIT = {name.lower(): name for name in ARKIT_NAMES}
_WHOLE = {name for name in ARKIT_NAMES if not name.endswith(("Left", "Right"))}


def arkit_name(name: str) -> str | None:
    """The ARKit shape that an artist's name stands for, or None.

    Capitals, `_L` and `.R` for the side, numbered prefixes (`AK_27_MouthClose`) and common spellings do not matter. A
    half of a shape that ARKit has as a whole, such as `browInnerUp_L`, is none.
    """
    text = _NUMBERED.sub("", name.strip())
    sided = _SIDED.fullmatch(text)
    base, side = (sided["base"], _SIDES[sided["side"][0].lower()]) if sided else (text, "")
    base = re.sub(r"[_. -]", "", base).lower()
    return _ARKIT.get(_SPELLINGS.get(base, base) + side.lower())


def arkit_whole(name: str) -> str | None:
    """The ARKit shape without sides that a name is a half of, such as `browInnerUp_L`; None for others."""
    sided = _SIDED.fullmatch(_NUMBERED.sub("", name.strip()))
    whole = arkit_name(sided["base"]) if sided and arkit_name(name) is None else None
    return whole if whole in _WHOLE else None
