"""What the source's lashes, brows and beards do by themselves: the target's do it too."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, IntArray
from ..closest_point import SurfaceFinder
from ..matching.smooth_warp import fit_smooth_warp
from ..points import common_names, place_matrix
from .find import Part
from .follow import Following, following_of
from .known_head import KnownHead
from .riding import ON_SKIN, ride

FARTHEST = 0.15
"""Where the heads are laid on one another, like parts are this near, in eye separations."""
GIVES = 1e-3
"""Stiffness of the warp that lays them so."""


@dataclass(frozen=True, eq=False)
class OwnMotion:
    """Motion beyond that of the roots and of the lids' turns, from one head to another; linear.

    Attributes
    ----------
    rest : (Vs, 3) the source's neutral, in float32.
    beyond : of the source.
    riders : (n,) vertices of the target. matrix : (n, m) their places among the source's riders.
    turn : (3, 3) displacements in the axes of the source's head to the target's object's, in the size of the target.
    """

    rest: FloatArray
    beyond: Following
    riders: IntArray
    matrix: sp.csr_matrix
    turn: FloatArray

    def add_to(self, displacements: FloatArray, frames: FloatArray) -> FloatArray:
        """Target displacements (F, Vt, 3) with this added, in place, for source frames (F, Vs, 3)."""
        carriers = self.beyond.carriers
        moved = (frames[:, carriers].astype(np.float32) - self.rest[carriers]) @ self.beyond.axes.T.astype(np.float32)
        seen = self.beyond.matrix @ moved.reshape(len(moved), -1).T
        there = self.matrix @ seen.reshape(len(self.beyond.riders), -1)
        there = there.reshape(len(self.riders), 3, -1).transpose(2, 0, 1)
        displacements[:, self.riders] += there @ self.turn.T
        return displacements


def fit_own_motion(source: KnownHead, target: KnownHead, parts: Sequence[Part]) -> OwnMotion | None:
    """Let parts on the target's skin do what the source's do beyond following; None where nothing corresponds.

    Parameters
    ----------
    parts : those of the target that may move.
    """
    names = common_names(source.points, target.points)
    if not source.shown or not target.shown:
        return None
    riding = ride(source, source.parts)
    count = len(source.mesh.vertices)
    apart = sp.kron(sp.identity(count) - riding.spread, sp.identity(3)) - riding.turns
    beyond = following_of(apart, source.axes)
    marks = [head.points.subset(names).positions(head.places) for head in (target, source)]
    warp = fit_smooth_warp(marks[0], marks[1], GIVES)
    riders, corners, weights = [], [], []
    for kind in ON_SKIN:
        ours = np.isin(source.mesh.faces, source.vertices((kind,))).all(axis=1)
        theirs = [part.vertices for part in parts if part.kind == kind]
        if not theirs or not ours.any():
            continue
        asked = np.concatenate(theirs)
        # In the axes of the head, as the warp.
        laid = source.mesh.with_vertices(source.places)
        found = SurfaceFinder(laid, np.flatnonzero(ours)).closest(
            warp.apply(target.places[asked]), limit=FARTHEST * source.unit
        )
        near = found.face >= 0
        riders.append(asked[near])
        corners.append(source.mesh.faces[found.face[near]])
        weights.append(found.weights[near])
    if not riders or not len(beyond.riders):
        return None
    places = place_matrix(np.concatenate(corners), np.concatenate(weights), count)[:, beyond.riders]
    turn = (target.unit / source.unit) * target.axes.T
    return OwnMotion(
        source.mesh.vertices.astype(np.float32),
        beyond,
        np.concatenate(riders),
        places.astype(np.float32),
        turn.astype(np.float32),
    )
