"""Methods side by side: what each makes of the same frames, in numbers, and how long it takes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean, median
from time import perf_counter

import numpy as np

from .arrays import FloatArray, Progress, no_progress, progress_part
from .gained_face import GainedFace
from .methods.base import Retargeter
from .methods.settings import Settings
from .problem import Problem
from .quality import Quality
from .retarget import checked_fit
from .seams.gaps import SeamGaps


@dataclass(frozen=True)
class MethodFigures:
    """What a method makes of some frames.

    Attributes
    ----------
    torn_edges, turned_triangles : in the mean frame.
    lip_gap, lid_gap : by how much the target's lips and lids are open otherwise than the source's in the mean frame, in
        percent of the mouth's width and of the eye's opening; None where points do not tell.
    fit_seconds, frame_seconds : that the fit took, and the median frame by itself.
    """

    torn_edges: float
    turned_triangles: float
    lip_gap: float | None
    lid_gap: float | None
    fit_seconds: float
    frame_seconds: float


def compare_method(
    method: str,
    problem: Problem,
    settings: Settings,
    frames: FloatArray,
    seams: SeamGaps,
    progress: Progress = no_progress,
) -> tuple[Retargeter, MethodFigures]:
    """Fit a method and measure it on frames (F, Vs, 3) of the source, with the problem's gains.

    Parameters
    ----------
    seams : of the problem, the same for all methods.

    Raises
    ------
    RetargetError : as `checked_fit` and `GainedFace`.
    """
    start = perf_counter()
    retargeter = checked_fit(method, problem, settings, progress_part(progress, 0.0, 0.8))
    fitted = perf_counter() - start
    gained = GainedFace(problem.target, problem.gains)
    quality = Quality(problem.source.mesh, problem.target.mesh, retargeter.counterpart, seams)
    seconds = []
    for number, frame in enumerate(np.asarray(frames, np.float32)):
        progress(0.8 + 0.2 * number / len(frames), f"frame {number + 1} of {len(frames)}")
        start = perf_counter()
        moved = retargeter.frames(frame[None])
        seconds.append(perf_counter() - start)
        quality.add(frame[None], gained.scale(moved))
    found = quality.per_frame()
    return retargeter, MethodFigures(
        fmean(found["torn_edges"]),
        fmean(found["flipped_triangles"]),
        _difference(found, "lip_gap_percent"),
        _difference(found, "lid_gap_percent"),
        fitted,
        median(seconds),
    )


def _difference(found: Mapping[str, Sequence[float]], name: str) -> float | None:
    """Mean difference between a figure of the target and the source's."""
    if name not in found:
        return None
    return fmean(abs(one - other) for one, other in zip(found[name], found[f"source_{name}"], strict=True))
