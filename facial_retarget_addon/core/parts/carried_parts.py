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
from .eyes import EyeTurns
from .find import NEEDED, find_parts
from .follow import Following, fit_following
from .report import part_rows


class CarriedParts(NamedTuple):
    """What the skin's displacements do to the parts, the eyes, what each part does, and (V,) which vertices move."""

    following: Following
    eyes: EyeTurns
    rows: list[dict[str, Any]]
    moves: BoolArray


def carried_parts(mesh: TriMesh, points: FeaturePoints, eyes: EyeTurns, own: BoolArray) -> CarriedParts:
    """Find a head's parts and let them follow its skin.

    Parameters
    ----------
    points : those with MPEG-4 names count; without `NEEDED` among them nothing follows.
    eyes : of the same mesh.
    own : (V,) vertices that have motion of their own: their parts are left to it.
    """
    known = points.subset([name for name in points.names if name in FDPS])
    axes = np.eye(3)
    if set(known.names) >= NEEDED:
        axes = head_axes(known.names, known.positions(mesh.vertices))
    parts = find_parts(mesh, known, axes, find_eyeballs(mesh, known, axes))
    following = fit_following(mesh, known, axes, [part for part in parts if not own[part.vertices].any()])
    moves = eyes.turning()
    moves[following.riders] = True
    return CarriedParts(following, eyes, part_rows(parts, moves, own | eyes.turning()), moves)
