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
from .kinds import NO_NAMES, NamedParts
from .report import part_rows


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
    following = fit_following(mesh, points, deformer.axes, [part for part in parts if not own[part.vertices].any()])
    whole = replace(deformer, matrix=following.extend(deformer.matrix), arcs=following.extend(deformer.arcs))
    return whole, part_rows(parts, moved_vertices(whole) & ~own, own)


def moved_vertices(deformer: PointDeformer) -> BoolArray:
    """(V,) vertices that some point moves."""
    moved = np.zeros(deformer.matrix.shape[0] // 3, bool)
    moved[deformer.matrix.nonzero()[0] // 3] = True
    return moved
