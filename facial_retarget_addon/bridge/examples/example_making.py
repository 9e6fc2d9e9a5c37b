"""Examples made roughly, to be sculpted further: out of a face's points, or cloned from the other face."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from bpy.types import Context, Object

from ...core.acting.expression_sets import expression_shapes
from ...core.arrays import FloatArray, Progress
from ...core.errors import RetargetError
from ...core.example_states import is_sculpted
from ...core.mirroring.mirror import fit_mirror
from ...core.mpeg4.sets import SETS
from ...core.problem import Problem
from ...core.shapes.clone import ClonedShapes, clone_shapes
from ...core.shapes.shape_set import ShapeSet
from ..background import Steps, in_thread, part
from ..cloning.head_shapes import put_shapes
from ..heads import Head, head_parts
from ..key_sets import check_editable, check_targets
from ..motion.fap_faces import fit_steps, write_shapes
from ..raycast import available_caster
from ..settings import read_method_settings
from ..shape_keys import find_key, key_displacement
from ..task import read_heads
from .examples import example_moves


class RoughExamples(NamedTuple):
    """Names of the examples that were made, kept as they were sculpted, and that could not be made; and warnings."""

    made: list[str]
    kept: list[str]
    unable: list[str]
    warnings: list[str]


def rough_out_steps(context: Context, names: Sequence[str], side: str, way: str, replace: bool) -> Steps[RoughExamples]:
    """Make examples on one face of the task; closing the steps at any time leaves it as it was.

    Parameters
    ----------
    side : SOURCE or TARGET, the face that gets them.
    way : POINTS for the face's own feature points, CLONE for what the other face shows.
    replace : whether examples that are sculpted already are made anew.

    Raises
    ------
    RetargetError : if none of them can be made; or as fitting the points and cloning.
    """
    task = context.scene.facial_retarget
    face = task.source if side == "SOURCE" else task.target
    other = task.target if side == "SOURCE" else task.source
    check_targets((other, *head_parts(other)), (face, *head_parts(face)))
    kept = [] if replace else [name for name in names if _is_shown(face, name)]
    wanted = [name for name in names if name not in kept]
    if not wanted:
        raise RetargetError(
            f"{', '.join(kept) or 'no example'} of object {face.name!r} "
            f"{'are' if len(kept) > 1 else 'is'} sculpted already; choose Replace to have it made anew"
        )
    if way == "POINTS":
        made, warnings = yield from _out_of_points(face, wanted)
    else:
        made, warnings = yield from _cloned(context, side, wanted)
    return RoughExamples(made, kept, [name for name in wanted if name not in made], warnings)


def _is_shown(face: Object, name: str) -> bool:
    """Whether any object of a head is moved by a shape key."""
    keys = [find_key(thing, name) for thing in (face, *head_parts(face))]
    return any(bool(key_displacement(key).any()) for key in keys if key is not None)


def _out_of_points(face: Object, names: Sequence[str]) -> Steps[tuple[list[str], list[str]]]:
    sets = [found for found in ("expressions", "visemes", "arkit") if SETS[found].keys() & set(names)]
    if not sets:
        raise RetargetError(
            f"{', '.join(names)}: no expression, viseme or ARKit shape has such a name, expected one that has, "
            "or to be cloned or sculpted"
        )
    fitted = yield from part(fit_steps(face), 0.0, 0.9)

    def show(progress: Progress) -> dict[str, FloatArray]:
        return expression_shapes(fitted, sets)

    shapes = yield from part(in_thread(show), 0.9, 0.05)
    made = {name: shapes[name] for name in names if name in shapes}
    if not made:
        raise RetargetError(f"object {face.name!r} has no feature points that move in {', '.join(names)}")
    write_shapes(face, made)
    return list(made), []


def _cloned(context: Context, side: str, names: Sequence[str]) -> Steps[tuple[list[str], list[str]]]:
    task = context.scene.facial_retarget
    method = task.cloning.method
    settings = read_method_settings(task, method)
    heads = read_heads(context)
    giver, head = heads if side == "TARGET" else heads[::-1]
    moves = _shown_moves(giver, names)
    problem = Problem(giver.face, head.face, make_caster=available_caster())
    shapes = ShapeSet(tuple(moves), np.stack(list(moves.values())).astype(np.float32))

    def clone(progress: Progress) -> ClonedShapes:
        return clone_shapes(method, problem, settings, shapes, progress=progress)

    cloned = yield from part(in_thread(clone), 0.0, 0.95)
    lost = cloned.without_counterpart
    made = [name for name in moves if name not in lost]
    put_shapes(head, cloned.shapes, {name: name for name in made}, {})
    return made, cloned.report["warnings"]


def _shown_moves(head: Head, names: Sequence[str]) -> dict[str, FloatArray]:
    """The displacements of those examples that a head shows."""
    there = [name for name in names if name in head.key_names()]
    moves = {name: example_moves(head, name) for name in there}
    shown = {name: moved for name, moved in moves.items() if is_sculpted(moved, head.face.mesh.size)}
    if not shown:
        raise RetargetError(f"object {head.name!r} shows nothing of {', '.join(names)}, expected it sculpted there")
    return shown


def mirror_steps(context: Context, names: Sequence[str], side: str, way: str) -> Steps[list[str]]:
    """Mirror examples of one face on its own surface; returns the names of those that it shows.

    Parameters
    ----------
    side : SOURCE or TARGET.
    way : of `core.mirroring.mirror.WAYS`.

    Raises
    ------
    RetargetError : if the face shows none of them, cannot be written, or as `fit_mirror`.
    """
    head = read_heads(context)[0 if side == "SOURCE" else 1]
    for thing in head.things:
        check_editable(thing)
    moves = _shown_moves(head, names)

    def mirrored(progress: Progress) -> ShapeSet:
        mirror = fit_mirror(head.face.mesh, head.file.counts, head.file.corners, head.face.points, progress)
        found = [mirror.shape(moved, way) for moved in moves.values()]
        return ShapeSet(tuple(moves), np.stack(found).astype(np.float32))

    shapes = yield from part(in_thread(mirrored), 0.0, 0.95)
    put_shapes(head, shapes, {name: name for name in moves}, {})
    return list(moves)


def scale_example(face: Object, name: str, factor: float) -> None:
    """Make an example stronger or weaker on all objects of a head.

    Raises
    ------
    RetargetError : if the head does not show it.
    """
    if not _is_shown(face, name):
        raise RetargetError(f"example {name!r} moves nothing on object {face.name!r}, expected it sculpted")
    for thing in (face, *head_parts(face)):
        key = find_key(thing, name)
        if key is not None:
            rest = np.empty(3 * len(key.points), np.float32)
            key.relative_key.points.foreach_get("co", rest)
            key.points.foreach_set("co", (rest + factor * key_displacement(key).ravel()).astype(np.float32))
            thing.data.update()
