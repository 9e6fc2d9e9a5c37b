"""The shape keys of a head as a file, and back: a facial animation table (.json), arrays (.npz), a folder of .obj."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from bpy.types import Object

from ...core.errors import RetargetError
from ...core.shapes.shape_set import ShapeSet
from ...files.animation_table import read_table_parameters
from ...files.shape_files import add_shapes, read_shapes
from ...files.whole import written_whole
from ..heads import read_head
from ..key_sets import KeyTraits, check_editable
from .head_shapes import plan_names, put_shapes


class Loaded(NamedTuple):
    """How many shape keys were made, and how many were kept as they were."""

    made: int
    kept: int


def save_shapes(face: Object, path: Path) -> int:
    """Write the shape keys of a face and its parts, vertex after vertex in this order; returns how many.

    Raises
    ------
    RetargetError : if there are none, or the file cannot be written.
    """
    head = read_head(face)
    names = head.key_names()
    if not names:
        raise RetargetError(f"object {face.name!r} has no shape keys beside its Basis, expected some to save")
    shapes = ShapeSet(tuple(names), head.displacements(names))
    with written_whole() as aside:
        add_shapes(aside, shapes, path, head.file)
    return len(names)


def load_shapes(face: Object, path: Path, existing: str) -> Loaded:
    """Give a face and its parts the shapes of a file. What may go both ways, such as a FAP, has a slider that does.

    Parameters
    ----------
    existing : KEEP, REPLACE or SUFFIX.

    Raises
    ------
    RetargetError : if the file cannot be read, or is of another head.
    """
    head = read_head(face)
    for thing in head.things:
        check_editable(thing)
    traits: dict[str, KeyTraits] = {}
    if path.suffix.lower() == ".json":
        shapes, parameters = read_table_parameters(path, len(head.face.mesh.vertices))
        ends = {name: (one.low / one.high, 1.0) for name, one in parameters.items() if one.low < 0 < one.high}
        traits = {name: KeyTraits(*ends.get(name, (0.0, 1.0))) for name in parameters}
    else:
        shapes = read_shapes(path, head.face.mesh)
    plan = plan_names(head, shapes.names, existing)
    put_shapes(head, shapes, plan, {name: traits[shape] for name, shape in plan.items() if shape in traits})
    return Loaded(len(plan), len(shapes) - len(plan))
