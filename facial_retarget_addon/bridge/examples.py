"""Example expressions: the shape keys of one name on both faces."""

from __future__ import annotations

from bpy.types import Object, PropertyGroup

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from ..core.mpeg4.expressions import EXPRESSIONS
from .meshes import to_face_space
from .shape_keys import ensure_key, find_key, key_displacement, write_key


def create_examples(task: PropertyGroup) -> None:
    """List the seven examples, and give both faces the shape keys that they lack: the Basis is the neutral one."""
    for name in EXPRESSIONS:
        if name not in task.examples:
            task.examples.add().name = name
        for thing in (task.source, task.target):
            ensure_key(thing, name)


def write_example(thing: Object, name: str, positions: FloatArray) -> None:
    """Set the shape key of an example: positions (V, 3) in the object's own coordinates."""
    write_key(ensure_key(thing, name), positions)


def read_examples(task: PropertyGroup) -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
    """Displacements (V, 3) of the examples on source and target, in face space, float64.

    An example that moves neither face is not sculpted yet: it is left out.

    Raises
    ------
    RetargetError : if an example is missing on one face, or sculpted on one face only.
    """
    source: dict[str, FloatArray] = {}
    target: dict[str, FloatArray] = {}
    for example in task.examples:
        on_source, on_target = (_displacement(thing, example.name) for thing in (task.source, task.target))
        if on_source.any() and on_target.any():
            source[example.name], target[example.name] = on_source, on_target
        elif on_source.any() or on_target.any():
            still = task.target if on_source.any() else task.source
            raise RetargetError(
                f"example {example.name!r} moves no vertex of object {still.name!r}, expected it sculpted on both faces"
            )
    return source, target


def _displacement(thing: Object, name: str) -> FloatArray:
    key = find_key(thing, name)
    if key is None:
        raise RetargetError(f"object {thing.name!r} has no shape key {name!r}, expected one for the example")
    return to_face_space(thing, key_displacement(key))
