"""Correctives: shapes that mean something only together with others, such as mouthClose with jawOpen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from ..arrays import FloatArray
from .names import arkit_name, arkit_whole
from .shape_set import ShapeSet

ARKIT_CORRECTIVES: dict[str, tuple[str, ...]] = {"mouthClose": ("jawOpen",)}
"""ARKit shape -> the shapes that it corrects: it shuts the lips of an open jaw."""


class Corrective(NamedTuple):
    """A shape, and those that are at full strength whenever it is."""

    name: str
    needs: tuple[str, ...]


def find_correctives(names: Sequence[str], own: Mapping[str, Sequence[str]] | None = None) -> tuple[Corrective, ...]:
    """The correctives among some shapes: ARKit's in any common spelling, halves of them, and the artist's own.

    Parameters
    ----------
    own : name -> what it needs; an empty list says that the shape stands by itself.
    """
    spelled = {known: name for name in reversed(names) if (known := arkit_name(name)) is not None}
    found: dict[str, tuple[str, ...]] = {}
    for name in names:
        needs = ARKIT_CORRECTIVES.get(arkit_name(name) or arkit_whole(name) or "", ())
        if needs:
            found[name] = tuple(spelled.get(need, need) for need in needs)
    found |= {name: tuple(needs) for name, needs in (own or {}).items() if name in names}
    return tuple(Corrective(name, needs) for name, needs in found.items() if needs)


def complete(correctives: Sequence[Corrective], names: Sequence[str]) -> tuple[Corrective, ...]:
    """Those whose needs are all among the names."""
    return tuple(one for one in correctives if set(one.needs) <= set(names))


def combined(shapes: ShapeSet, correctives: Sequence[Corrective]) -> FloatArray:
    """(E, V, 3) the shapes as they are seen: each corrective with all that it needs added."""
    moves = shapes.displacements.copy()
    for one in correctives:
        moves[shapes.rows([one.name])[0]] += shapes.displacements[shapes.rows(one.needs)].sum(axis=0)
    return moves


def taken_apart(seen: ShapeSet, correctives: Sequence[Corrective]) -> ShapeSet:
    """The shapes of which the correctives are seen with all that they need, by themselves again.

    What a rig adds up is then what was seen: the corrective is the combination less the shapes that it needs.
    """
    alone = seen
    for one in in_order(correctives):
        rest = alone.displacements[alone.rows(one.needs)].sum(axis=0)
        alone = alone.with_shapes(ShapeSet((one.name,), (seen[one.name] - rest)[None]))
    return alone


def in_order(correctives: Sequence[Corrective]) -> list[Corrective]:
    """Each corrective after those that it needs itself; those that need each other keep their order."""
    left, done = list(correctives), list[Corrective]()
    while left:
        waiting = {one.name for one in left}
        ready = [one for one in left if not waiting & set(one.needs)] or left[:1]
        done += ready
        left = [one for one in left if one not in ready]
    return done
