"""A whole set of shapes from one head onto another."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ..arrays import Progress, no_progress, progress_part
from ..errors import RetargetError
from ..level_retargeter import LevelRetargeter
from ..methods.settings import Settings
from ..points import common_names
from ..problem import Problem
from ..quality import Spots
from ..retarget import retarget
from ..rigid import fit_similarity
from .choose import listed
from .combinations import Corrective, combined, complete, taken_apart
from .counterparts import Features, listed_features, missing
from .shape_set import ShapeSet

STILL = 1e-5
"""Motion below this, as a share of the head's size, is none."""
FAINT = 0.1
"""A key whose largest motion is below this share of the source's, in the proportions of the heads, is named."""


@dataclass(frozen=True, eq=False)
class ClonedShapes:
    """What `clone_shapes` made.

    Attributes
    ----------
    shapes : on the target, in the source's order.
    rows : a row for each: its name, the largest motion in the target's units and as a share of the source's in the
        proportions of the heads, and the figures of `Quality.per_frame`. A corrective's figures are those of the
        combination, which `with` names.
    report : of the fit and the retargeting, as plain data, with `warnings`.
    without_counterpart : shapes that move the source and not the target -> why.
    spots : where each shape is in trouble, by its name; of a corrective, where the combination is.
    leveled : what was fitted; None for a method without levels.
    """

    shapes: ShapeSet
    rows: list[dict[str, Any]]
    report: dict[str, Any]
    without_counterpart: dict[str, str]
    spots: Mapping[str, Spots]
    leveled: LevelRetargeter | None = None

    def only(self, names: Sequence[str]) -> ClonedShapes:
        """These shapes alone, in this order; the report's other figures stay those of all."""
        row = {row["name"]: row for row in self.rows}
        rows = [row[name] for name in names]
        lost = {name: why for name, why in self.without_counterpart.items() if name in names}
        report = {**self.report, "shapes": rows, "without_counterpart": lost}
        spots = {name: self.spots[name] for name in names}
        return ClonedShapes(self.shapes.subset(names), rows, report, lost, spots, self.leveled)


def clone_shapes(
    method: str,
    problem: Problem,
    settings: Settings,
    shapes: ShapeSet,
    correctives: Sequence[Corrective] = (),
    progress: Progress = no_progress,
) -> ClonedShapes:
    """Take every shape of the source through a method, onto the target.

    A corrective is retargeted together with the shapes that it needs, which are then taken off again; one whose needs
    are not among the shapes goes alone, with a warning. A shape that acts mostly on features of which the target has
    no point, such as the mouth of a mouthless robot, leaves the target still.

    Parameters
    ----------
    method : a name of `METHODS`.
    shapes : of the source; the examples of the problem are other things, see `resolve_shapes`.
    correctives : those of `find_correctives`.
    progress : told how far it is; may raise Cancelled.

    Raises
    ------
    RetargetError : for shapes of another head, or whatever `retarget` refuses.
    """
    source, target = problem.source.mesh, problem.target.mesh
    if shapes.displacements.shape[1:] != source.vertices.shape:
        raise RetargetError(
            f"the shapes have {shapes.displacements.shape[1]} vertices, expected {len(source.vertices)} as the source"
        )
    if not len(shapes):
        raise RetargetError("no shapes arrived, expected at least one")
    whole = complete(correctives, shapes.names)
    seen = combined(shapes, whole)
    frames = source.vertices.astype(np.float32) + seen
    result = retarget(method, problem, settings, frames, progress_part(progress, 0.0, 0.95))
    progress(0.95, "comparing both heads")
    found = ShapeSet(shapes.names, result.frames - target.vertices.astype(np.float32))
    acts, absent, needing = _counterparts(problem, shapes, whole)
    still = [*absent, *needing]
    alone = _stilled(taken_apart(_stilled(found, still), whole), still)
    rows = _rows(problem, shapes, alone, whole, result.per_frame)
    lost = {
        name: f"acts on the {listed_features(acts[name], lacking)}, which the target lacks"
        for name, lacking in absent.items()
    }
    lost |= {name: f"needs {need}, which has no counterpart" for name, need in needing.items()}
    for name, own, moved in zip(shapes.names, shapes.largest(), alone.largest(), strict=True):
        if name not in lost and own > STILL * source.size and moved <= STILL * target.size:
            lost[name] = f"acts on the {listed_features(acts[name], list(acts[name]))} alone, which moves nothing here"
    lost = {name: lost[name] for name in shapes.names if name in lost}
    warnings = [
        *_corrective_warnings(correctives, whole, shapes.names),
        *_still_warnings(shapes, source.size, lost, rows),
        *result.report["warnings"],
    ]
    report = {**result.report, "warnings": warnings, "shapes": rows, "without_counterpart": lost}
    progress(1.0, "done")
    spots = dict(zip(shapes.names, result.spots, strict=True))
    return ClonedShapes(alone, rows, report, lost, spots, result.leveled)


def still_shapes(problem: Problem, shapes: ShapeSet, correctives: Sequence[Corrective]) -> list[str]:
    """Names of the shapes that leave the target still: those, and their correctives, that act on what it lacks."""
    _, absent, needing = _counterparts(problem, shapes, complete(correctives, shapes.names))
    return [*absent, *needing]


class _Counterparts(NamedTuple):
    """By name: the share of each feature in what a shape does, the features that the target lacks for it, the shape
    without a counterpart that a corrective needs.
    """

    acts: dict[str, dict[str, float]]
    absent: dict[str, list[str]]
    needing: dict[str, str]


def _counterparts(problem: Problem, shapes: ShapeSet, whole: Sequence[Corrective]) -> _Counterparts:
    here, there = Features(problem.source), Features(problem.target)
    acts = {name: here.shares(move) for name, move in zip(shapes.names, shapes.displacements, strict=True)}
    absent = {name: lacking for name, shares in acts.items() if (lacking := missing(shares, there.has))}
    needing = {one.name: need for one in whole for need in one.needs if need in absent and one.name not in absent}
    return _Counterparts(acts, absent, needing)


def _stilled(shapes: ShapeSet, names: Sequence[str]) -> ShapeSet:
    """The shapes, some of them without motion."""
    moves = shapes.displacements.copy()
    moves[shapes.rows(names)] = 0
    return ShapeSet(shapes.names, moves)


def _rows(
    problem: Problem,
    ours: ShapeSet,
    theirs: ShapeSet,
    correctives: Sequence[Corrective],
    per_frame: Mapping[str, Sequence[float]],
) -> list[dict[str, Any]]:
    scale = _head_scale(problem)
    needs = {one.name: ", ".join(one.needs) for one in correctives}
    rows: list[dict[str, Any]] = []
    for k, (name, own, moved) in enumerate(zip(ours.names, ours.largest(), theirs.largest(), strict=True)):
        row = {"name": name, "with": needs.get(name, ""), "largest_motion": float(moved)}
        row["share_of_source"] = float(moved / (scale * own)) if own > 0 else 0.0
        rows.append(row | {what: figures[k] for what, figures in per_frame.items()})
    return rows if needs else [{key: value for key, value in row.items() if key != "with"} for row in rows]


def _head_scale(problem: Problem) -> float:
    """Target units for one source unit, by the common points."""
    names = common_names(problem.source.points, problem.target.points)
    ours, theirs = (
        face.points.subset(names).positions(face.mesh.vertices) for face in (problem.source, problem.target)
    )
    return fit_similarity(ours, theirs).scale


def _corrective_warnings(
    correctives: Sequence[Corrective], whole: Sequence[Corrective], names: Sequence[str]
) -> list[str]:
    return [
        f"{one.name} means something only together with {listed(one.needs)}, "
        f"but {listed([need for need in one.needs if need not in names])} is not among the shapes: it was cloned alone"
        for one in correctives
        if one not in whole
    ]


def _still_warnings(shapes: ShapeSet, size: float, lost: dict[str, str], rows: Sequence[dict[str, Any]]) -> list[str]:
    """What is said about shapes that move nothing, on the source or on the target."""
    found: list[str] = []
    idle = [name for name, own in zip(shapes.names, shapes.largest(), strict=True) if own <= STILL * size]
    if idle:
        found.append(f"shapes that do not move the source: {', '.join(idle)}")
    for why in dict.fromkeys(lost.values()):
        found.append(f"no counterpart for {', '.join(name for name in lost if lost[name] == why)}: {why}")
    faint = [row["name"] for row in rows if row["name"] not in (*lost, *idle) and row["share_of_source"] < FAINT]
    if faint:
        found.append(f"shapes that hardly move the target: {', '.join(faint)}")
    return found
