"""Which shapes the panel wants cloned, what is made of them, and where each of those that are made comes from."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from bpy.types import PropertyGroup

from ...core.shapes.choose import EVERY, chosen
from ...core.shapes.names import arkit_name
from ...core.shapes.prepare import Preparation
from ...core.shapes.sides import arkit_merges, has_side, side_names


class Origin(NamedTuple):
    """The donor's shapes that a cloned one comes from: added up, and cut to a half unless the side is WHOLE."""

    names: tuple[str, ...]
    side: str = "WHOLE"


def preparation(cloning: PropertyGroup) -> Preparation:
    """What the panel wants made of a donor's shapes."""
    return Preparation(
        keep=_patterns(cloning.keep) or EVERY,
        drop=_patterns(cloning.drop),
        arkit_wholes=cloning.sides == "MERGE",
        split=EVERY if cloning.sides == "SPLIT" else (),
        feather=round(cloning.feather, 6),  # Blender keeps float32
        arkit_names=cloning.arkit_names,
    )


def wanted_names(names: Sequence[str], cloning: PropertyGroup) -> tuple[str, ...]:
    """Those of a donor's shapes that the panel wants.

    Raises
    ------
    RetargetError : for patterns that match no name, or if nothing is left.
    """
    return chosen(names, _patterns(cloning.keep) or EVERY, _patterns(cloning.drop))


def origins(names: Sequence[str], how: Preparation) -> dict[str, Origin]:
    """What `prepare_shapes` makes of some wanted shapes -> where it comes from."""
    found = {name: Origin((name,)) for name in names}
    if how.arkit_wholes:
        wholes = arkit_merges(names)
        gone = {half for halves in wholes.values() for half in halves}
        found = {name: origin for name, origin in found.items() if name not in gone}
        found |= {whole: Origin(halves) for whole, halves in wholes.items()}
    if how.split:
        left, right = side_names(list(found))
        cut = {name: origin.names for name, origin in found.items() if not has_side(name)}
        found = {name: origin for name, origin in found.items() if name not in cut}
        found |= {name + left: Origin(old, "LEFT") for name, old in cut.items()}
        found |= {name + right: Origin(old, "RIGHT") for name, old in cut.items()}
    return {arkit_name(name) or name: one for name, one in found.items()} if how.arkit_names else found


def _patterns(text: str) -> tuple[str, ...]:
    """Patterns that stand in a text with commas between them."""
    return tuple(word.strip() for word in text.split(",") if word.strip())
