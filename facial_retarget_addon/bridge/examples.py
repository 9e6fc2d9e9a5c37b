"""Example expressions: the shape keys of one name on both faces."""

from __future__ import annotations

import numpy as np
from bpy.types import Object, PropertyGroup

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from .bake import ensure_key
from .meshes import to_face_space

EXPRESSIONS = ("joy", "sadness", "anger", "fear", "disgust", "surprise")
"""With the Basis, which is the neutral, the seven examples of Na and Jung."""


def create_examples(task: PropertyGroup) -> None:
    """List the seven examples, and give both faces the shape keys that they lack."""
    for name in EXPRESSIONS:
        if name not in task.examples:
            task.examples.add().name = name
        for thing in (task.source, task.target):
            ensure_key(thing, name)


def write_example(thing: Object, name: str, positions: FloatArray) -> None:
    """Set the shape key of an example: positions (V, 3) in the object's own coordinates."""
    ensure_key(thing, name).points.foreach_set("co", np.ascontiguousarray(positions, np.float32).ravel())


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
    keys = thing.data.shape_keys
    key = keys.key_blocks.get(name) if keys is not None else None
    if key is None:
        raise RetargetError(f"object {thing.name!r} has no shape key {name!r}, expected one for the example")
    start, end = (np.empty(3 * len(thing.data.vertices), np.float32) for _ in range(2))
    key.relative_key.points.foreach_get("co", start)
    key.points.foreach_get("co", end)
    return to_face_space(thing, (end.astype(np.float64) - start).reshape(-1, 3))
