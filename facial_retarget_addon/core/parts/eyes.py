"""Eyeballs of a retargeted face: they turn as the source's do."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..acting.eyeballs import Eyeball
from ..arrays import BoolArray, FloatArray
from ..mpeg4.head import gives_axes
from ..rigid import closest_rotations
from .kinds import EYEBALL
from .known_head import KnownHead, scale_between


@dataclass(frozen=True, eq=False)
class EyeTurns:
    """Pairs of eyeballs, one of each face.

    Attributes
    ----------
    pairs : the source's and the target's.
    source, target : (Vs, 3) and (Vt, 3) neutrals.
    across : (3, 3) rotation from the source's head to the target's. scale : target units per source unit.
    """

    pairs: tuple[tuple[Eyeball, Eyeball], ...]
    source: FloatArray
    target: FloatArray
    across: FloatArray
    scale: float

    def add_to(self, displacements: FloatArray, frames: FloatArray) -> FloatArray:
        """Target displacements (F, Vt, 3) with its eyeballs' added, in place, for source frames (F, Vs, 3).

        The motion of a source's eyeball is the rigid one nearest to its vertices'. The target's turns about its own
        centre, and shifts as the source's centre does.
        """
        for ours, theirs in self.pairs:
            rest = self.source[ours.vertices]
            now = frames[:, ours.vertices].astype(np.float64)
            middle, shift = rest.mean(axis=0), (now - rest).mean(axis=1)
            turns = closest_rotations(np.einsum("fni,nj->fij", now - middle - shift[:, None], rest - middle))[0]
            # What rests must not turn by rounding.
            turns[(now == rest).all(axis=(1, 2))] = np.eye(3)
            change = turns - np.eye(3)
            there = theirs.turned(self.target, self.across @ change @ self.across.T) - theirs.centre
            there += self.scale * ((shift - change @ (middle - ours.centre)) @ self.across.T)[:, None]
            displacements[:, theirs.vertices] += there
        return displacements

    def turning(self) -> BoolArray:
        """(Vt,) the target's vertices that turn."""
        mask = np.zeros(len(self.target), bool)
        for _, theirs in self.pairs:
            mask[theirs.vertices] = True
        return mask


def pair_eyeballs(source: KnownHead, target: KnownHead, own: BoolArray) -> EyeTurns:
    """The eyeballs that both heads have, by side.

    Parameters
    ----------
    source, target : none is paired where the points of either do not show which way the head looks.
    own : (Vt,) vertices that have motion of their own: their eyeballs are left to it.
    """
    # Frames are float32: what does not move must not turn by the rounding of its neutral.
    source_rest = source.mesh.vertices.astype(np.float32).astype(np.float64)
    if not (gives_axes(source.points.names) and gives_axes(target.points.names)):
        return EyeTurns((), source_rest, target.mesh.vertices, np.eye(3), 1.0)
    pairs = tuple(
        (eye, target.eyeballs[side])
        for side, eye in source.eyeballs.items()
        if side in target.eyeballs
        and _is_part(source, eye)
        and _is_part(target, target.eyeballs[side])
        and not own[target.eyeballs[side].vertices].any()
    )
    across = target.axes.T @ source.axes
    return EyeTurns(pairs, source_rest, target.mesh.vertices, across, scale_between(source, target))


def _is_part(head: KnownHead, eye: Eyeball) -> bool:
    """Whether an eyeball is a part of its own; one of a head whose points do not show it must have been named."""
    return len(eye.vertices) > 0 and bool(np.isin(eye.vertices, head.vertices((EYEBALL,))).all())
