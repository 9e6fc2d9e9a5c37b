"""The panel's task as a problem for the core."""

from __future__ import annotations

from dataclasses import replace

from bpy.types import Context, Object, PropertyGroup

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from ..core.problem import Face, Problem
from .bakes.times import FrameTimes
from .examples.examples import read_examples
from .gains import read_gains
from .heads import Head, head_parts, read_head
from .performance import frame_kept, read_frame
from .points.base_object import read_base
from .raycast import available_caster


def frame_range(context: Context) -> range:
    """The whole scene frames that the task retargets."""
    task = context.scene.facial_retarget
    chosen = context.scene if task.use_scene_range else task
    return range(chosen.frame_start, chosen.frame_end + 1)


def frame_times(context: Context) -> FrameTimes:
    """The scene frames that the task retargets, in the steps of the bake.

    Raises
    ------
    RetargetError : if the range is empty.
    """
    frames = frame_range(context)
    return FrameTimes(frames.start, frames.stop - 1, context.scene.facial_retarget.bake.step)


def _chosen_faces(task: PropertyGroup) -> tuple[Object, Object]:
    """The task's source and target.

    Raises
    ------
    RetargetError : if one is not chosen, or both are one object.
    """
    for role, thing in (("source", task.source), ("target", task.target)):
        if thing is None:
            raise RetargetError(f"no {role} is chosen, expected a mesh object under Faces")
    if task.source == task.target:
        raise RetargetError(f"source and target are both object {task.source.name!r}, expected two objects")
    return task.source, task.target


def read_problem(context: Context) -> Problem:
    """Both heads as they are now, with points, named parts and examples.

    Raises
    ------
    RetargetError : if something is missing or bad; says what, and on which object.
    """
    heads = read_heads(context)
    on_source, on_target = read_examples(context.scene.facial_retarget, *heads)
    base = context.scene.facial_retarget.base
    return Problem(
        source=_face(heads[0], on_source),
        target=_face(heads[1], on_target),
        base=None if base is None else read_base(base),
        make_caster=available_caster(),
        gains=read_gains(context.scene.facial_retarget, heads[1]),
    )


def read_heads(context: Context) -> tuple[Head, Head]:
    """The task's source and target with their parts, the source in its neutral.

    Raises
    ------
    RetargetError : if one is not chosen, both are one object, or as `read_head` and `read_frame`.
    """
    task = context.scene.facial_retarget
    source, target = _chosen_faces(task)
    neutral = None
    if task.source_neutral == "FRAME":
        with frame_kept(context.scene):
            neutral = read_frame(context, (source, *head_parts(source)), task.neutral_frame).astype("float64")
    return read_head(source, neutral), read_head(target)


def _face(head: Head, displacements: dict[str, FloatArray]) -> Face:
    vertices = head.face.mesh.vertices
    return replace(head.face, examples={name: vertices + moves for name, moves in displacements.items()})
