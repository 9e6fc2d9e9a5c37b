"""A whole job: read everything, check it, retarget, write everything. For the command line and for scripts."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, ParamSpec, TypeVar

import numpy as np

from ..core.arrays import FloatArray, Progress, no_progress, progress_part
from ..core.checks import faults, warnings
from ..core.errors import RetargetError
from ..core.gains import Gains, Mask
from ..core.level_retargeter import LevelRetargeter
from ..core.normal_maps.frame_maps import FrameMaps
from ..core.parts.kinds import NO_NAMES, NamedParts
from ..core.points import FeaturePoints
from ..core.problem import Face, Problem
from ..core.reduction.bake_keys import RigKeys
from ..core.retarget import retarget
from .bake_output import add_bake, bake_frames, check_bake_places, read_rig
from .base_mesh import read_base_mesh
from .frames import add_frames, check_frames_place, read_frames
from .images import suffix_of
from .job import FaceFiles, Job, MapOutput, read_job
from .kept_run import KeptRun, forget
from .masks import read_mask
from .mesh_file import MeshFile
from .meshes import read_mesh, read_positions
from .normal_map_files import textured, write_missing_maps
from .pages.report import report_json, report_page
from .parts import read_parts
from .points import read_points
from .whole import Aside, check_place, written_whole

P = ParamSpec("P")
T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class Inputs:
    """What a job's files hold: the problem, the source's chosen frames (F, Vs, 3), both faces as they stand there.

    numbers : of the frames, from 1. rig : the target's own shapes, where a bake moves them.
    """

    problem: Problem
    frames: FloatArray | None
    source: MeshFile
    target: MeshFile
    numbers: range = range(0)
    rig: RigKeys | None = None


class Findings(NamedTuple):
    """What `check_job` found: what breaks the job, and what it survives."""

    faults: list[str]
    warnings: list[str]


def run_job(path: Path, progress: Progress = no_progress, resume: bool = False) -> dict[str, Any]:
    """Do a job: no output is written before all of it is done, and everything appears together.

    Parameters
    ----------
    path : the job file.
    progress : told how far the job is, once its input is found sound; may raise Cancelled, which leaves every file
        as it was.
    resume : keep what is computed until the job is done, and go on from what an earlier such run has kept; see
        `KeptRun`. What comes out is the same.

    Returns
    -------
    The report, as it was written.

    Raises
    ------
    RetargetError : for anything that is wrong with the job, its files or the problem; names all of it.
    """
    start = time.perf_counter()
    job = read_job(path)
    inputs, wrong = _read(job)
    if wrong or inputs is None or inputs.frames is None:
        raise RetargetError("; ".join([*wrong, *_problem_faults(inputs, job)]))
    seconds = {"read": time.perf_counter() - start}
    kept = KeptRun(job) if resume else None
    moving = progress_part(progress, 0.1, 0.8)
    result = retarget(job.method, inputs.problem, job.settings, inputs.frames, moving, kept)
    report = {"job": job.path.name, **result.report}
    report["seconds"] = seconds | report.get("seconds", {})
    baked = None
    if job.bake is not None:
        start, target = time.perf_counter(), inputs.problem.target
        baking = progress_part(progress, 0.8, 0.85)
        baked, report["bake"] = bake_frames(job.bake, inputs.rig, target, result.frames, baking)
        report["seconds"]["bake"] = time.perf_counter() - start
    progress(0.85, "Writing")
    with written_whole() as aside:
        corners = inputs.target.counts, inputs.target.corners
        if job.output.frames is not None:
            add_frames(aside, result.frames, job.output.frames, corners, job.fps / job.chosen.step)
        if job.bake is not None and baked is not None:
            add_bake(aside, job.bake, baked, inputs.target, inputs.numbers, job.fps)
        if job.output.report is not None:
            aside.place(job.output.report).write_bytes(report_json(report))
        if job.output.page is not None:
            progress(0.87, "Taking pictures")
            page = report_page(report, inputs.problem, inputs.frames, result.frames, result.levels)
            aside.place(job.output.page).write_bytes(page)
        if job.normal_maps is not None and result.leveled is not None:
            pictures = None if kept is None else kept.pictures
            mapping = progress_part(progress, 0.9, 1.0)
            _add_normal_maps(aside, job.normal_maps, inputs, result.leveled, pictures, mapping)
    forget(job)
    progress(1.0, "Done")
    return report


def _add_normal_maps(
    aside: Aside,
    output: MapOutput,
    inputs: Inputs,
    retargeter: LevelRetargeter,
    kept: Path | None,
    progress: Progress,
) -> None:
    """Write the normal maps of all frames; into the folder of kept ones, if there is one."""
    surface = None if output.settings.level else textured(inputs.target, "[target] neutral")
    replaces = suffix_of(output.settings.depth)
    folder = kept or aside.place(output.folder, replaces)
    folder.mkdir(exist_ok=True)
    maps = FrameMaps(retargeter, inputs.problem, surface, output.settings, progress_part(progress, 0.0, 0.2))
    frames = np.asarray(inputs.frames, np.float32)
    write_missing_maps(folder, output.settings, maps, frames, progress_part(progress, 0.2, 1.0))
    if kept is not None:
        aside.adopt(kept, output.folder, replaces)


def check_job(path: Path) -> Findings:
    """Everything that is wrong with a job, its files and the problem that they state; nothing is written."""
    try:
        job = read_job(path)
    except RetargetError as error:
        return Findings([str(error)], [])
    inputs, wrong = _read(job)
    wrong += _problem_faults(inputs, job)
    if wrong or inputs is None:
        return Findings(wrong, [])
    return Findings([], warnings(inputs.problem, inputs.frames, job.settings))


def read_inputs(job: Job) -> Inputs:
    """What a job's files hold, for a scene to show; the problem itself is not checked.

    Raises
    ------
    RetargetError : if files are missing or unreadable; names all of them.
    """
    reading = Reading()
    inputs = reading.inputs(job)
    if reading.wrong or inputs is None:
        raise RetargetError("; ".join(reading.wrong))
    return inputs


def _read(job: Job) -> tuple[Inputs | None, list[str]]:
    """What the files hold, and what is wrong with them; None where so much is unreadable that there is no problem."""
    reading = Reading()
    inputs = reading.inputs(job)
    if job.output.frames is not None:
        reading.attempt(check_frames_place, job.output.frames)
    for output in (job.output.report, job.output.page):
        if output is not None:
            reading.attempt(check_place, output)
    if job.bake is not None:
        reading.attempt(check_bake_places, job.bake, job.fps / job.chosen.step)
    if job.normal_maps is not None:
        reading.attempt(check_place, job.normal_maps.folder, suffix_of(job.normal_maps.settings.depth))
        if inputs is not None and not job.normal_maps.settings.level:
            reading.attempt(textured, inputs.target, f"[target] neutral {job.target.neutral}")
    return inputs, reading.wrong


def _problem_faults(inputs: Inputs | None, job: Job) -> list[str]:
    return [] if inputs is None else faults(inputs.problem, inputs.frames, job.settings)


class Reading:
    """Reads one thing after the other and collects what is wrong."""

    def __init__(self) -> None:
        self.wrong: list[str] = []

    def attempt(self, read: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T | None:
        """What `read` returns, or None if it found something wrong."""
        try:
            return read(*args, **kwargs)
        except RetargetError as error:
            self.wrong.append(str(error))
            return None

    def inputs(self, job: Job) -> Inputs | None:
        """The problem, without examples and frames that are unreadable; None if its faces or base are."""
        source, target = self.attempt(read_mesh, job.source.neutral), self.attempt(read_mesh, job.target.neutral)
        source_points, target_points = self.points(job.source, source), self.points(job.target, target)
        source_parts, target_parts = self.parts(job.source, source), self.parts(job.target, target)
        base = None if job.base is None else self.attempt(read_base_mesh, job.base)
        examples: dict[str, tuple[FloatArray, FloatArray]] = {}
        for example in job.examples:
            one, other = self.attempt(read_positions, example.source), self.attempt(read_positions, example.target)
            if one is not None and other is not None:
                examples[example.name] = one, other
        gains = Gains(job.regions, self.masks(job, target))
        frames, numbers = None, range(0)
        if job.source.frames is None:
            self.wrong.append(f"{job.path} has no [source] frames, expected the frames to retarget")
        elif source is not None:
            frames = self.attempt(read_frames, job.source.frames, len(source.mesh.vertices))
            rows = None if frames is None else self.attempt(job.chosen.rows, len(frames))
            if frames is not None and rows is not None:
                frames, numbers = frames[rows], range(1, len(frames) + 1)[rows]
        rig = None
        if job.bake is not None and target is not None:
            rig = self.attempt(read_rig, job.bake, target)
        if source is None or target is None or source_points is None or target_points is None:
            return None
        if (base is None and job.base is not None) or source_parts is None or target_parts is None:
            return None
        return Inputs(
            Problem(
                Face(source.mesh, source_points, {name: pair[0] for name, pair in examples.items()}, source_parts),
                Face(target.mesh, target_points, {name: pair[1] for name, pair in examples.items()}, target_parts),
                base,
                gains=gains,
            ),
            frames,
            source,
            target,
            numbers,
            rig,
        )

    def points(self, files: FaceFiles, face: MeshFile | None) -> FeaturePoints | None:
        """The points of a face, none of them where the job names no file; None if they cannot be read."""
        if files.points is None:
            return FeaturePoints((), np.empty((0, 3), np.int64), np.empty((0, 3)))
        return None if face is None else self.attempt(read_points, files.points, face.mesh)

    def masks(self, job: Job, target: MeshFile | None) -> dict[str, Mask]:
        """The target's painted masks, without those that cannot be read."""
        masks: dict[str, Mask] = {}
        if target is None:
            return masks
        for file in job.masks:
            weights = self.attempt(read_mask, file.weights, len(target.mesh.vertices))
            if weights is not None:
                masks[file.name] = Mask(weights, file.gain)
        return masks

    def parts(self, files: FaceFiles, face: MeshFile | None) -> NamedParts | None:
        """The parts of a face that are named, none where the job names no file; None if they cannot be read."""
        if files.parts is None:
            return NO_NAMES
        return None if face is None else self.attempt(read_parts, files.parts, face.mesh, files.neutral)
