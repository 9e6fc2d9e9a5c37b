"""MPEG-4 motion put to use: on a face, as a FAP stream, or out of a face's frames. For the command line and scripts."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..core.acting.fap_face import FapFace
from ..core.acting.moving_head import measure_moving_head
from ..core.arrays import FloatArray, Progress, no_progress, progress_part
from ..core.errors import RetargetError
from ..core.mpeg4.conversions import low_level, stream_of_values
from ..core.mpeg4.faps import HEAD_TURNS
from .frame_range import EVERY_FRAME, FrameRange
from .frames import SUFFIXES, add_frames, read_frames
from .motion.fap import add_fap
from .motion.stream import read_stream
from .mpeg4_face import FapFaceFiles, fit_face_files
from .pages.fap_page import fap_page
from .pages.fap_report import fap_table, mute_warnings
from .pages.report import report_json
from .whole import Aside, overwritten, place_faults, written_whole

_STREAM = ".fap"


@dataclass(frozen=True)
class FapTask:
    """What goes in, what comes out, and how. The suffixes of `motion` and `out` tell what is done.

    Attributes
    ----------
    motion : `.fap`, ARKit weights, or markers; or the frames of a moving face, to be measured.
    out : frames of the face, or `.fap`.
    face : only where its frames go in or come out.
    missing : what FAPs do in frames that do not use them, see `low_level`.
    gaps : what becomes of hidden markers, see `fill_gaps`.
    marker_map : where the markers sit, if their names do not say.
    turn_head : whether FAPs 48 to 50 turn the head; where frames are measured, whether its motion is taken out into
        them.
    fps : frames a second of what does not tell: frames, tables without times.
    chosen : the frames that are wanted.
    report, page : where figures (JSON) and pictures (HTML) go.
    """

    motion: Path
    out: Path
    face: FapFaceFiles | None = None
    missing: str = "hold"
    gaps: str = "fill"
    marker_map: Path | None = None
    turn_head: bool = False
    fps: float | None = None
    chosen: FrameRange = EVERY_FRAME
    report: Path | None = None
    page: Path | None = None

    @property
    def measures(self) -> bool:
        """Whether frames of a face go in."""
        return self.motion.is_dir() or self.motion.suffix.lower() in SUFFIXES

    @property
    def plays(self) -> bool:
        """Whether frames of a face come out."""
        return self.out.suffix.lower() != _STREAM


@dataclass(frozen=True, eq=False)
class _Result:
    """What a task came to, ready to be written.

    report : plain data.
    write : writes what was asked for.
    page : makes the page, where there is a face to show.
    """

    report: dict[str, Any]
    write: Callable[[Aside], None]
    page: Callable[[], bytes] | None = None


def run_fap_task(task: FapTask, progress: Progress = no_progress) -> dict[str, Any]:
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
    result = (_measured if task.measures else _played if task.plays else _converted)(task, progress)
    seconds = result.report["seconds"] = {"read and fit": time.perf_counter() - start}
    with written_whole() as aside:
        result.write(aside)
        seconds["write"] = time.perf_counter() - start - seconds["read and fit"]
        if task.page is not None and result.page is not None:
            progress(0.9, "Taking pictures")
            aside.place(task.page).write_bytes(result.page())
        if task.report is not None:
            aside.place(task.report).write_bytes(report_json(result.report))
    progress(1.0, "Done")
    return result.report


class _PlayedFrames:
    """Frames of a face that plays FAPs, made as they are asked for."""

    def __init__(self, face: FapFace, values: FloatArray, turn_head: bool, progress: Progress = no_progress) -> None:
        self._face, self._values, self._turn_head, self._progress = face, values, turn_head, progress
        self.shape = (len(values), len(face.mesh.vertices), 3)

    def __len__(self) -> int:
        return len(self._values)

    def __getitem__(self, frames: slice, /) -> FloatArray:
        first = frames.indices(len(self))[0]
        self._progress(first / len(self), f"frame {first + 1} of {len(self)}")
        return self._face.frames(self._values[frames], self._turn_head)


def _played(task: FapTask, progress: Progress) -> _Result:
    """Motion on a face."""
    stream, facts = read_stream(task.motion, task.fps, task.gaps, task.marker_map)
    rows = task.chosen.rows(len(stream))
    values = low_level(stream, task.missing)[rows]
    assert task.face is not None
    mesh_file, face = fit_face_files(task.face, progress_part(progress, 0.1, 0.4))
    shown = face.playable.copy()
    shown[HEAD_TURNS] = task.turn_head
    warnings = [*facts.pop("warnings"), *mute_warnings(values, face.playable)]
    report = _report(task, facts, fap_table(values, shown), warnings, face)

    def write(aside: Aside) -> None:
        frames = _PlayedFrames(face, values, task.turn_head, progress_part(progress, 0.4, 0.9))
        corners = mesh_file.counts, mesh_file.corners
        add_frames(aside, frames, task.out, corners, stream.fps / task.chosen.step)

    return _Result(report, write, lambda: fap_page(report, face, _PlayedFrames(face, values, task.turn_head), rows))


def _measured(task: FapTask, progress: Progress) -> _Result:
    """The FAPs of a face's frames."""
    assert task.face is not None
    assert task.fps is not None
    mesh_file, face = fit_face_files(task.face, progress_part(progress, 0.1, 0.6))
    every = read_frames(task.motion, len(mesh_file.mesh.vertices))
    rows = task.chosen.rows(len(every))
    frames = every[rows]
    facts = {"format": "frames of a face", "frames": len(every), "fps": task.fps}
    measured = face.measurable.copy()
    if task.turn_head:
        values, motion = measure_moving_head(face, frames)
        measured[HEAD_TURNS] = True
        facts["head_residual"] = float(np.sqrt((motion.residual**2).mean()))
    else:
        values = face.measure(frames)
    stream = stream_of_values(task.motion.stem, task.fps / task.chosen.step, values, measured)
    report = _report(task, facts, fap_table(stream.values), [], face)
    return _Result(report, lambda aside: add_fap(aside, stream, task.out), lambda: fap_page(report, face, frames, rows))


def _converted(task: FapTask, progress: Progress) -> _Result:
    """Motion as a FAP stream; one that is one already, and wanted whole, stays as it is."""
    stream, facts = read_stream(task.motion, task.fps, task.gaps, task.marker_map)
    if not task.chosen.whole:
        values = low_level(stream, task.missing)[task.chosen.rows(len(stream))]
        used = stream.used.any(axis=0) | values.any(axis=0)
        stream = stream_of_values(stream.name, stream.fps / task.chosen.step, values, used)
    warnings = facts.pop("warnings")
    report = _report(task, facts, fap_table(low_level(stream, task.missing)), warnings)
    return _Result(report, lambda aside: add_fap(aside, stream, task.out))


def _report(
    task: FapTask, facts: dict[str, Any], faps: list[dict[str, Any]], warnings: list[str], face: FapFace | None = None
) -> dict[str, Any]:
    """The report without its times. Facts that are tables stand beside the motion's own."""
    tables = {key: fact for key, fact in facts.items() if isinstance(fact, dict)}
    motion = {"file": task.motion.name, **{key: fact for key, fact in facts.items() if key not in tables}}
    if not task.chosen.whole:
        motion["chosen"] = str(task.chosen)
    report = {"motion": motion, **tables, "faps": faps}
    if face is not None and task.face is not None:
        figures = {"file": task.face.neutral.name, **face.report}
        warnings = [*warnings, *figures.pop("warnings")]
        report["face"] = figures
    return report | {"warnings": warnings}


def _check(task: FapTask) -> None:
    """RetargetError if the task contradicts itself or its outputs cannot be written; names all faults."""
    inputs = {"motion": task.motion} | (task.face.inputs() if task.face else {})
    if task.marker_map is not None:
        inputs["marker map"] = task.marker_map
    outputs = {"out": task.out, "report": task.report, "page": task.page}
    wrong = _contradictions(task)
    wrong += overwritten(inputs, {name: path for name, path in outputs.items() if path is not None})
    wrong += place_faults([task.out], ".obj" if task.plays else "") + place_faults([task.report, task.page])
    if wrong:
        raise RetargetError("; ".join(wrong))


def _contradictions(task: FapTask) -> list[str]:
    suffix = task.out.suffix.lower()
    if suffix not in (_STREAM, *SUFFIXES) and not task.out.is_dir():
        return [f"{task.out} would be a {suffix}, expected {_STREAM}, or .npz, .pc2, .mdd or a folder for frames"]
    wrong = []
    if task.measures and task.plays:
        wrong.append(
            f"{task.motion} are frames of a face and {task.out} would be frames too; expected a .fap, or a job for "
            "retargeting one face's frames to another"
        )
    if (task.measures or task.plays) and task.face is None:
        wrong.append(f"{task.motion} cannot become {task.out} without a face: its neutral mesh and its points")
    if not (task.measures or task.plays) and (task.face or task.page):
        wrong.append(f"{task.motion} becomes {task.out} without a face: face, points and page say nothing there")
    if task.measures and task.fps is None:
        wrong.append(f"{task.motion} does not tell its frames a second, expected them to be given")
    if task.measures and task.marker_map is not None:
        wrong.append(f"{task.motion} holds no markers, so that a marker map says nothing about it")
    return wrong
