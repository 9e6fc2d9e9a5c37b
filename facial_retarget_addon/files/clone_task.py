"""A whole clone job: read everything, clone onto every target, write everything. For the command line and scripts."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..core.arrays import FloatArray, Progress, no_progress, progress_part
from ..core.checks import faults, warnings
from ..core.errors import RetargetError
from ..core.methods.settings import Settings
from ..core.normal_maps.frame_maps import FrameMaps
from ..core.normal_maps.key_poses import retargeted_poses
from ..core.normal_maps.wrinkle_kit import fit_wrinkle_kit
from ..core.problem import Face, Problem
from ..core.shapes.clone import ClonedShapes, clone_shapes
from ..core.shapes.combinations import combined, complete
from ..core.shapes.prepare import PreparedShapes, prepare_shapes
from ..core.shapes.resolve import check_corrected, resolve_shapes
from ..core.shapes.shape_set import ShapeSet
from ..core.shapes.sides import left_share
from .clone_job import BuiltInActor, CloneJob, TargetFiles, read_clone_job
from .job import FaceFiles
from .kept_clone import KeptTarget, forget_targets
from .mesh_file import MeshFile
from .meshes import read_mesh
from .normal_map_files import textured
from .pages.clone_page import KeyPictures, clone_page, clone_sheet, key_pictures, sheet_rows
from .pages.pictures import Image
from .pages.report import report_json
from .run import Findings, Reading
from .shape_files import add_shapes, check_shapes_place, read_shapes
from .whole import Aside, check_place, overwritten, written_whole
from .wrinkle_kit_files import check_kit_place, kit_folder, write_wrinkle_kit


@dataclass(frozen=True, eq=False)
class _Target:
    """A head as its files hold it."""

    files: TargetFiles
    mesh_file: MeshFile
    face: Face
    corrected: ShapeSet | None

    @property
    def name(self) -> str:
        """What messages and reports call it."""
        return self.files.face.neutral.name


@dataclass(frozen=True, eq=False)
class _Inputs:
    """What a job's files hold."""

    source: Face
    prepared: PreparedShapes
    targets: list[_Target]
    settings: Settings


MakeActor = Callable[[Sequence[str]], tuple[Face, ShapeSet]]
"""Makes the built-in actor, with the shapes of some sets."""


def no_actor(sets: Sequence[str]) -> tuple[Face, ShapeSet]:
    """Say that nobody handed in the built-in actor."""
    raise RetargetError("the job takes its shapes from the built-in actor, but what runs it did not bring one")


def run_clone_file(
    path: Path, progress: Progress = no_progress, make_actor: MakeActor = no_actor
) -> list[dict[str, Any]]:
    """Do the clone job of a file; see `run_clone_job`."""
    return run_clone_job(read_clone_job(path), progress, make_actor)


def run_clone_job(
    job: CloneJob, progress: Progress = no_progress, make_actor: MakeActor = no_actor, resume: bool = False
) -> list[dict[str, Any]]:
    """Do a job: no output is written before all of it is done, and everything appears together.

    Parameters
    ----------
    progress : told how far the job is; may raise Cancelled, which leaves every file as it was.
    make_actor : `demonstration.acting_donor`, for jobs that take the built-in actor's shapes.
    resume : keep what each target gets until the job is done, and pass over those that an earlier such run has kept.

    Returns
    -------
    The report of each target, as it was written.

    Raises
    ------
    RetargetError : for anything that is wrong with the job, its files or its heads; names all of it.
    """
    start = time.perf_counter()
    progress(0.0, "Reading")
    inputs, wrong = _read(job, make_actor)
    if wrong or inputs is None:
        raise RetargetError("; ".join(wrong))
    seconds = time.perf_counter() - start
    pictures: list[Image] = []
    reports = []
    with written_whole() as aside:
        for number, target in enumerate(inputs.targets):
            part = progress_part(progress, (number + 0.1) / len(inputs.targets), (number + 1) / len(inputs.targets))
            if resume:
                reports.append(_kept_target(aside, job, inputs, number, seconds, pictures, part))
            else:
                reports.append(_add_target(aside, job, inputs, target, seconds, pictures, part))
        progress(1.0, "Writing")
    forget_targets(job)
    return reports


def _kept_target(
    aside: Aside,
    job: CloneJob,
    inputs: _Inputs,
    number: int,
    reading: float,
    pictures: list[Image],
    progress: Progress,
) -> dict[str, Any]:
    """As `_add_target`, but for a target that an earlier run has kept; keeps what it makes."""
    kept, target = KeptTarget(job, number, aside), inputs.targets[number]
    if kept.report is not None:
        progress(0.0, f"{target.name}, from an earlier run")
        return kept.report
    try:
        report = _add_target(kept, job, inputs, target, reading, pictures, progress)
        kept.done(report)
    except BaseException:
        kept.vanish()
        raise
    return report


def _add_target(
    aside: Aside,
    job: CloneJob,
    inputs: _Inputs,
    target: _Target,
    reading: float,
    pictures: list[Image],
    progress: Progress,
) -> dict[str, Any]:
    """Write all that a target gets; returns its report.

    pictures : of the source's shapes; made here for the first target that wants some.
    """
    cloned = _clone(job, inputs, target, progress_part(progress, 0.0, 0.5))
    wanted = cloned.only(inputs.prepared.wanted)
    report = _report(job, target, wanted, reading)
    add_shapes(aside, wanted.shapes, target.files.shapes, target.mesh_file)
    if target.files.page is not None or target.files.sheet is not None:
        if not pictures:
            seen = _seen(inputs.prepared.shapes, inputs.prepared)
            pictures += key_pictures(inputs.source, seen, progress_part(progress, 0.5, 0.7))
        seen = _seen(cloned.shapes, inputs.prepared)
        names = inputs.prepared.wanted
        keys = sheet_rows(names, pictures, target.face, seen, progress_part(progress, 0.7, 1.0))
        _add_pictures(aside, target.files, report, keys)
    if target.files.wrinkles is not None:
        kit = _add_wrinkle_kit(aside, job, inputs, target, wanted, progress_part(progress, 0.5, 0.7))
        report["wrinkle_kit"] = kit
    if target.files.report is not None:
        aside.place(target.files.report).write_bytes(report_json(report))
    return report


def _clone(job: CloneJob, inputs: _Inputs, target: _Target, progress: Progress) -> ClonedShapes:
    """The shapes on a target, those that correctives alone need among them."""
    problem, prepared = Problem(inputs.source, target.face), inputs.prepared
    try:
        if target.corrected is None:
            return clone_shapes(job.method, problem, job.settings, prepared.shapes, prepared.correctives, progress)
        return resolve_shapes(
            job.method, problem, job.settings, prepared.shapes, target.corrected, prepared.correctives, progress
        )
    except RetargetError as error:
        raise RetargetError(f"{target.name}: {error}") from error


def _add_wrinkle_kit(
    aside: Aside, job: CloneJob, inputs: _Inputs, target: _Target, cloned: ClonedShapes, progress: Progress
) -> dict[str, Any]:
    """Write the wrinkle kit of a target's shapes; returns what the report says of it."""
    settings, folder = job.wrinkle_kit, target.files.wrinkles
    if folder is None or cloned.leveled is None:
        raise RetargetError(f"{target.name}: method {job.method!r} has no levels, expected one for a wrinkle kit")
    problem, prepared = Problem(inputs.source, target.face), inputs.prepared
    surface = None if settings.level else textured(target.mesh_file, target.name)
    maps = FrameMaps(cloned.leveled, problem, surface, settings, progress_part(progress, 0.0, 0.3))
    names = [name for name in prepared.wanted if name not in cloned.without_counterpart]
    rest = inputs.source.mesh.vertices
    posed = retargeted_poses(maps, rest, prepared.shapes, names, prepared.correctives)
    kit = fit_wrinkle_kit(maps, posed, settings.least, progress_part(progress, 0.3, 0.7))
    write_wrinkle_kit(kit_folder(aside, folder), settings, kit, target.name, progress_part(progress, 0.7, 1.0))
    return kit.report()


def _seen(shapes: ShapeSet, prepared: PreparedShapes) -> FloatArray:
    """(E, V, 3) the wanted shapes as they are looked at: correctives with what they need."""
    whole = combined(shapes, complete(prepared.correctives, shapes.names))
    seen: FloatArray = whole[shapes.rows(prepared.wanted)]
    return seen


def _report(job: CloneJob, target: _Target, cloned: ClonedShapes, reading: float) -> dict[str, Any]:
    report = {
        "source_file": job.source.name,
        "target_file": target.name,
        **cloned.report,
    }
    return report | {"seconds": {"read": reading, **cloned.report["seconds"]}}


def _add_pictures(aside: Aside, files: TargetFiles, report: dict[str, Any], keys: list[KeyPictures]) -> None:
    if files.page is not None:
        aside.place(files.page).write_bytes(clone_page(report, keys))
    if files.sheet is not None:
        aside.place(files.sheet).write_bytes(clone_sheet(keys, report["shapes"]))


def check_clone_job(path: Path, make_actor: MakeActor = no_actor) -> Findings:
    """Everything that is wrong with a clone job, its files and its heads; nothing is written."""
    try:
        inputs, wrong = _read(read_clone_job(path), make_actor)
    except RetargetError as error:
        return Findings([str(error)], [])
    if wrong or inputs is None:
        return Findings(wrong, [])
    frames = inputs.prepared.shapes.positions(inputs.source.mesh.vertices)
    return Findings(
        [],
        [
            f"{target.name}: {warning}"
            for target in inputs.targets
            for warning in warnings(Problem(inputs.source, target.face), frames, inputs.settings)
        ],
    )


def _read(job: CloneJob, make_actor: MakeActor) -> tuple[_Inputs | None, list[str]]:
    """What the files hold, and all that is wrong with them and their places; None where that leaves nothing to do."""
    reading = Reading()
    reading.wrong += overwritten(job.inputs(), job.outputs())
    source, prepared = _read_source(job, reading, make_actor)
    targets = [_read_target(files, job.wrinkle_kit.level, reading) for files in job.targets]
    whole = [target for target in targets if target is not None]
    if source is not None and prepared is not None and not reading.wrong:
        for target in whole:
            wrong = faults(Problem(source, target.face), None, job.settings)
            reading.wrong += [f"{target.name}: {fault}" for fault in wrong]
            if target.corrected is not None:
                reading.attempt(check_corrected, prepared.shapes, target.corrected)
    found = None if source is None or prepared is None else _Inputs(source, prepared, whole, job.settings)
    return found, list(dict.fromkeys(reading.wrong))


def _read_source(job: CloneJob, reading: Reading, make_actor: MakeActor) -> tuple[Face | None, PreparedShapes | None]:
    if isinstance(job.source, BuiltInActor):
        face, shapes = reading.attempt(make_actor, job.source.sets) or (None, None)
    else:
        _, face = _read_face(job.source.face, reading)
        shapes = None if face is None else reading.attempt(read_shapes, job.source.shapes, face.mesh)
    if face is None or shapes is None:
        return face, None
    share = None
    if job.preparation.split:
        share = reading.attempt(left_share, face.mesh, face.points, job.preparation.feather)
    return face, reading.attempt(prepare_shapes, shapes, job.preparation, share)


def _read_target(files: TargetFiles, level: int, reading: Reading) -> _Target | None:
    mesh_file, face = _read_face(files.face, reading)
    reading.attempt(check_shapes_place, files.shapes)
    for place in (files.report, files.page, files.sheet):
        if place is not None:
            reading.attempt(check_place, place)
    if files.wrinkles is not None:
        reading.attempt(check_kit_place, files.wrinkles)
        if mesh_file is not None and not level:
            reading.attempt(textured, mesh_file, str(files.face.neutral))
    if mesh_file is None or face is None:
        return None
    corrected = None
    if files.corrected is not None:
        corrected = reading.attempt(read_shapes, files.corrected, face.mesh)
    return _Target(files, mesh_file, face, corrected)


def _read_face(files: FaceFiles, reading: Reading) -> tuple[MeshFile | None, Face | None]:
    mesh_file = reading.attempt(read_mesh, files.neutral)
    points, parts = reading.points(files, mesh_file), reading.parts(files, mesh_file)
    if mesh_file is None or points is None or parts is None:
        return mesh_file, None
    return mesh_file, Face(mesh_file.mesh, points, named_parts=parts)
