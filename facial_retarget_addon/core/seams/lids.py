"""Lids that close as far as the source's: a linear correction of a carried motion, guide by guide."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp
from scipy.spatial import cKDTree

from ..acting.eyeballs import EYES, find_eyeballs
from ..arrays import FloatArray, unit_vectors
from ..binding import apply_matrix
from ..geodesic import shortcut_graph
from ..matching.surface_fill import HarmonicFill
from ..mesh import TriMesh
from ..mpeg4.fdps import FDPS
from ..mpeg4.head import head_axes
from ..mpeg4.regions import OWN_PARTS
from ..points import FeaturePoints, common_names
from ..problem import Problem
from .margins import GuidedMargin, guided_margin, has_points, lid_steps, on_rim, opposite

GUIDES = 3
"""From a corner of the eye to the middle of a lid."""
AROUND = 1.5
"""How far from its middle an eye's margins are looked for, in widths of the eye."""
PAST = 0.75
"""How far from the point of a lid's middle its margin may go by, in openings of the eye."""
REACH = 0.5
"""How far a correction reaches from the margin, in widths of the eye."""
LEAST, MOST = 1 / 3, 3.0
"""Bounds of the ratio between the openings of two eyes, in the scale of the heads."""
FADED = 4.0
"""Times `REACH` beyond which nothing is left of a correction."""
THIN = 0.1
"""Openings below this share of the eye's greatest tell no ratio."""
_SLIGHT = 1e-3
"""Shares of a correction below this are left out."""


class Guides(NamedTuple):
    """The guides of one margin and the places of the other margin that they face; (G, V) csr each."""

    own: sp.csr_matrix
    facing: sp.csr_matrix

    @property
    def parting(self) -> sp.csr_matrix:
        """(G, V) takes positions to the vectors from the places faced to the guides."""
        return (self.own - self.facing).tocsr()

    def openings(self, positions: FloatArray) -> FloatArray:
        """(G, 3) from each place faced to the guide, for positions (V, 3)."""
        gaps: FloatArray = self.parting @ positions
        return gaps

    def across(self, vertices: FloatArray) -> FloatArray:
        """(G, 3) the openings of the neutral (V, 3), without what lies along the line between the eye's corners."""
        margin = self.own @ vertices
        line = unit_vectors(margin[-1:] - margin[:1])
        gaps = self.openings(vertices)
        across: FloatArray = gaps - (gaps @ line.T) * line
        return across

    def mean(self, matrices: FloatArray) -> FloatArray:
        """(G, 3, 3) of matrices (V, 3, 3) at the vertices: half-way between a guide and the place that it faces."""
        flat = matrices.reshape(-1, 9)
        halfway: FloatArray = 0.5 * (self.own @ flat + self.facing @ flat).reshape(-1, 3, 3)
        return halfway


@dataclass(frozen=True, eq=False)
class EyeMargins:
    """Upper and lower margin of one eye, and what the guides of each face on the other."""

    upper: GuidedMargin
    lower: GuidedMargin
    above: Guides
    below: Guides

    @classmethod
    def paired(cls, mesh: TriMesh, upper: GuidedMargin, lower: GuidedMargin) -> EyeMargins:
        """Guides face the place of the other margin that lies as far along the line between the corners."""
        above, below = (
            Guides(own.guides, opposite(mesh, own.guides @ mesh.vertices, other.vertices))
            for own, other in ((upper, lower), (lower, upper))
        )
        return cls(upper, lower, above, below)


def find_eye_margins(mesh: TriMesh, points: FeaturePoints) -> dict[str, EyeMargins]:
    """The margins of each eye (left, right) whose lids and corners are among the points.

    The ways along the margins are those of `acting.eyelids`, but they need not go through a point behind the rim.
    """
    known = points.subset([name for name in points.names if name in FDPS])
    wanted = {side: names for side, names in EYES.items() if has_points(known, names[:4])}
    if not wanted:
        return {}
    balls = find_eyeballs(mesh, known, head_axes(known.names, known.positions(mesh.vertices)))
    found: dict[str, EyeMargins] = {}
    for side, (upper, lower, outer, inner, _) in wanted.items():
        ends = known.subset([outer, inner]).positions(mesh.vertices)
        near = np.linalg.norm(mesh.vertices - ends.mean(axis=0), axis=1) < AROUND * np.linalg.norm(ends[0] - ends[1])
        around = lid_steps(
            mesh, shortcut_graph(TriMesh(mesh.vertices, mesh.faces[near[mesh.faces].all(axis=1)])), balls[side]
        )
        corners, middles = known.subset([outer, inner]).holders, known.subset([upper, lower]).holders
        reach = PAST * float(np.linalg.norm(mesh.vertices[middles[0]] - mesh.vertices[middles[1]]))
        margins = []
        for place in middles:
            middle = on_rim(mesh, around, (int(corners[0]), int(corners[1])), int(place), reach)
            margins.append(guided_margin(mesh, around, np.array([corners[0], middle, corners[1]]), GUIDES))
        if margins[0] is not None and margins[1] is not None:
            found[side] = EyeMargins.paired(mesh, margins[0], margins[1])
    return found


class FewRows:
    """A matrix with few rows, which looks at the few vertices alone that it reads."""

    def __init__(self, matrix: sp.csr_matrix) -> None:
        self._columns = np.unique(matrix.indices)
        self._matrix = matrix[:, self._columns].astype(np.float32)

    def __call__(self, values: FloatArray) -> FloatArray:
        """(F, rows, 3) for values (F, V, 3)."""
        return apply_matrix(self._matrix, values[:, self._columns])


class LidSeams:
    """Corrects a carried motion so that the target's lids do what the source's do.

    A guide of a margin moves as the source's guide, turned and scaled as the heads are; along the opening it moves by
    the same share of its own eye's opening. What a carried motion misses of that is added at the margins and spread
    over the lids, so that a lid that shuts on the source shuts on the target.

    Parameters
    ----------
    source, target : margins by side; those of one face alone are left aside.
    faces : the neutral meshes.
    measured : (Vs, 3, 3) what displacements of the source are in units of the motion.
    turns : (Vt, 3, 3) what those are in displacements of the target.
    """

    def __init__(
        self,
        source: dict[str, EyeMargins],
        target: dict[str, EyeMargins],
        faces: tuple[TriMesh, TriMesh],
        measured: FloatArray,
        turns: FloatArray,
    ) -> None:
        self.sides = tuple(side for side in source if side in target)
        count = len(faces[1].vertices)
        if not self.sides:
            return
        read, carried, maps = [], [], []
        for side in self.sides:
            ours, theirs = source[side], target[side]
            for own, other in ((ours.above, theirs.above), (ours.below, theirs.below)):
                read.append(own.own)
                carried.append(other.own)
                maps.append(_lid_maps(own, other, faces, measured, turns))
        self._read, self._carried = (FewRows(sp.vstack(rows).tocsr()) for rows in (read, carried))
        self._maps = np.concatenate(maps).astype(np.float32)
        spread = _spread(faces[1], [target[side] for side in self.sides], count)
        self._reached = np.flatnonzero(spread.getnnz(axis=1))
        self._spread = spread[self._reached].astype(np.float32)

    def correct(self, displacements: FloatArray, source: FloatArray) -> FloatArray:
        """Target displacements (F, Vt, 3) float32, corrected in place, for the source's (F, Vs, 3)."""
        return self.add(displacements, self.missed(displacements, source)) if self.sides else displacements

    def missed(self, displacements: FloatArray, source: FloatArray) -> FloatArray:
        """(F, G, 3) what the target's displacements (F, Vt, 3) miss at its guides, for the source's (F, Vs, 3)."""
        missed: FloatArray = np.einsum("gij,fgj->fgi", self._maps, self._read(source)) - self._carried(displacements)
        return missed

    def add(self, displacements: FloatArray, missed: FloatArray) -> FloatArray:
        """Displacements (F, Vt, 3) float32 with what is missed at the guides (F, G, 3) added in place."""
        displacements[:, self._reached] += apply_matrix(self._spread, missed)
        return displacements


def lid_seams(problem: Problem, turns: FloatArray, measured: FloatArray | None = None) -> LidSeams:
    """Lids of a problem's faces; parameters as for `LidSeams`, `measured` None for the source's own coordinates."""
    source, target = problem.source, problem.target
    names = [name for name in common_names(source.points, target.points) if name not in OWN_PARTS]
    ours, theirs = (find_eye_margins(face.mesh, face.points.subset(names)) for face in (source, target))
    if measured is None:
        measured = np.broadcast_to(np.eye(3), (len(source.mesh.vertices), 3, 3))
    return LidSeams(ours, theirs, (source.mesh, target.mesh), measured, turns)


def _lid_maps(
    ours: Guides, theirs: Guides, faces: tuple[TriMesh, TriMesh], measured: FloatArray, turns: FloatArray
) -> FloatArray:
    """(G, 3, 3) what a guide's displacement on the source becomes on the target.

    K = T (I + (r - 1) e e'), T the turn and scale of the place, e the direction in which the source's eye opens there,
    and r the ratio of the target's opening to the source's, both across the line between the corners.
    """
    turn = theirs.mean(turns) @ ours.mean(measured)
    before, after = (lid.across(mesh.vertices) for lid, mesh in zip((ours, theirs), faces, strict=True))
    gaps = [np.linalg.norm(gap, axis=1) for gap in (np.einsum("gij,gj->gi", turn, before), after)]
    sizes = [gap + THIN * gap.max() for gap in gaps]
    ratio = np.clip(sizes[1] / np.maximum(sizes[0], 1e-300), LEAST, MOST)
    opens = unit_vectors(before)
    stretch = np.eye(3) + (ratio - 1)[:, None, None] * opens[:, :, None] * opens[:, None, :]
    maps: FloatArray = turn @ stretch
    return maps


def _spread(mesh: TriMesh, eyes: list[EyeMargins], count: int) -> sp.csr_matrix:
    """(V, guides) values at the guides of all margins to the vertices: over the margins, then fading into the lids."""
    margins = [margin for eye in eyes for margin in (eye.upper, eye.lower)]
    starts = np.cumsum([0] + [margin.guides.shape[0] for margin in margins])
    rows, columns, weights = [], [], []
    for margin, start in zip(margins, starts, strict=False):
        entries = margin.spread.tocoo()
        rows.append(margin.vertices[entries.row])
        columns.append(entries.col + start)
        weights.append(entries.data)
    entries = np.concatenate(weights), (np.concatenate(rows), np.concatenate(columns))
    at_margins = sp.csr_matrix(entries, shape=(count, starts[-1]))
    # Corners belong to both margins.
    owners = np.asarray(at_margins.sum(axis=1)).ravel()
    at_margins = sp.diags(1 / np.maximum(owners, 1e-300)) @ at_margins
    ends = [(eye.upper.guides @ mesh.vertices)[[0, -1]] for eye in eyes]
    width = float(np.mean([np.linalg.norm(pair[0] - pair[1]) for pair in ends]))
    away = cKDTree(mesh.vertices[owners > 0]).query(mesh.vertices, distance_upper_bound=FADED * REACH * width)[0]
    decay = mesh.vertex_edge_length / (REACH * width) ** 2
    known = (owners > 0) | ~np.isfinite(away)
    spread = HarmonicFill(mesh, known, decay).values(at_margins.toarray())
    return sp.csr_matrix(np.where(np.abs(spread) < _SLIGHT, 0.0, spread))
