"""A set of shapes put on the objects of a head: what each key is called, and which object gets it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from bpy.types import Object

from ...core.arrays import FloatArray
from ...core.errors import RetargetError
from ...core.shapes.clone import STILL
from ...core.shapes.shape_set import ShapeSet
from ..background import Steps
from ..heads import Head
from ..key_sets import KeyTraits, free_name, key_names, shortened, write_keys
from ..motion.expression_keys import is_shaped
from ..shape_keys import find_key

Plan = Mapping[str, str]
"""Name of a shape key to write -> the shape that it gets."""
TOGETHER = 16
"""Shape keys that are read in one step."""


def read_shapes_steps(head: Head, names: Sequence[str]) -> Steps[ShapeSet]:
    """The shapes of some of a head's keys; RetargetError as `Head.displacements`."""
    moves = np.empty((len(names), head.starts[-1], 3), np.float32)
    for first in range(0, len(names), TOGETHER):
        yield first / len(names), "Reading"
        some = names[first : first + TOGETHER]
        moves[first : first + len(some)] = head.displacements(some)
    return ShapeSet(tuple(names), moves)


def plan_names(head: Head, shapes: Sequence[str], existing: str) -> dict[str, str]:
    """What each shape is to be called on a head, and which are written at all.

    Parameters
    ----------
    existing : KEEP, REPLACE or SUFFIX.

    Raises
    ------
    RetargetError : if a shape has the name of an object's Basis.
    """
    taken = {name for thing in head.things for name in key_names(thing)}
    bases = {thing.data.shape_keys.reference_key.name: thing for thing in head.things if thing.data.shape_keys}
    plan: dict[str, str] = {}
    for shape in shapes:
        name = shortened(shape)
        if name in bases:
            raise RetargetError(f"the Basis of object {bases[name].name!r} has the name of shape {shape!r}; rename one")
        if name in plan or (existing == "SUFFIX" and name in taken):
            name = free_name(name, taken | plan.keys())
        if existing != "KEEP" or not any(is_shaped(thing, name) for thing in head.things):
            plan[name] = shape
    return plan


def put_shapes(head: Head, shapes: ShapeSet, plan: Plan, traits: Mapping[str, KeyTraits]) -> dict[Object, list[str]]:
    """Set shape keys of every object of a head that they move; returns which keys are on which object.

    The face object gets all of them. Keys without traits keep what they have.
    """
    written: dict[Object, list[str]] = {}
    for thing, own, matrix in head.slices():
        far = np.abs(shapes.displacements[:, own]).max(axis=(1, 2), initial=0.0)
        moving = dict(zip(shapes.names, far > STILL * head.face.mesh.size, strict=True))
        names = [n for n in plan if thing == head.things[0] or moving[plan[n]] or find_key(thing, n) is not None]
        if names:
            inverse = np.linalg.inv(matrix).T
            moves: dict[str, FloatArray] = {name: shapes[plan[name]][own] @ inverse for name in names}
            write_keys(thing, moves, traits)
            written[thing] = names
    return written
