"""What lies in the mouth of a retargeted face: teeth and gums go with jaw and skull, the tongue also acts by itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray, IntArray
from ..closest_point import SurfaceFinder
from ..mesh import TriMesh
from ..points import place_matrix
from .find import Part
from .follow import WITH_JAW, jaw_share
from .jaw import BoneReader, ChinReader, JawReader, RigidMotion, hinge_of, shows_turns
from .kinds import BOTH, LOWER, TONGUE, UPPER
from .known_head import KnownHead, scale_between

IN_MOUTH = (UPPER, *WITH_JAW)
"""Kinds of parts that jaw and skull carry."""
BEHIND = (0.07, 0.2)
"""Teeth of a source whose chin shows them to drop farther than they do, by more than the first in eye separations, are
left behind, wholly from the second on. Muscles lower a chin by less; teeth that move drop farther than a soft chin."""


@dataclass(frozen=True, eq=False)
class Tongues:
    """How a tongue acts as another does, both as the jaw sees them and in the axes of their heads.

    Attributes
    ----------
    vertices : (m,) of the source's. away : (m, 3) from its hinge.
    rows : (k,) of the target's, among what lies in its mouth.
    matrix : (k, m) places on the source's.
    """

    vertices: IntArray
    away: FloatArray
    rows: IntArray
    matrix: sp.csr_matrix


@dataclass(frozen=True, eq=False)
class Mouth:
    """What moves in the target's mouth.

    The jaw moves as the source's lower teeth do; turns are copied, shifts are scaled as the heads are. Where the source
    has no lower teeth, or where they stay behind its opening chin, it moves as the target's own chin shows. The skull
    moves as the source's upper teeth do.

    Attributes
    ----------
    axes : (3, 3) of the source's head and of the target's.
    rest : (Vs, 3) the source's neutral, in float32.
    riders : (n,) vertices of the target. away : (n, 3) from the target's hinge. share : (n, 1) of the jaw's motion.
    chins : read the jaw off the source's and the target's skin.
    jaw, skull : read the source's teeth; None where there are none.
    scale : target lengths per source length. unit : distance of the source's eyes.
    """

    axes: tuple[FloatArray, FloatArray]
    rest: FloatArray
    riders: IntArray
    away: FloatArray
    share: FloatArray
    chins: tuple[ChinReader, ChinReader]
    jaw: BoneReader | None
    skull: BoneReader | None
    tongues: Tongues | None
    scale: float
    unit: float

    def add_to(self, displacements: FloatArray, frames: FloatArray) -> FloatArray:
        """Target displacements (F, Vt, 3) of the skin with the mouth's added, in place, for frames (F, Vs, 3)."""
        ours, theirs = self.chins
        seen = self._seen(ours, frames)
        jaw = theirs.motion(displacements[:, theirs.vertices].astype(np.float64) @ self.axes[1].T)
        if self.jaw is not None:
            shown, seen = seen, self._seen(self.jaw, frames)
            behind = (seen.displacements(self.jaw.middle) - shown.displacements(self.jaw.middle))[:, 0, 1]
            left = np.clip((behind / self.unit - BEHIND[0]) / (BEHIND[1] - BEHIND[0]), 0.0, 1.0)
            jaw = self._scaled(seen).towards(jaw, left * left * (3 - 2 * left))
        moved = self.share * jaw.displacements(self.away)
        if self.skull is not None:
            moved += (1 - self.share) * self._scaled(self._seen(self.skull, frames)).displacements(self.away)
        if self.tongues is not None:
            tongue = self.tongues
            acts = seen.undone(tongue.away, self._moved(frames, tongue.vertices))
            there = np.stack([tongue.matrix @ one for one in acts]) * self.scale
            moved[:, tongue.rows] = there + jaw.displacements(self.away[tongue.rows] + there)
        displacements[:, self.riders] += moved @ self.axes[1]
        return displacements

    def moves(self) -> IntArray:
        """(m,) vertices that move."""
        moving = self.share[:, 0] > 0 if self.skull is None else np.ones(len(self.share), bool)
        return self.riders[moving]

    def does(self) -> dict[str, str]:
        """Kind of part -> what those that move do."""
        jaw = "as the chin shows" if self.jaw is None else "as the source's does"
        lower, half = f"goes with the jaw, which moves {jaw}", f"its lower half goes with the jaw, which moves {jaw}"
        tongue = (
            lower if self.tongues is None else f"acts as the source's does, and goes with the jaw, which moves {jaw}"
        )
        return {UPPER: "moves as the source's does", LOWER: lower, TONGUE: tongue, BOTH: half}

    def _moved(self, frames: FloatArray, vertices: IntArray) -> FloatArray:
        """(F, n, 3) displacements of the source's vertices, in its head's axes."""
        moved: FloatArray = (frames[:, vertices].astype(np.float64) - self.rest[vertices]) @ self.axes[0].T
        return moved

    def _seen(self, reader: JawReader, frames: FloatArray) -> RigidMotion:
        """A motion of the source's."""
        return reader.motion(self._moved(frames, reader.vertices))

    def _scaled(self, motion: RigidMotion) -> RigidMotion:
        """A motion of the source's, of the target."""
        return RigidMotion(motion.turns, motion.shifts * self.scale)


def fit_mouth(source: KnownHead, target: KnownHead, parts: Sequence[Part]) -> Mouth | None:
    """Let the parts of the target's mouth move; None where there are none, or where nothing shows where they are.

    Parameters
    ----------
    parts : those of the target that may move.
    """
    inside = [part for part in parts if part.kind in IN_MOUTH]
    if not inside or not source.shown or not target.shown:
        return None
    riders = np.sort(np.concatenate([part.vertices for part in inside]))
    hinge, there = hinge_of(source), hinge_of(target)
    lower = source.vertices((LOWER,))
    if not len(lower):
        lower = np.flatnonzero(jaw_share(source, source.parts) == 1)
        lower = np.setdiff1d(lower, source.vertices((TONGUE,)))
    jaw, skull = (_bone(source, vertices, hinge) for vertices in (lower, source.vertices((UPPER,))))
    away = target.places[riders] - there
    tongue = np.concatenate([np.empty(0, np.int64), *(part.vertices for part in inside if part.kind == TONGUE)])
    return Mouth(
        (source.axes, target.axes),
        source.mesh.vertices.astype(np.float32).astype(np.float64),
        riders,
        away,
        jaw_share(target, inside)[riders, None],
        (ChinReader(source, hinge), ChinReader(target, there)),
        jaw,
        skull,
        _tongues(source, target, np.sort(tongue), riders, hinge),
        scale_between(source, target),
        source.unit,
    )


def _bone(head: KnownHead, vertices: IntArray, hinge: FloatArray) -> BoneReader | None:
    return BoneReader(vertices, head.places, hinge) if shows_turns(head.places[vertices]) else None


def _tongues(
    source: KnownHead, target: KnownHead, tongue: IntArray, riders: IntArray, hinge: FloatArray
) -> Tongues | None:
    """The tongues, each laid into the box of the other; None where one is missing, or the source's is no surface."""
    ours = source.vertices((TONGUE,))
    held: BoolArray = np.isin(source.mesh.faces, ours).all(axis=1)
    if not len(tongue) or not held.any():
        return None
    boxes = [head.places[vertices] for head, vertices in ((source, ours), (target, tongue))]
    low = [box.min(axis=0) for box in boxes]
    size = [
        np.maximum(np.ptp(box, axis=0), 1e-6 * head.unit) for box, head in zip(boxes, (source, target), strict=True)
    ]
    laid = TriMesh((source.places - low[0]) / size[0], source.mesh.faces)
    found = SurfaceFinder(laid, np.flatnonzero(held)).closest((boxes[1] - low[1]) / size[1])
    row = np.searchsorted(ours, source.mesh.faces[found.face])
    matrix = place_matrix(row, found.weights, len(ours))
    return Tongues(ours, source.places[ours] - hinge, np.searchsorted(riders, tongue), matrix)
