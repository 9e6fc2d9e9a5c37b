"""Eyelids: their margins, so that a lid closes along its whole width, and over the eyeball."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

from .arrays import FloatArray, IntArray, unit_vectors
from .eyeballs import EYES, Eyeball
from .geodesic import shortcut_graph
from .mesh import TriMesh
from .points import FeaturePoints

PLACES = (0.15, 0.3, 0.5, 0.7, 0.85)
"""Where guides stand between a corner (0) and the lid's middle (1)."""
OUTSIDE = 0.0
"""A lid's skin looks away from the eyeball by more than this cosine; its margin looks sideways, its inside back."""
INSIDE_COST = 20.0
"""How much longer a way counts where the surface looks at the eyeball."""
CLEAR = 1.01
"""Skin that a lid drags over an eyeball stays outside by this factor, where it was outside before."""


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
    """

    side: str
    middle: str
    vertices: IntArray
    gaps: FloatArray
    gap: FloatArray

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


def find_lids(mesh: TriMesh, points: FeaturePoints, eyeballs: Mapping[str, Eyeball]) -> list[Lid]:
    """The margins of the lids over each eyeball; its lids and corners are among the points.

    The margin is the cheapest way from corner to middle to corner, where skin that looks at the eyeball costs more: it
    hugs the eye's opening, which lies between.
    """
    lids: list[Lid] = []
    for side, ball in eyeballs.items():
        upper, lower, outer, inner, _ = EYES[side]
        away = unit_vectors(mesh.vertices - ball.centre)
        inwards = np.clip(OUTSIDE - np.einsum("vi,vi->v", mesh.vertex_normals, away), 0.0, 1.0)
        graph = _costly(shortcut_graph(mesh), 1 + INSIDE_COST * inwards)
        corners = points.subset([inner, outer]).positions(mesh.vertices)
        margins = {name: _margin(mesh, graph, points.subset([inner, name, outer]), corners) for name in (upper, lower)}
        for name, other in ((upper, lower), (lower, upper)):
            lids.append(_lid(mesh, side, name, margins[name], margins[other], points, corners))
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


def _costly(graph: sp.csr_matrix, factors: FloatArray) -> sp.csr_matrix:
    """The steps of a graph, each longer by the mean of its ends' factors (V,)."""
    steps = graph.tocoo()
    cost = steps.data * 0.5 * (factors[steps.row] + factors[steps.col])
    return sp.csr_matrix((cost, (steps.row, steps.col)), shape=graph.shape)


def _share(places: FloatArray, corners: FloatArray) -> FloatArray:
    line = corners[1] - corners[0]
    share: FloatArray = (places - corners[0]) @ line / (line @ line)
    return share


def _margin(mesh: TriMesh, graph: sp.csr_matrix, three: FeaturePoints, corners: FloatArray) -> _Margin:
    """The margin through corner, middle, corner; only the middle where there is no way over the skin."""
    holder = three.vertices[np.arange(3), three.weights.argmax(axis=1)]
    found = [_way(graph, int(holder[1]), int(holder[end])) for end in (0, 2)]
    vertices = np.unique(np.concatenate([holder[1:2], *found]))
    share = _share(mesh.vertices[vertices], corners)
    inside = (share > 0) & (share < 1)
    vertices, share = vertices[inside], share[inside]
    order = np.argsort(share)
    middle = float(_share(three.positions(mesh.vertices)[1:2], corners)[0])
    return _Margin(vertices[order], share[order], middle)


def _way(graph: sp.csr_matrix, start: int, stop: int) -> IntArray:
    """Vertices of the shortest way, none if there is no way."""
    distance, before = dijkstra(graph, directed=False, indices=start, return_predecessors=True)
    if not np.isfinite(distance[stop]):
        return np.empty(0, np.int64)
    way = [stop]
    while before[way[-1]] >= 0:
        way.append(int(before[way[-1]]))
    return np.array(way, np.int64)


def _lid(
    mesh: TriMesh, side: str, name: str, own: _Margin, other: _Margin, points: FeaturePoints, corners: FloatArray
) -> Lid:
    wanted = np.concatenate([own.middle * np.array(PLACES), 1 - (1 - own.middle) * np.array(PLACES)[::-1]])
    taken = {int(v) for v in points.vertices[points.weights > 0]}
    free = np.array([int(v) not in taken for v in own.vertices], bool)
    vertices, share = own.vertices[free], own.share[free]
    chosen = np.unique(np.abs(share[:, None] - wanted).argmin(axis=0)) if len(vertices) else np.empty(0, np.int64)
    gaps = other.at(mesh, share[chosen], corners) - mesh.vertices[vertices[chosen]]
    middle = points.subset([name]).positions(mesh.vertices)
    gap = other.at(mesh, np.array([own.middle]), corners)[0] - middle[0]
    return Lid(side, name, vertices[chosen], gaps, gap)


def over_the_ball(mesh: TriMesh, ball: Eyeball, skin: IntArray, moved: FloatArray) -> FloatArray:
    """What lifts skin out of an eyeball that it passed through: displacements (n, 3) to add.

    Skin that lay outside the ball stays outside; the ball's own surface counts, with its cornea, where it has one.

    Parameters
    ----------
    mesh : the neutral.
    skin : (n,) vertices of the skin.
    moved : (n, 3) their positions after a lid's motion.
    """
    away, before = moved - ball.centre, mesh.vertices[skin] - ball.centre
    wanted = CLEAR * _ball_radius(mesh, ball, away)
    outside = np.linalg.norm(before, axis=1) >= _ball_radius(mesh, ball, before)
    lift = np.where(outside, np.maximum(wanted - np.linalg.norm(away, axis=1), 0.0), 0.0)
    lifted: FloatArray = unit_vectors(away) * lift[:, None]
    return lifted


def _ball_radius(mesh: TriMesh, ball: Eyeball, directions: FloatArray) -> FloatArray:
    """(n,) how far an eyeball's surface reaches from its centre in directions (n, 3)."""
    if not len(ball.vertices):
        return np.full(len(directions), ball.radius)
    surface = mesh.vertices[ball.vertices] - ball.centre
    radius = np.linalg.norm(surface, axis=1)
    nearest = cKDTree(unit_vectors(surface)).query(unit_vectors(directions), k=min(6, len(radius)))[1]
    reach: FloatArray = radius[nearest].max(axis=1)
    return reach
