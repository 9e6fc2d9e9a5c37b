"""Example expressions: the shape keys of one name on both faces."""

from __future__ import annotations

import numpy as np
from bpy.types import Object, PropertyGroup

from ...core.arrays import FloatArray
from ...core.errors import RetargetError
from ...core.example_states import is_sculpted
from ...core.mpeg4.expressions import EXPRESSIONS
from ..heads import Head
from ..shape_keys import ensure_key, find_key, key_displacement, write_key


def create_examples(task: PropertyGroup) -> None:
    """List the seven examples, and give both faces the shape keys that they lack: the Basis is the neutral one."""
    for name in EXPRESSIONS:
        if name not in task.examples:
            task.examples.add().name = name
        for thing in (task.source, task.target):
            ensure_key(thing, name)


def chosen_example(task: PropertyGroup, name: str = "") -> str:
    """The name of an example on the list, the chosen row's if none is given.

    Raises
    ------
    RetargetError : if the list has no such example.
    """
    row = task.active_example
    name = name or (task.examples[row].name if row in range(len(task.examples)) else "")
    if name not in task.examples:
        raise RetargetError(f"example {name!r} is not on the list of {len(task.examples)}, expected one that is")
    return name


def write_example(thing: Object, name: str, positions: FloatArray) -> None:
    """Set the shape key of an example: positions (V, 3) in the object's own coordinates."""
    write_key(ensure_key(thing, name), positions)


def read_examples(
    task: PropertyGroup, source: Head, target: Head
) -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
    """Displacements (V, 3) of the examples on the task's source and target, in the heads' coordinates, float64.

    An example that moves neither face is not sculpted yet: it is left out.

    Raises
    ------
    RetargetError : if an example is missing on one face, or sculpted on one face only.
    """
    on_source: dict[str, FloatArray] = {}
    on_target: dict[str, FloatArray] = {}
    for example in task.examples:
        ours, theirs = (example_moves(head, example.name) for head in (source, target))
        here, there = (is_sculpted(moves, head.face.mesh.size) for moves, head in ((ours, source), (theirs, target)))
        if here and there:
            on_source[example.name], on_target[example.name] = ours, theirs
        elif here or there:
            still = target if here else source
            raise RetargetError(
                f"example {example.name!r} moves no vertex of object {still.name!r}, expected it sculpted on both faces"
            )
    return on_source, on_target


def example_moves(head: Head, name: str) -> FloatArray:
    """(V, 3) float64 displacements of an example on a head, in its coordinates.

    Raises
    ------
    RetargetError : if none of its objects has the shape key.
    """
    if name not in head.key_names():
        raise RetargetError(f"object {head.name!r} has no shape key {name!r}, expected one for the example")
    moves = np.zeros((head.starts[-1], 3))
    for thing, own, matrix in head.slices():
        key = find_key(thing, name)
        if key is not None:
            moves[own] = key_displacement(key) @ matrix.T
    return moves
