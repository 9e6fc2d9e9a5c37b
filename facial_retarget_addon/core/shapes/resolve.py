"""Learning from the artist: corrected shapes become examples, and the others are solved again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ..arrays import FloatArray, Progress, no_progress, progress_part
from ..errors import RetargetError
from ..methods.settings import Settings
from ..problem import Problem
from .choose import listed
from .clone import STILL, ClonedShapes, clone_shapes
from .combinations import Corrective, combined, complete
from .shape_set import ShapeSet


def resolve_shapes(
    method: str,
    problem: Problem,
    settings: Settings,
    shapes: ShapeSet,
    corrected: ShapeSet,
    correctives: Sequence[Corrective] = (),
    progress: Progress = no_progress,
) -> ClonedShapes:
    """`clone_shapes`, learning from shapes that the artist corrected on the target.

    Each corrected shape is an example together with the source's of the same name, beside the problem's own, in the
    place of one of that name. The corrected shapes come back exactly as they arrived; the report's `examples` say how
    well each is met and how well the others foretell it.

    Parameters
    ----------
    method : one that examples steer.
    shapes : of the source. corrected : of the target; some of the same names.

    Raises
    ------
    RetargetError : for corrected shapes of other names or of another head, or as `clone_shapes`.
    """
    check_corrected(shapes, corrected)
    target = problem.target.mesh
    if corrected.displacements.shape[1:] != target.vertices.shape:
        raise RetargetError(
            f"the corrected shapes have {corrected.displacements.shape[1]} vertices, "
            f"expected {len(target.vertices)} as the target"
        )
    whole = complete(correctives, shapes.names)
    seen = combined(shapes, whole)
    teachers = [name for name in corrected.names if _tells(problem, seen[shapes.rows([name])[0]])]
    wanted = _seen_on_target(method, problem, settings, shapes, corrected, whole, progress_part(progress, 0.0, 0.3))
    source, rest = problem.source.mesh.vertices, target.vertices
    ours = {name: source + seen[shapes.rows([name])[0]] for name in teachers}
    theirs = {name: rest + wanted[name] for name in teachers}
    taught = replace(
        problem,
        source=replace(problem.source, examples={**problem.source.examples, **ours}),
        target=replace(problem.target, examples={**problem.target.examples, **theirs}),
    )
    cloned = clone_shapes(method, taught, settings, shapes, correctives, progress_part(progress, 0.3, 1.0))
    return _kept(cloned, corrected, [name for name in corrected.names if name not in teachers])


def check_corrected(shapes: ShapeSet, corrected: ShapeSet) -> None:
    """RetargetError if a corrected shape is none of the source's; names those that are not."""
    strange = [name for name in corrected.names if name not in shapes.names]
    if strange:
        raise RetargetError(f"corrected shapes {listed(strange)} are not among the source's {listed(shapes.names)}")


def _tells(problem: Problem, displacement: FloatArray) -> bool:
    """Whether a motion (Vs, 3) shows at the source's points: an example is known by them."""
    moved = np.abs(problem.source.points.positions(displacement)).max(initial=0.0)
    return bool(moved > STILL * problem.source.mesh.size)


def _seen_on_target(
    method: str,
    problem: Problem,
    settings: Settings,
    shapes: ShapeSet,
    corrected: ShapeSet,
    correctives: Sequence[Corrective],
    progress: Progress,
) -> dict[str, FloatArray]:
    """The corrected shapes as they are seen: correctives with what they need, cloned where it was not corrected."""
    needs = {one.name: one.needs for one in correctives if one.name in corrected.names}
    open_ones = dict.fromkeys(need for several in needs.values() for need in several if need not in corrected.names)
    known = corrected
    if open_ones:
        known = known.joined(
            clone_shapes(method, problem, settings, shapes.subset(list(open_ones)), progress=progress).shapes
        )
    return {
        name: np.sum([known[part] for part in (name, *needs.get(name, ()))], axis=0, dtype=np.float64)
        for name in corrected.names
    }


def _kept(cloned: ClonedShapes, corrected: ShapeSet, idle: Sequence[str]) -> ClonedShapes:
    """The solved shapes with the corrected ones in their places."""
    largest = dict(zip(corrected.names, corrected.largest(), strict=True))
    rows: list[dict[str, Any]] = []
    for row in cloned.rows:
        if row["name"] in largest:
            row = {"name": row["name"], "corrected": True, "largest_motion": float(largest[row["name"]])}
        rows.append(row)
    lost = {name: why for name, why in cloned.without_counterpart.items() if name not in largest}
    warnings = list(cloned.report["warnings"])
    if idle:
        warnings.insert(0, f"corrected shapes that do not move the source's points teach nothing: {listed(idle)}")
    report = {**cloned.report, "warnings": warnings, "shapes": rows, "without_counterpart": lost}
    return ClonedShapes(cloned.shapes.with_shapes(corrected), rows, report, lost, cloned.spots, cloned.leveled)
