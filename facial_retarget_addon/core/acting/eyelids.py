"""Eyelids: their margins, so that a lid closes along its whole width, and over the eyeball."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.spatial import cKDTree

from ..arrays import FloatArray, IntArray, unit_vectors
from ..geodesic import shortcut_graph
from ..mesh import TriMesh
from ..points import FeaturePoints
from ..seams.margins import lid_steps, shortest_way
from .eyeballs import EYES, Eyeball

PLACES = (0.15, 0.3, 0.5, 0.7, 0.85)
"""Where guides stand between a corner (0) and the lid's middle (1)."""
CLEAR = 1.02
"""A closed lid's margin is at least this many times as far from the centre as the eyeball's surface."""
MOST_RISE = 0.08
"""The most that a closing margin rises from the eyeball, in radii, where the head has one."""
AROUND = 0.15
"""Radians around a direction in which the eyeball's farthest place counts."""
NEAREST = 6
"""Places of the eyeball that are looked at in a direction."""


@dataclass(frozen=True, eq=False)
class Lid:
    """One lid's margin.

    Attributes
    ----------
    side : of the head, left or right.
    middle : FDP of its middle.
    vertices : (G,) the guides, vertices along the margin from one corner to the other, without the middle.
    gaps : (G, 3) from each guide to the other lid's margin, in the object's axes and units.
    gap : (3,) the same for the middle.
    rises : (G,) by how much farther from the eyeball's centre the other margin lies; rise the same for the middle.
    """

    side: str
    middle: str
    vertices: IntArray
    gaps: FloatArray
    gap: FloatArray
    rises: FloatArray
    rise: float

    def shut(self, displacements: FloatArray) -> FloatArray:
        """(F,) how far displacements (F, 3) of the middle shut the lid: 0 open, 1 on the other lid."""
        share: FloatArray = displacements @ self.gap / (self.gap @ self.gap)
        return share

    def guidance(self) -> FloatArray:
        """(G, 3, 3) what a displacement of the middle does to each guide.

        Along the gap a guide closes by the same share of its own gap; across it, the motion shrinks towards the
        corners as the gap does.
        """
        along = unit_vectors(self.gap)
        length = float(np.linalg.norm(self.gap))
        shut = np.einsum("gi,j->gij", self.gaps, along) / length
        sizes = np.linalg.norm(self.gaps, axis=1) / length
        return shut + sizes[:, None, None] * (np.eye(3) - np.outer(along, along))


def half_shut(share: FloatArray) -> FloatArray:
    """0 for lids that are open or shut (share 0 or 1), 1 for lids on half the way."""
    clipped = np.clip(share, 0.0, 1.0)
    half: FloatArray = 4 * clipped * (1 - clipped)
    return half


def find_lids(mesh: TriMesh, points: FeaturePoints, eyeballs: Mapping[str, Eyeball]) -> list[Lid]:
    """The margins of the lids over each eyeball; its lids and corners are among the points.

    The margin is the cheapest way from corner to middle to corner, where skin that looks at the eyeball costs more: it
    hugs the eye's opening, which lies between.
    """
    lids: list[Lid] = []
    steps = shortcut_graph(mesh) if eyeballs else None
    for side, ball in eyeballs.items():
        upper, lower, outer, inner, _ = EYES[side]
        graph = lid_steps(mesh, steps, ball)
        corners = points.subset([inner, outer]).positions(mesh.vertices)
        margins = {name: _margin(mesh, graph, points.subset([inner, name, outer]), corners) for name in (upper, lower)}
        for name, other in ((upper, lower), (lower, upper)):
            lids.append(_lid(mesh, ball, name, margins[name], margins[other], points, corners))
    return [lid for lid in lids if np.linalg.norm(lid.gap) > 0]


@dataclass(frozen=True, eq=False)
class _Margin:
    """Vertices of a margin in order of their share (0 to 1) of the way along the line between the corners."""

    vertices: IntArray
    share: FloatArray
    middle: float

    def at(self, mesh: TriMesh, share: FloatArray, ends: FloatArray) -> FloatArray:
        """Places (n, 3) of the margin at shares (n,); ends (2, 3) are the corners."""
        known = np.concatenate([[0.0], self.share, [1.0]])
        places = np.concatenate([ends[:1], mesh.vertices[self.vertices], ends[1:]])
        return np.stack([np.interp(share, known, places[:, c]) for c in range(3)], axis=1)


def _share(places: FloatArray, corners: FloatArray) -> FloatArray:
    line = corners[1] - corners[0]
    share: FloatArray = (places - corners[0]) @ line / (line @ line)
    return share


def _margin(mesh: TriMesh, graph: sp.csr_matrix, three: FeaturePoints, corners: FloatArray) -> _Margin:
    """The margin through corner, middle, corner; only the middle where there is no way over the skin."""
    holder = three.holders
    found = [shortest_way(graph, int(holder[1]), int(holder[end])) for end in (0, 2)]
    vertices = np.unique(np.concatenate([holder[1:2], *found]))
    share = _share(mesh.vertices[vertices], corners)
    inside = (share > 0) & (share < 1)
    vertices, share = vertices[inside], share[inside]
    order = np.argsort(share)
    middle = float(_share(three.positions(mesh.vertices)[1:2], corners)[0])
    return _Margin(vertices[order], share[order], middle)


def _lid(
    mesh: TriMesh, ball: Eyeball, name: str, own: _Margin, other: _Margin, points: FeaturePoints, corners: FloatArray
) -> Lid:
    wanted = np.concatenate([own.middle * np.array(PLACES), 1 - (1 - own.middle) * np.array(PLACES)[::-1]])
    taken = {int(v) for v in points.vertices[points.weights > 0]}
    free = np.array([int(v) not in taken for v in own.vertices], bool)
    vertices, share = own.vertices[free], own.share[free]
    chosen = np.arange(len(vertices))
    if len(vertices) > len(wanted):
        chosen = np.unique(np.abs(share[:, None] - wanted).argmin(axis=0))
    gaps = other.at(mesh, share[chosen], corners) - mesh.vertices[vertices[chosen]]
    middle = points.subset([name]).positions(mesh.vertices)
    gap = other.at(mesh, np.array([own.middle]), corners) - middle
    places = np.concatenate([mesh.vertices[vertices[chosen]], middle]) - ball.centre
    arrived = places + np.concatenate([gaps, gap])
    # A margin that dips into the eyeball comes out of it as the lid closes.
    distance = np.maximum(np.linalg.norm(arrived, axis=1), CLEAR * _reach(mesh, ball, arrived))
    rises = distance - np.linalg.norm(places, axis=1)
    if len(ball.vertices):
        rises = np.minimum(rises, MOST_RISE * ball.radius)
    return Lid(ball.side, name, vertices[chosen], gaps, gap[0], rises[:-1], float(rises[-1]))


def around_the_ball(
    mesh: TriMesh, ball: Eyeball, skin: IntArray, displacement: FloatArray, rise: FloatArray
) -> FloatArray:
    """A lid's straight motion bent around the eyeball: displacements (n, 3).

    Every vertex goes where its straight path points to, seen from the ball's centre, but keeps its distance from the
    centre: what was outside stays outside, what was inside stays inside. Where the ball itself reaches farther, as at
    its cornea, the skin rises with it.

    Parameters
    ----------
    mesh : the neutral.
    skin : (n,) vertices.
    displacement : (n, 3) their straight motion.
    rise : (n,) by how much their distance from the centre shall grow.
    """
    before = mesh.vertices[skin] - ball.centre
    towards = unit_vectors(before + displacement)
    bulge = np.maximum(_reach(mesh, ball, towards) - _reach(mesh, ball, before), 0.0)
    distance = np.linalg.norm(before, axis=1) + rise + bulge
    bent: FloatArray = towards * distance[:, None] - before
    return bent


def _reach(mesh: TriMesh, ball: Eyeball, directions: FloatArray) -> FloatArray:
    """(n,) how far an eyeball reaches from its centre around directions (n, 3), at most; 0 where none was found."""
    if not len(ball.vertices):
        return np.zeros(len(directions))
    surface = mesh.vertices[ball.vertices] - ball.centre
    radius = np.linalg.norm(surface, axis=1)
    tree = cKDTree(unit_vectors(surface))
    pairs = tree.sparse_distance_matrix(tree, AROUND, output_type="coo_matrix")
    farthest = radius.copy()
    np.maximum.at(farthest, pairs.row, radius[pairs.col])
    nearest = tree.query(unit_vectors(directions), k=min(NEAREST, len(radius)))[1]
    reach: FloatArray = farthest[nearest].mean(axis=1)
    return reach
