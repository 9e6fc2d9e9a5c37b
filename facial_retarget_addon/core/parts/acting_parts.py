"""The parts of a head that points move: they follow its skin within the same sparse matrix."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..acting.point_deformer import PointDeformer
from ..arrays import BoolArray
from ..mesh import TriMesh
from ..points import FeaturePoints
from .find import find_parts
from .follow import fit_following
from .kinds import BOTH, LOWER, NO_NAMES, TONGUE, NamedParts
from .known_head import KnownHead
from .report import FOLLOWS, part_rows

WITH_CHIN = {
    LOWER: "goes with the chin",
    TONGUE: "goes with the chin",
    BOTH: "its lower half goes with the chin",
}
"""Kind of part -> what it does where points move the skin."""


def with_parts(
    mesh: TriMesh, points: FeaturePoints, deformer: PointDeformer, turning: BoolArray, named: NamedParts = NO_NAMES
) -> tuple[PointDeformer, list[dict[str, Any]]]:
    """A deformer whose skin takes the parts along, and what each of them does.

    Parameters
    ----------
    points : those that show where eyes and mouth are.
    deformer : of the skin; parts that points of their own move are left to these.
    turning : (V,) vertices that something else moves, such as eyeballs.
    named : parts that the artist named.
    """
    own = moved_vertices(deformer) | turning
    parts = find_parts(mesh, points, deformer.axes, deformer.eyeballs, named)
    head = KnownHead(mesh, points, deformer.axes, deformer.eyeballs, parts)
    following = fit_following(head, [part for part in parts if not own[part.vertices].any()])
    whole = replace(deformer, matrix=following.extend(deformer.matrix), arcs=following.extend(deformer.arcs))
    return whole, part_rows(parts, moved_vertices(whole) & ~own, own, FOLLOWS | WITH_CHIN)


def moved_vertices(deformer: PointDeformer) -> BoolArray:
    """(V,) vertices that some point moves."""
    moved = np.zeros(deformer.matrix.shape[0] // 3, bool)
    moved[deformer.matrix.nonzero()[0] // 3] = True
    return moved
