"""The parts of a head whose skin a method moves by itself: they follow once the skin is where it shall be."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..acting.eyeballs import find_eyeballs
from ..arrays import BoolArray, FloatArray
from ..mpeg4.fdps import FDPS
from ..mpeg4.head import head_axes
from ..problem import Face
from .eyes import EyeTurns, pair_eyeballs
from .find import NEEDED, find_parts
from .follow import Following, fit_following
from .report import part_rows


class CarriedParts(NamedTuple):
    """What the skin's displacements do to the parts, the eyes, what each part does, and (V,) which vertices move."""

    following: Following
    eyes: EyeTurns
    rows: list[dict[str, Any]]
    moves: BoolArray

    def add_to(self, displacements: FloatArray, frames: FloatArray) -> FloatArray:
        """Target displacements (F, Vt, 3) of the skin with the parts' added, in place, for source frames (F, Vs, 3)."""
        return self.eyes.add_to(self.following.add_to(displacements), frames)


def carried_parts(source: Face, target: Face, own: BoolArray) -> CarriedParts:
    """Find a head's parts and let them follow its skin, and its eyeballs the source's.

    Parameters
    ----------
    source, target : points with MPEG-4 names count; without `NEEDED` among them nothing follows but what is named.
    own : (Vt,) the target's vertices that have motion of their own: their parts are left to it.
    """
    eyes = pair_eyeballs(source, target, own)
    mesh, points, named = target.mesh, target.points, target.named_parts
    known = points.subset([name for name in points.names if name in FDPS])
    axes = np.eye(3)
    if set(known.names) >= NEEDED:
        axes = head_axes(known.names, known.positions(mesh.vertices))
    parts = find_parts(mesh, known, axes, find_eyeballs(mesh, known, axes, named), named)
    following = fit_following(mesh, known, axes, [part for part in parts if not own[part.vertices].any()])
    moves = eyes.turning()
    moves[following.riders] = True
    return CarriedParts(following, eyes, part_rows(parts, moves, own | eyes.turning()), moves)
