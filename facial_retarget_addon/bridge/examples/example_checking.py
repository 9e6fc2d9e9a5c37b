"""How well the chosen method meets the examples, beside each of them on the list."""

from __future__ import annotations

from typing import Any

from bpy.types import Context, PropertyGroup

from ...core.arrays import Progress
from ...core.retarget import example_figures
from ..background import Steps, in_thread
from ..settings import read_task_settings
from ..task import read_problem
from .example_states import stamp_of

UNKNOWN = -1.0
"""The figure of an example that has none."""


def check_steps(context: Context) -> Steps[str]:
    """Fit the task's method to the examples and keep its figures; returns a sentence about them.

    Raises
    ------
    RetargetError : for bad input, and if nothing is learned from examples.
    """
    task = context.scene.facial_retarget
    method, settings = task.method, read_task_settings(task)
    problem = read_problem(context)

    def check(progress: Progress) -> list[dict[str, Any]]:
        return example_figures(method, problem, settings, progress)

    figures = yield from in_thread(check)
    _keep(task, figures)
    worst = max(figures, key=lambda row: row.get("leave_one_out", row["fit"]))
    if "leave_one_out" in worst:
        return f"The others foretell {worst['name']} worst: {worst['leave_one_out']:.0%} of its motion would be missing"
    return f"{worst['name']} is met but for {worst['fit']:.1%} of its motion"


def _keep(task: PropertyGroup, figures: list[dict[str, Any]]) -> None:
    row_of = {row["name"]: row for row in figures}
    for example in task.examples:
        row = row_of.get(example.name, {})
        example.fit = row.get("fit", UNKNOWN)
        example.leave_one_out = row.get("leave_one_out", UNKNOWN)
    task.examples_checked = stamp_of(task)
