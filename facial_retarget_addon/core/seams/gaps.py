"""How far lips and lids are open, frame by frame, on both faces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..points import FeaturePoints
from ..problem import Face, Problem
from .lids import EyeMargins, FewRows, find_eye_margins
from .margins import has_points

LIPS = (("2.2", "2.3"), ("2.6", "2.8"), ("2.7", "2.9"))
"""FDPs opposite to one another on the inner edges of the lips."""
OUTER_LIPS = (("8.1", "8.2"),)
"""The same on their outer edges, where the inner ones are not told apart."""
MOUTH = (("2.4", "2.5"), ("8.3", "8.4"))
"""FDPs of the corners of the mouth: the inner ones, or else the outer ones."""

SHARED = 0.5
"""Points that share this much of the vertices' weights that hold them are one place."""


@dataclass(frozen=True, eq=False)
class _LidOpening:
    """The opening of one eye, across the line between its corners: 100 in the neutral, 0 where the margins meet along
    their whole length.
    """

    gaps: FewRows
    directions: FloatArray
    whole: float

    @classmethod
    def measured(cls, eye: EyeMargins, vertices: FloatArray) -> _LidOpening:
        neutral = eye.above.across(vertices)
        sizes = np.linalg.norm(neutral, axis=1)
        directions = neutral / np.maximum(sizes, 1e-300)[:, None]
        return cls(FewRows(eye.above.parting), directions, float(sizes.sum()))

    def percent(self, frames: FloatArray) -> FloatArray:
        """(F,) of frames (F, V, 3)."""
        gaps = np.einsum("fgi,gi->fg", self.gaps(frames), self.directions)
        percent: FloatArray = 100 * gaps.sum(axis=1) / max(self.whole, 1e-300)
        return percent


@dataclass(frozen=True, eq=False)
class _LipOpening:
    """How much farther the lips are apart than in the neutral, in percent of the mouth's width."""

    upper: FeaturePoints
    lower: FeaturePoints
    neutral: FloatArray
    width: float

    @classmethod
    def measured(cls, face: Face, pairs: Sequence[tuple[str, str]]) -> _LipOpening | None:
        points, vertices = face.points, face.mesh.vertices
        corners = [pair for pair in MOUTH if has_points(points, pair)]
        if not pairs or not corners:
            return None
        upper, lower = (points.subset([pair[k] for pair in pairs]) for k in (0, 1))
        left, right = points.subset(corners[0]).positions(vertices)
        neutral = np.linalg.norm(upper.positions(vertices) - lower.positions(vertices), axis=1)
        return cls(upper, lower, neutral, float(np.linalg.norm(left - right)))

    def percent(self, frames: FloatArray) -> FloatArray:
        """(F,) of frames (F, V, 3)."""
        gaps = np.linalg.norm(self.upper.positions(frames) - self.lower.positions(frames), axis=2)
        percent: FloatArray = 100 * (gaps - self.neutral).mean(axis=1) / max(self.width, 1e-300)
        return percent


class SeamGaps:
    """Measures both faces of a problem; what their points do not tell is left out.

    Of the eyes, the one that is more shut on the source counts.
    """

    def __init__(self, problem: Problem) -> None:
        faces = (problem.source, problem.target)
        eyes = [find_eye_margins(face.mesh, face.points) for face in faces]
        both = [side for side in eyes[0] if side in eyes[1]]
        self._lids = [
            [_LidOpening.measured(found[side], face.mesh.vertices) for side in both]
            for found, face in zip(eyes, faces, strict=True)
        ]
        pairs = _lip_pairs([face.points for face in faces])
        self._lips = [_LipOpening.measured(face, pairs) for face in faces]

    def measured(self, source: FloatArray, target: FloatArray) -> Mapping[str, list[float]]:
        """A figure for each of the frames (F, Vs, 3) and (F, Vt, 3).

        lid_gap_percent, source_lid_gap_percent : of the eye's neutral opening.
        lip_gap_percent, source_lip_gap_percent : more than in the neutral, of the mouth's width.
        """
        found: dict[str, list[float]] = {}
        if self._lids[0]:
            ours, theirs = (
                np.stack([lid.percent(frames) for lid in lids])
                for lids, frames in zip(self._lids, (source, target), strict=True)
            )
            more_shut, every = ours.argmin(axis=0), np.arange(len(source))
            found["lid_gap_percent"] = theirs[more_shut, every].tolist()
            found["source_lid_gap_percent"] = ours[more_shut, every].tolist()
        lips = self._lips
        if lips[0] is not None and lips[1] is not None:
            found["lip_gap_percent"] = lips[1].percent(target).tolist()
            found["source_lip_gap_percent"] = lips[0].percent(source).tolist()
        return found


def _lip_pairs(faces: Sequence[FeaturePoints]) -> list[tuple[str, str]]:
    """Points opposite to one another on the lips that are different places on all faces."""
    for pairs in (LIPS, OUTER_LIPS):
        found = [pair for pair in pairs if all(_are_apart(points, pair) for points in faces)]
        if found:
            return found
    return []


def _are_apart(points: FeaturePoints, pair: tuple[str, str]) -> bool:
    """Whether a face has both points, and they share less than half of what holds them; lips that touch are apart."""
    if not has_points(points, pair):
        return False
    two = points.subset(pair)
    one, other = two.matrix(int(two.vertices.max()) + 1).toarray()
    return float(np.minimum(one, other).sum()) < SHARED
