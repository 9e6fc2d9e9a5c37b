"""The task's base mesh, built on a thread and then shown on both faces."""

from __future__ import annotations

from bpy.types import Context

from ...core.arrays import Progress
from ...core.base.base_mesh import BaseMesh, base_mesh
from ..background import Steps, in_thread
from ..task import read_problem
from .base_object import show_base


def show_base_steps(context: Context) -> Steps[BaseMesh]:
    """Build the base mesh of source and target, and show it on both as wire objects; see `show_base`.

    Closing the steps at any time leaves the scene as it was: everything is written at the very end.

    Raises
    ------
    RetargetError : for anything that the task lacks, or as `base_mesh`.
    """
    task = context.scene.facial_retarget
    things = (task.source, task.target)
    problem = read_problem(context)
    source, target = problem.source, problem.target

    def build(progress: Progress) -> BaseMesh:
        progress(0.0, "Building the base mesh")
        return base_mesh(source.mesh, source.points, target.mesh, target.points, problem.base, problem.make_caster)

    base = yield from in_thread(build)
    for thing in things:
        show_base(thing, base.names, base.faces)
    return base
