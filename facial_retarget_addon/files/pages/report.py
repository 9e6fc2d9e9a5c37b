"""The report of a job: figures as JSON, and a page to look at."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from ...core.arrays import FloatArray
from ...core.level_retargeter import LevelsOf
from ...core.problem import Problem
from ..documents import json_bytes
from .page import Figure, Section, html_page
from .report_pictures import LevelPictures, Moment, level_pictures, liveliest, moments

_SECTIONS = (
    Section(
        "Quality",
        ("quality",),
        "Over all frames. Torn edges grew to several times their length, flipped triangles turned over, neutral drift "
        "is what is left where the source does not move.",
    ),
    Section(
        "Piercing",
        ("levels",),
        "Rays of the normal mesh that found no surface, level by level; their neighbours filled their places.",
    ),
    Section(
        "Examples",
        ("examples",),
        "Error of each example relative to its motion: with it among the examples, and left out of them. One that is "
        "far worse when it is left out shows what no other example does.",
    ),
    Section(
        "Fit",
        ("scale", "coverage", "matched", "base", "source", "target", "still_components"),
        "Scale is target units for one source unit; coverage the share of the target's surface that lies on the base "
        "mesh; matched the share that found its place on the source. Still components hold no feature point.",
    ),
    Section(
        "Bake",
        ("bake",),
        "How many shape keys the frames became, and how far the moving vertices are off at the worst frame: their root "
        "mean square, and the worst of them, in distances between the eyes.",
    ),
    Section("Times", ("seconds",), "In seconds."),
    Section("Settings", ("method", "settings")),
)


def report_json(report: Mapping[str, Any]) -> bytes:
    """The report as a JSON document; a number that does not exist (NaN) is null."""
    return json_bytes(_finite(report))


def report_page(
    report: Mapping[str, Any],
    problem: Problem,
    source_frames: FloatArray,
    target_frames: FloatArray,
    levels: LevelsOf | None = None,
) -> bytes:
    """The report as one HTML file that needs nothing else: pictures of source and target, the figures beneath.

    Parameters
    ----------
    report : plain data; what it holds beyond the known keys is shown too.
    source_frames, target_frames : (F, Vs, 3) and (F, Vt, 3).
    levels : what each level adds to a frame, for a row of pictures; None for a method without levels.
    """
    chosen = {*liveliest(problem.source.mesh.vertices, source_frames), *worst_frame(report)}
    by_level = None if levels is None else level_pictures(problem, source_frames, levels)
    pictures = moments(problem, source_frames, target_frames, sorted(chosen))
    return render(report, pictures, len(target_frames), by_level)


def worst_frame(report: Mapping[str, Any]) -> list[int]:
    """The frame (from 0) with the most torn edges and flipped triangles; none where nothing is torn or flipped."""
    quality = report.get("quality", {})
    trouble = quality.get("torn_edges", 0) + quality.get("flipped_triangles", 0)
    return [quality["worst_frame"] - 1] if trouble and quality.get("worst_frame") else []


def render(
    report: Mapping[str, Any], pictures: Sequence[Moment], frame_count: int, by_level: LevelPictures | None = None
) -> bytes:
    """The page of a report and its pictures."""
    title = f"Retargeting report: {report['job']}" if "job" in report else "Retargeting report"
    lead = f"{frame_count} frames. Pictures of the liveliest ones and the worst, source left, target right."
    figures = [_figure(moment, worst_frame(report)) for moment in pictures]
    rows = [] if by_level is None else [_level_row(by_level)]
    if "bake" in report:
        report = {**report, "bake": {key: part for key, part in report["bake"].items() if key != "per_frame"}}
    return html_page(title, lead, figures, report, _SECTIONS, shown_elsewhere=("job",), rows=rows)


def _level_row(pictures: LevelPictures) -> Figure:
    moves = ", ".join(f"{name} {most:.3g}" for name, _, most in pictures.levels)
    caption = (
        f"Frame {pictures.frame + 1}, level upon level; the redder, the more the level that came last moves a place. "
        f"At most, in target units: {moves}"
    )
    return Figure(caption, tuple((name, png) for name, png, _ in pictures.levels))


def _figure(moment: Moment, worst: Sequence[int]) -> Figure:
    remark = ", the worst: most torn edges and flipped triangles" if moment.frame in worst else ""
    caption = f"Frame {moment.frame + 1}"
    images = ((f"source, {caption}", moment.source), (f"target, {caption}", moment.target))
    return Figure(caption + remark, images)


def _finite(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _finite(part) for key, part in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(part) for part in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
