"""The panel's button: read, compute, then write once."""

from __future__ import annotations

from typing import Any

from bpy.types import Context

from ..core.arrays import Progress
from ..core.retarget import Result, retarget
from .background import Steps, in_thread, part
from .bake import write_frames
from .performance import read_frames
from .report import write_report
from .settings import read_task_settings
from .task import frame_range, read_problem

READING, COMPUTING = 0.2, 0.75
"""Shares of the time that reading and computing take."""


def retarget_steps(context: Context) -> Steps[dict[str, Any]]:
    """Retarget the scene's task and bake the result; returns the report.

    Closing the steps at any time leaves the scene as it was: everything is written at the very end.

    Raises
    ------
    RetargetError : for bad input; says what, and on which object.
    """
    task = context.scene.facial_retarget
    method, settings = task.method, read_task_settings(task)
    problem = read_problem(context)
    frames = frame_range(context)
    source = yield from part(read_frames(context, task.source, frames), 0.0, READING)

    def compute(progress: Progress) -> Result:
        return retarget(method, problem, settings, source, progress)

    result = yield from part(in_thread(compute), READING, COMPUTING)
    yield READING + COMPUTING, "Writing"
    write_report(task, problem, source, result)
    write_frames(task.target, result.frames, frames.start)
    return result.report
