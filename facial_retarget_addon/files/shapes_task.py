"""Shape sets for any face, out of its feature points alone. For the command line and scripts."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..core.acting.expression_sets import expression_shapes, still_shapes
from ..core.arrays import Progress, no_progress, progress_part
from ..core.errors import RetargetError
from ..core.mpeg4.sets import SETS
from ..core.shapes.shape_set import ShapeSet
from .mpeg4_face import FapFaceFiles, fit_face_files
from .pages.fap_page import shapes_page
from .pages.report import report_json
from .shape_files import add_shapes, check_shapes_place
from .whole import overwritten, place_faults, written_whole


@dataclass(frozen=True)
class ShapesTask:
    """Which shapes of which face go where.

    Attributes
    ----------
    face : the face.
    sets : names out of `SETS`.
    out : a folder for one `.obj` for each shape, named after it; `.npz` with an array (V, 3) for each; or a facial
        animation table (`.json`).
    report, page : where figures (JSON) and pictures (HTML) go.
    """

    face: FapFaceFiles
    sets: tuple[str, ...]
    out: Path
    report: Path | None = None
    page: Path | None = None


def run_shapes_task(task: ShapesTask, progress: Progress = no_progress) -> dict[str, Any]:
    """Do a task: nothing is written before all of it is done, and everything appears together.

    Parameters
    ----------
    progress : told how far the task is; may raise Cancelled, which leaves every file as it was.

    Returns
    -------
    The report, as it was written.

    Raises
    ------
    RetargetError : for anything that is wrong with the task or its files.
    """
    start = time.perf_counter()
    _check(task)
    progress(0.0, "Reading")
    mesh_file, face = fit_face_files(task.face, progress_part(progress, 0.05, 0.3))
    shapes, still = expression_shapes(face, task.sets), still_shapes(face, task.sets)
    figures = {"file": task.face.neutral.name, **face.report}
    warnings = figures.pop("warnings")
    if still:
        warnings = [*warnings, f"shapes that the face has no points for: {', '.join(still)}"]
    seconds = {"read and fit": time.perf_counter() - start}
    size = mesh_file.mesh.size
    moved = {name: float(np.abs(shape - mesh_file.mesh.vertices).max()) / size for name, shape in shapes.items()}
    report = {"sets": list(task.sets), "shapes": moved, "face": figures, "seconds": seconds, "warnings": warnings}
    with written_whole() as aside:
        add_shapes(aside, ShapeSet.of_positions(mesh_file.mesh.vertices, shapes), task.out, mesh_file)
        if task.page is not None:
            page = shapes_page(report, face, shapes, progress_part(progress, 0.3, 1.0))
            aside.place(task.page).write_bytes(page)
        seconds["write"] = time.perf_counter() - start - seconds["read and fit"]
        if task.report is not None:
            aside.place(task.report).write_bytes(report_json(report))
    progress(1.0, "Done")
    return report


def _check(task: ShapesTask) -> None:
    """RetargetError if a set is unknown or the outputs cannot be written; names all faults."""
    unknown = [name for name in task.sets if name not in SETS]
    wrong = [f"set {name!r} is unknown, expected one of {', '.join(SETS)}" for name in unknown]
    if not task.sets:
        wrong.append(f"no set of shapes is named, expected some of {', '.join(SETS)}")
    outputs = {"out": task.out, "report": task.report, "page": task.page}
    wrong += overwritten(task.face.inputs(), {name: path for name, path in outputs.items() if path is not None})
    try:
        check_shapes_place(task.out)
    except RetargetError as error:
        wrong.append(str(error))
    wrong += place_faults([task.report, task.page])
    if wrong:
        raise RetargetError("; ".join(wrong))
