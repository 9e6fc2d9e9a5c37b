"""How far lips and lids are open, frame by frame, on both faces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, IntArray
from ..mesh import TriMesh
from ..points import FeaturePoints
from ..problem import Face, Problem
from .lids import EyeMargins, FewRows, find_eye_margins
from .margins import GuidedMargin, guided_margin, has_points

LIPS = (("2.6", "2.8"), ("2.2", "2.3"), ("2.7", "2.9"))
"""FDPs opposite to one another on the inner edges of the lips, from the left corner of the mouth to the right one."""
OUTER_LIPS = (("8.1", "8.2"),)
"""The same on their outer edges, where the inner ones are not told apart."""
MOUTH = (("2.4", "2.5"), ("8.3", "8.4"))
"""FDPs of the left and right corner of the mouth: the inner ones, or else the outer ones."""

SHARED = 0.5
"""Points that share this much of the vertices' weights that hold them are one place."""
GAPES = 0.5
"""Percent more than the source's from which an opening gapes."""
_SLIGHT = 0.1
"""Share of what the widest place of a gaping opening has too much, below which a place is left out."""


class Gaping(NamedTuple):
    """Vertices (n,) of the target's lips, and of its lids, where they are open wider than the source's."""

    lips: IntArray
    lids: IntArray


@dataclass(frozen=True, eq=False)
class _LidOpening:
    """The opening of one eye, across the line between its corners: 100 in the neutral, 0 where the margins meet along
    their whole length.
    """

    margins: tuple[GuidedMargin, GuidedMargin]
    gaps: FewRows
    directions: FloatArray
    whole: float

    @classmethod
    def measured(cls, eye: EyeMargins, vertices: FloatArray) -> _LidOpening:
        neutral = eye.above.across(vertices)
        sizes = np.linalg.norm(neutral, axis=1)
        directions = neutral / np.maximum(sizes, 1e-300)[:, None]
        return cls((eye.upper, eye.lower), FewRows(eye.above.parting), directions, float(sizes.sum()))

    def by_guide(self, frames: FloatArray) -> FloatArray:
        """(F, G) what each guide of the margins adds to the opening, for frames (F, V, 3)."""
        gaps = np.einsum("fgi,gi->fg", self.gaps(frames), self.directions)
        percent: FloatArray = 100 * gaps / max(self.whole, 1e-300)
        return percent


@dataclass(frozen=True, eq=False)
class _LipOpening:
    """How much farther the lips are apart than in the neutral, in percent of the mouth's width."""

    mesh: TriMesh
    corners: FeaturePoints
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
        upper, lower, ends = (points.subset(names) for names in (*zip(*pairs, strict=True), corners[0]))
        left, right = ends.positions(vertices)
        neutral = np.linalg.norm(upper.positions(vertices) - lower.positions(vertices), axis=1)
        return cls(face.mesh, ends, upper, lower, neutral, float(np.linalg.norm(left - right)))

    @cached_property
    def margins(self) -> tuple[GuidedMargin, GuidedMargin]:
        """Upper and lower edge of the mouth, from its left corner over the points to its right one."""
        left, right = self.corners.holders
        upper, lower = (
            _lip_margin(self.mesh, np.array([left, *lip.holders, right])) for lip in (self.upper, self.lower)
        )
        return upper, lower

    def by_guide(self, frames: FloatArray) -> FloatArray:
        """(F, G) what each guide of the margins adds, for frames (F, V, 3); nothing at the corners."""
        gaps = np.linalg.norm(self.upper.positions(frames) - self.lower.positions(frames), axis=2)
        percent = 100 * (gaps - self.neutral) / (len(self.neutral) * max(self.width, 1e-300))
        return np.pad(percent, ((0, 0), (1, 1)))

    def percent(self, frames: FloatArray) -> FloatArray:
        """(F,) of frames (F, V, 3)."""
        return self.by_guide(frames).sum(axis=1)


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
            ours, theirs = (by_guide.sum(axis=2) for by_guide in self._eyes(source, target))
            more_shut, every = ours.argmin(axis=0), np.arange(len(source))
            found["lid_gap_percent"] = theirs[more_shut, every].tolist()
            found["source_lid_gap_percent"] = ours[more_shut, every].tolist()
        lips = self._lips
        if lips[0] is not None and lips[1] is not None:
            found["lip_gap_percent"] = lips[1].percent(target).tolist()
            found["source_lip_gap_percent"] = lips[0].percent(source).tolist()
        return found

    def gaping(self, source: FloatArray, target: FloatArray) -> list[Gaping]:
        """Where the target gapes in each of the frames (F, Vs, 3) and (F, Vt, 3), by the openings of `measured`.

        Where the eye that counts gapes, the other one is told of too.
        """
        lips, lids = ([np.empty(0, np.int64)] * len(source) for _ in range(2))
        if self._lips[0] is not None and self._lips[1] is not None:
            more = self._lips[1].by_guide(target) - self._lips[0].by_guide(source)
            lips = [_gaping_vertices(self._lips[1], each) for each in more]
        if self._lids[0]:
            ours, theirs = self._eyes(source, target)
            more_shut, more = ours.sum(axis=2).argmin(axis=0), theirs - ours
            for frame, counted in enumerate(more_shut):
                if more[counted, frame].sum() >= GAPES:
                    both = [_gaping_vertices(eye, more[row, frame]) for row, eye in enumerate(self._lids[1])]
                    lids[frame] = np.concatenate(both)
        return [Gaping(*both) for both in zip(lips, lids, strict=True)]

    def _eyes(self, source: FloatArray, target: FloatArray) -> tuple[FloatArray, FloatArray]:
        """(eyes, F, G) how far the guides of each eye are open, on the source and on the target."""
        ours, theirs = (
            np.stack([lid.by_guide(frames) for lid in lids])
            for lids, frames in zip(self._lids, (source, target), strict=True)
        )
        return ours, theirs


def _gaping_vertices(opening: _LidOpening | _LipOpening, more: FloatArray) -> IntArray:
    """(n,) vertices of an opening's margins where it is too wide, by what each guide (G,) adds to that."""
    if more.sum() < GAPES:
        return np.empty(0, np.int64)
    wide = [margin.vertices[margin.spread @ more > _SLIGHT * more.max()] for margin in opening.margins]
    return np.unique(np.concatenate(wide))


def _lip_margin(mesh: TriMesh, places: IntArray) -> GuidedMargin:
    """The way along the edges of a mesh over vertices (G,), or these alone where there is none; they are its guides."""
    margin = guided_margin(mesh, mesh.graph, places, 1)
    if margin is not None:
        return margin
    each = sp.identity(len(places), format="csr")
    at = sp.csr_matrix((np.ones(len(places)), (np.arange(len(places)), places)), (len(places), len(mesh.vertices)))
    return GuidedMargin(at, places, each)


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
