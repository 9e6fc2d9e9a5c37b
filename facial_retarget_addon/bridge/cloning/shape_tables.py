"""The shape keys of a head as a file, and back: a facial animation table (.json), arrays (.npz), a folder of .obj."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from bpy.types import Object

from ...core.arrays import Progress
from ...core.errors import RetargetError
from ...core.shapes.shape_set import ShapeSet
from ...files.animation_table import read_table_parameters
from ...files.shape_files import add_shapes, read_shapes
from ...files.whole import Aside, appear_whole, written_aside
from ..background import Steps, in_thread, part
from ..heads import read_head
from ..key_sets import KeyTraits, check_editable
from .head_shapes import plan_names, put_shapes, read_shapes_steps


class Loaded(NamedTuple):
    """How many shape keys were made, and how many were kept as they were."""

    made: int
    kept: int


def save_shapes_steps(face: Object, path: Path) -> Steps[int]:
    """Write the shape keys of a face and its parts, vertex after vertex in this order; gives how many.

    Closing the steps at any time leaves no file behind.

    Raises
    ------
    RetargetError : if there are none, or the file cannot be written.
    """
    head = read_head(face)
    names = head.key_names()
    if not names:
        raise RetargetError(f"object {face.name!r} has no shape keys beside its Basis, expected some to save")
    shapes = yield from part(read_shapes_steps(head, names), 0.0, 0.3)

    def write(progress: Progress) -> Aside:
        progress(0.0, "Writing")
        with written_aside() as aside:
            add_shapes(aside, shapes, path, head.file)
            progress(1.0, "Writing")
        return aside

    # Nothing appears before the artist can no longer stop it.
    appear_whole((yield from part(in_thread(write, Aside.vanish), 0.3, 0.7)))
    return len(names)


def load_shapes_steps(face: Object, path: Path, existing: str) -> Steps[Loaded]:
    """Give a face and its parts the shapes of a file. What may go both ways, such as a FAP, has a slider that does.

    Closing the steps at any time leaves the face as it was: everything is written at the very end.

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

    def read(progress: Progress) -> tuple[ShapeSet, dict[str, KeyTraits]]:
        progress(0.0, "Reading")
        if path.suffix.lower() != ".json":
            return read_shapes(path, head.face.mesh), {}
        shapes, parameters = read_table_parameters(path, len(head.face.mesh.vertices))
        ends = {name: (one.low / one.high, 1.0) for name, one in parameters.items() if one.low < 0 < one.high}
        return shapes, {name: KeyTraits(*ends.get(name, (0.0, 1.0))) for name in parameters}

    shapes, traits = yield from part(in_thread(read), 0.0, 0.9)
    yield 0.9, "Writing"
    plan = plan_names(head, shapes.names, existing)
    put_shapes(head, shapes, plan, {name: traits[shape] for name, shape in plan.items() if shape in traits})
    return Loaded(len(plan), len(shapes) - len(plan))
