"""Shape keys of the standard's expressions, visemes, ARKit shapes and FAPs, out of a face's feature points."""

from __future__ import annotations

from collections.abc import Collection
from typing import NamedTuple

from bpy.types import Object

from ...core.acting.expression_sets import expression_shapes, still_shapes
from ...core.arrays import FloatArray, Progress
from ..background import Steps, in_thread, part
from ..shape_keys import ensure_key, find_key, key_displacement
from .fap_faces import fit_steps, write_shapes


class MadeShapes(NamedTuple):
    """Names of the shape keys that were written, kept as they were, and that nothing moves: the points are missing."""

    made: list[str]
    kept: list[str]
    still: list[str]


def make_shapes_steps(thing: Object, sets: Collection[str], replace: bool) -> Steps[MadeShapes]:
    """Give a face the shape keys of some sets (`core.mpeg4.sets.SETS`); those that it cannot show stay empty.

    Parameters
    ----------
    replace : whether a key of the same name that moves something already is replaced.

    Raises
    ------
    RetargetError : as `fit_steps`.
    """
    face = yield from part(fit_steps(thing), 0.0, 0.9)

    def show(progress: Progress) -> dict[str, FloatArray]:
        return expression_shapes(face, tuple(sets))

    shapes = yield from part(in_thread(show), 0.9, 0.05)
    yield 0.95, "Writing"
    kept = [] if replace else [name for name in shapes if is_shaped(thing, name)]
    made = {name: positions for name, positions in shapes.items() if name not in kept}
    still = still_shapes(face, tuple(sets))
    write_shapes(thing, made)
    for name in still:
        ensure_key(thing, name)
    return MadeShapes(list(made), kept, still)


def is_shaped(thing: Object, name: str) -> bool:
    """Whether there is a shape key of this name, and it moves something."""
    key = find_key(thing, name)
    return key is not None and bool(key_displacement(key).any())
