"""The parts of a head whose skin a method moves by itself: they follow once the skin is where it shall be."""

from __future__ import annotations

from typing import Any, NamedTuple

from ..arrays import BoolArray, FloatArray
from ..problem import Face
from .eyes import EyeTurns, pair_eyeballs
from .follow import Following, following_of
from .known_head import know_head
from .lash_lengths import LashLengths, fit_lash_lengths
from .lash_turns import LashTurns, fit_lash_turns
from .mouth import Mouth, fit_mouth
from .report import FOLLOWS, part_rows
from .riding import ride


class CarriedParts(NamedTuple):
    """What moves beside the skin.

    following : what rides on the target's skin. lashes : how they turn beyond that, as the source's do, and how long
        they are.
    mouth : teeth, gums and tongue. eyes : eyeballs.
    rows : what each part does. moves : (Vt,) which vertices move.
    """

    following: Following
    lashes: LashTurns | None
    lengths: LashLengths | None
    mouth: Mouth | None
    eyes: EyeTurns
    rows: list[dict[str, Any]]
    moves: BoolArray

    def add_to(self, displacements: FloatArray, frames: FloatArray) -> FloatArray:
        """Target displacements (F, Vt, 3) of the skin with the parts' added, in place, for source frames (F, Vs, 3)."""
        for moving in (self.lashes, self.mouth, self.eyes):
            if moving is not None:
                moving.add_to(displacements, frames)
        moved = self.following.add_to(displacements)
        return moved if self.lengths is None else self.lengths.hold_in(moved)


def carried_parts(source: Face, target: Face, own: BoolArray) -> CarriedParts:
    """Let the parts of the target do what the source's do; what the source lacks follows the target's skin.

    Parameters
    ----------
    source, target : points with MPEG-4 names count; without `find.NEEDED` among them only what is named follows.
    own : (Vt,) the target's vertices that have motion of their own: their parts are left to it.
    """
    ours, theirs = know_head(source), know_head(target)
    free = [part for part in theirs.parts if not own[part.vertices].any()]
    riding = ride(theirs, free)
    following = following_of(riding.matrix(), theirs.axes)
    mouth, eyes = fit_mouth(ours, theirs, free), pair_eyeballs(ours, theirs, own)
    moves = eyes.turning()
    moves[following.riders] = True
    does = dict(FOLLOWS)
    if mouth is not None:
        moves[mouth.moves()] = True
        does |= mouth.does()
    rows = part_rows(theirs.parts, moves, own, does)
    lashes = fit_lash_turns(ours, theirs, riding), fit_lash_lengths(theirs.mesh, riding)
    return CarriedParts(following, *lashes, mouth, eyes, rows, moves)
