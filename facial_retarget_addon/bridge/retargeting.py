"""The panel's button: read, compute, then write once."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import bpy
from bpy.types import Context, Object

from ..core.arrays import Progress
from ..core.base.regions import eye_separation
from ..core.errors import RetargetError
from ..core.level_retargeter import LevelMotion
from ..core.methods.settings import CACHES
from ..core.retarget import Result, level_motions, retarget
from ..files.pages.report import report_json, report_page
from ..files.whole import overwritten, place_faults, written_whole
from .background import Steps, in_thread, part
from .bakes.bake import Wish, bake_steps, read_wish
from .bakes.kept import free_file
from .bakes.scene_cache import let_go
from .heads import head_parts, read_head
from .key_sets import check_targets
from .paths import optional_path
from .performance import read_frames
from .preview.preview import stop_preview
from .reports.findings import write_frame_findings
from .scene.level_object import show_levels
from .settings import read_task_settings
from .task import frame_times, read_problem

READING, COMPUTING, BAKING = 0.2, 0.7, 0.1
"""Shares of the time that reading, computing and baking take."""


def retarget_steps(context: Context) -> Steps[dict[str, Any]]:
    """Retarget the scene's task and bake the result, which ends a live preview; returns the report.

    Closing the steps at any time leaves the scene as it was: everything is written at the very end.

    Raises
    ------
    RetargetError : for bad input; says what, and on which object.
    """
    yield 0.0, "Reading the faces"
    task = context.scene.facial_retarget
    method, settings, wish = task.method, read_task_settings(task), read_wish(task)
    problem = read_problem(context)
    yield 0.0, "Reading the faces"
    head = read_head(task.target)
    sources = (task.source, *head_parts(task.source))
    check_targets(sources, head.things, over_bake=True)
    report_file, page_file = (optional_path(path, "file", "report", "Report") for path in (task.report, task.page))
    _check_outputs(sources, head.things, wish, report_file, page_file)
    frames = frame_times(context)
    source = yield from part(read_frames(context, task.source, frames), 0.0, READING)

    def compute(progress: Progress) -> tuple[Result, bytes]:
        result = retarget(method, problem, settings, source, progress)
        if page_file is None:
            return result, b""
        progress(1.0, "Drawing the page")
        return result, report_page(result.report, problem, source, result.frames, result.levels)

    result, page = yield from part(in_thread(compute), READING, COMPUTING)
    unit = eye_separation(problem.target.mesh, problem.target.points)
    bake = yield from part(bake_steps(head, unit, result.frames, frames, wish), READING + COMPUTING, BAKING)
    result.report["bake"] = bake.figures
    yield READING + COMPUTING + BAKING, "Writing"
    with let_go(bake.files), written_whole() as aside:
        if report_file is not None:
            aside.place(report_file).write_bytes(report_json(result.report))
        if page_file is not None:
            aside.place(page_file).write_bytes(page)
        bake.add_files(aside)
    # What was previewed is there to stay now, and some kinds of bake leave no place for the preview's key.
    stop_preview()
    bake.write()
    write_frame_findings(task.target, task.source, result, frames)
    return result.report


def level_steps(context: Context) -> Steps[list[str]]:
    """Show what each level of the task's method adds at the scene's frame; returns the levels' names.

    Raises
    ------
    RetargetError : for bad input; says what, and on which object.
    """
    task = context.scene.facial_retarget
    method, settings = task.method, read_task_settings(task)
    problem = read_problem(context)
    now = context.scene.frame_current
    (frame,) = yield from part(read_frames(context, task.source, range(now, now + 1)), 0.0, READING)

    def compute(progress: Progress) -> list[LevelMotion]:
        return level_motions(method, problem, settings, frame, progress)

    levels = yield from part(in_thread(compute), READING, 1 - READING)
    show_levels(task.target, levels)
    return [level.name for level in levels]


def _check_outputs(
    sources: Sequence[Object], targets: Sequence[Object], wish: Wish, report: Path | None, page: Path | None
) -> None:
    """RetargetError, before anything is computed, if an output would replace another one or what a source plays."""
    cache = free_file(targets, wish.cache_path(), wish.keep) if wish.settings.kind in CACHES else None
    outputs = {"the report": report, "its page": page, "the cache": cache}
    wanted = {name: path for name, path in outputs.items() if path is not None}
    wrong = overwritten(_played_files(sources), wanted) + place_faults(wanted.values())
    if wrong:
        raise RetargetError("; ".join(wrong))


def _played_files(things: Sequence[Object]) -> dict[str, Path]:
    """The caches on disk that objects play: how messages name them -> their paths."""
    played = {}
    for modifier in (modifier for thing in things for modifier in thing.modifiers):
        held = modifier.cache_file if modifier.type == "MESH_SEQUENCE_CACHE" else modifier
        if modifier.type in ("MESH_CACHE", "MESH_SEQUENCE_CACHE") and held is not None and held.filepath:
            name = f"what modifier {modifier.name!r} of {modifier.id_data.name!r} plays"
            played[name] = Path(bpy.path.abspath(held.filepath, library=held.id_data.library))
    return played
