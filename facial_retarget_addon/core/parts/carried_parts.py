"""The parts of a head whose skin a method moves by itself: they follow once the skin is where it shall be."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..acting.eyeballs import find_eyeballs
from ..arrays import BoolArray
from ..mesh import TriMesh
from ..mpeg4.fdps import FDPS
from ..mpeg4.head import head_axes
from ..points import FeaturePoints
from .find import NEEDED, find_parts
from .follow import Following, fit_following
from .report import part_rows


class CarriedParts(NamedTuple):
    """What the skin's displacements do to the parts, and what each part does."""

    following: Following
    rows: list[dict[str, Any]]


def carried_parts(mesh: TriMesh, points: FeaturePoints, own: BoolArray) -> CarriedParts:
    """Find a head's parts and let them follow its skin.

    Parameters
    ----------
    points : those with MPEG-4 names count; without `NEEDED` among them nothing follows.
    own : (V,) vertices that have motion of their own: their parts are left to it.
    """
    known = points.subset([name for name in points.names if name in FDPS])
    axes = np.eye(3)
    if set(known.names) >= NEEDED:
        axes = head_axes(known.names, known.positions(mesh.vertices))
    parts = find_parts(mesh, known, axes, find_eyeballs(mesh, known, axes))
    following = fit_following(mesh, known, axes, [part for part in parts if not own[part.vertices].any()])
    follows = np.zeros(len(mesh.vertices), bool)
    follows[following.riders] = True
    return CarriedParts(following, part_rows(parts, follows, own))
