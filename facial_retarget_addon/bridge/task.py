"""The panel's task as a problem for the core."""

from __future__ import annotations

from bpy.types import Context, Object, PropertyGroup

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from ..core.mesh import TriMesh
from ..core.problem import Face, Problem
from .base_object import read_base
from .examples import read_examples
from .meshes import neutral_mesh
from .performance import frame_kept, read_frame
from .points import read_points
from .raycast import available_caster


def frame_range(context: Context) -> range:
    """The scene frames that the task retargets."""
    task = context.scene.facial_retarget
    chosen = context.scene if task.use_scene_range else task
    return range(chosen.frame_start, chosen.frame_end + 1)


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
    """Both faces as they are now, with points and examples.

    Raises
    ------
    RetargetError : if something is missing or bad; says what, and on which object.
    """
    task = context.scene.facial_retarget
    source, target = _chosen_faces(task)
    on_source, on_target = read_examples(task)
    neutral = None
    if task.source_neutral == "FRAME":
        with frame_kept(context.scene):
            neutral = read_frame(context, source, task.neutral_frame).astype("float64")
    return Problem(
        source=_face(source, neutral_mesh(source, neutral), on_source),
        target=_face(target, neutral_mesh(target), on_target),
        base=None if task.base is None else read_base(task.base),
        make_caster=available_caster(),
    )


def _face(thing: Object, mesh: TriMesh, displacements: dict[str, FloatArray]) -> Face:
    examples = {name: mesh.vertices + displacement for name, displacement in displacements.items()}
    return Face(mesh, read_points(thing), examples)
