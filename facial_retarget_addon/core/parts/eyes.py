"""Eyeballs of a retargeted face: they turn as the source's do."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..acting.eyeballs import Eyeball, find_eyeballs
from ..arrays import BoolArray, FloatArray
from ..base.regions import eye_separation
from ..mpeg4.fdps import FDPS
from ..mpeg4.head import head_axes
from ..problem import Face
from ..rigid import closest_rotations
from .find import NEEDED


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
            middle, middles = rest.mean(axis=0), now.mean(axis=1)
            turns = closest_rotations(np.einsum("fni,nj->fij", now - middles[:, None], rest - middle))[0]
            shifts = middles - middle - (turns - np.eye(3)) @ (middle - ours.centre)
            there = theirs.turned(self.target, self.across @ turns @ self.across.T) - self.target[theirs.vertices]
            there += self.scale * (shifts @ self.across.T)[:, None]
            displacements[:, theirs.vertices] += there
        return displacements

    def turning(self) -> BoolArray:
        """(Vt,) the target's vertices that turn."""
        mask = np.zeros(len(self.target), bool)
        for _, theirs in self.pairs:
            mask[theirs.vertices] = True
        return mask


def pair_eyeballs(source: Face, target: Face, own: BoolArray) -> EyeTurns:
    """The eyeballs that both faces have, by side.

    Parameters
    ----------
    source, target : points with MPEG-4 names count; without `NEEDED` among them no eyeball is found.
    own : (Vt,) vertices that have motion of their own: their eyeballs are left to it.
    """
    faces = source, target
    # Frames are float32: what does not move must not turn by the rounding of its neutral.
    source_rest = source.mesh.vertices.astype(np.float32).astype(np.float64)
    if not all(set(points.names) >= NEEDED for points in (face.points for face in faces)):
        return EyeTurns((), source_rest, target.mesh.vertices, np.eye(3), 1.0)
    known = [face.points.subset([name for name in face.points.names if name in FDPS]) for face in faces]
    axes = [head_axes(p.names, p.positions(face.mesh.vertices)) for p, face in zip(known, faces, strict=True)]
    ours, theirs = (
        find_eyeballs(face.mesh, p, a, face.named_parts) for face, p, a in zip(faces, known, axes, strict=True)
    )
    pairs = tuple(
        (eye, theirs[side])
        for side, eye in ours.items()
        if side in theirs and len(eye.vertices) and len(theirs[side].vertices) and not own[theirs[side].vertices].any()
    )
    scale = eye_separation(target.mesh, known[1]) / eye_separation(source.mesh, known[0])
    return EyeTurns(pairs, source_rest, target.mesh.vertices, axes[1].T @ axes[0], scale)
