"""A whole retargeting job on arrays: check, fit, frames in blocks, report."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from time import perf_counter
from typing import Any, Protocol, cast

import numpy as np

from .arrays import FloatArray, IntArray, Progress, no_progress, progress_part
from .checks import faults, warnings
from .errors import RetargetError
from .gained_face import GainedFace
from .level_retargeter import LevelMotion, LevelRetargeter, LevelsOf
from .methods.base import Retargeter, fit
from .methods.settings import LEVELED, Settings
from .problem import Problem
from .quality import Quality, Spots
from .seams.gaps import SeamGaps

BLOCK = 16
"""Frames that go through at once."""


@dataclass(frozen=True, eq=False)
class Result:
    """What a method made of a job's frames.

    Attributes
    ----------
    frames : (F, Vt, 3) float32 in the target's units.
    report : plain data.
    per_frame : the figures of each frame. spots : where each is in trouble.
    counterpart : (Vt,) the source vertex nearest to each target vertex's counterpart, -1 for none.
    levels : what each level adds to the motion of source frames (F, Vs, 3); None for a method without levels.
    leveled : what was fitted, before the gains; None for a method without levels.
    """

    frames: FloatArray
    report: dict[str, Any]
    per_frame: Mapping[str, Sequence[float]]
    spots: Sequence[Spots]
    counterpart: IntArray
    levels: LevelsOf | None = None
    leveled: LevelRetargeter | None = None


class KeptBlocks(Protocol):
    """Blocks of retargeted frames that outlive a run, so that none is computed twice."""

    def read(self, rows: slice) -> tuple[FloatArray, dict[str, Any]] | None:
        """(F, Vt, 3) the frames of these rows and their figures, None where they are not kept."""
        ...

    def keep(self, rows: slice, frames: FloatArray, figures: dict[str, Any]) -> None:
        """Keep the frames (F, Vt, 3) float32 of these rows and what `Quality.add` found, plain data."""
        ...


def retarget(
    method: str,
    problem: Problem,
    settings: Settings,
    frames: FloatArray,
    progress: Progress = no_progress,
    kept: KeptBlocks | None = None,
) -> Result:
    """Check a problem, fit a method to its two faces, and take all frames through it.

    Parameters
    ----------
    method : a name of `METHODS`.
    frames : (F, Vs, 3) source positions, in the source's units.
    progress : called with the share done and what is being done; raises Cancelled to stop.
    kept : the same problem's blocks of an earlier run; receives those that are computed.

    Raises
    ------
    RetargetError : for anything that is wrong with the problem or its frames, or whatever the method refuses.
    """
    source, target = problem.source.mesh, problem.target.mesh
    if frames.ndim != 3 or frames.shape[1:] != source.vertices.shape:
        raise RetargetError(f"source frames have shape {frames.shape}, expected (F, {len(source.vertices)}, 3)")
    start = perf_counter()
    if wrong := faults(problem, frames, settings):
        raise RetargetError("; ".join(wrong))
    gained = GainedFace(problem.target, problem.gains)
    noticed = warnings(problem, frames, settings)
    checked = perf_counter()
    retargeter = fit(method, problem, settings, lambda share, what: progress(0.4 * share, what))
    fitted = perf_counter()
    result = np.empty((len(frames), len(target.vertices), 3), np.float32)
    quality = Quality(source, target, retargeter.counterpart, SeamGaps(problem))
    measuring = 0.0
    for first in range(0, len(frames), BLOCK):
        rows = slice(first, min(first + BLOCK, len(frames)))
        before = None if kept is None else kept.read(rows)
        how = "" if before is None else ", from an earlier run"
        progress(0.4 + 0.6 * first / len(frames), f"frame {first + 1} of {len(frames)}{how}")
        if before is not None:
            result[rows], figures = before
            quality.add_known(figures)
            continue
        block = np.asarray(frames[rows], np.float32)
        result[rows] = gained.scale(retargeter.frames(block))
        measure = perf_counter()
        figures = quality.add(block, result[rows])
        measuring += perf_counter() - measure
        if kept is not None:
            kept.keep(rows, result[rows], figures)
    progress(1.0, "done")
    report = {
        "method": method,
        "settings": asdict(settings),
        **problem.gains.report(),
        **retargeter.report,
        "warnings": [*noticed, *retargeter.report["warnings"]],
        "quality": quality.summary(),
        "seconds": {
            "check": checked - start,
            "fit": fitted - checked,
            "frames": perf_counter() - fitted - measuring,
            "quality": measuring,
        },
    }
    leveled = retargeter if isinstance(retargeter, LevelRetargeter) else None
    levels = None if leveled is None else _gained_levels(leveled, gained)
    return Result(result, report, quality.per_frame(), quality.spots, retargeter.counterpart, levels, leveled)


def checked_fit(method: str, problem: Problem, settings: Settings, progress: Progress = no_progress) -> Retargeter:
    """Check a problem and fit a method to its two faces, for frames that come one by one and strengths that change.

    Raises
    ------
    RetargetError : for anything that is wrong with the problem, or whatever the method refuses.
    """
    if wrong := faults(problem, None, settings):
        raise RetargetError("; ".join(wrong))
    retargeter = fit(method, problem, settings, progress)
    if isinstance(retargeter, LevelRetargeter):
        retargeter.prepare_levels()
    return retargeter


def level_motions(
    method: str, problem: Problem, settings: Settings, frame: FloatArray, progress: Progress = no_progress
) -> list[LevelMotion]:
    """What each level of a method adds to one frame (Vs, 3) of the source; see `LevelRetargeter.levels`.

    Raises
    ------
    RetargetError : as `retarget`, and for a method without levels.
    """
    if method not in LEVELED:
        raise RetargetError(f"method {method!r} has no levels, expected one of {', '.join(LEVELED)}")
    retargeter = cast(LevelRetargeter, checked_fit(method, problem, settings, progress_part(progress, 0.0, 0.9)))
    progress(0.9, "taking the frame apart")
    return _gained_levels(retargeter, GainedFace(problem.target, problem.gains))(frame[None])


def _gained_levels(retargeter: LevelRetargeter, gained: GainedFace) -> LevelsOf:
    """The levels of a method, as strong as the gains say."""

    def levels(source: FloatArray) -> list[LevelMotion]:
        found = retargeter.levels(source)
        return [level._replace(displacements=gained.scale_displacements(level.displacements)) for level in found]

    return levels


def example_figures(
    method: str, problem: Problem, settings: Settings, progress: Progress = no_progress
) -> list[dict[str, Any]]:
    """How well a method meets each example: its name, `fit`, and `leave_one_out` where there are several.

    Both are shares of the example's motion, as norms over the target's area: what is missing from it once it has been
    learned, and what would be if only the others were known.

    Raises
    ------
    RetargetError : as `retarget`, and if nothing is learned from examples.
    """
    if not problem.source.examples:
        raise RetargetError("no example is sculpted, expected at least one that both faces show")
    if wrong := faults(problem, None, settings):
        raise RetargetError("; ".join(wrong))
    figures: list[dict[str, Any]] = fit(method, problem, settings, progress).report["examples"]
    if not figures:
        raise RetargetError(f"method {method!r} learns nothing from examples as it is set, expected one that does")
    return figures
