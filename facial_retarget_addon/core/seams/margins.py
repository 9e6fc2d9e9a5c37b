"""Margins of an opening: chains of vertices from corner to corner, and guides that stand along them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import dijkstra

from ..acting.eyeballs import Eyeball
from ..arrays import FloatArray, IntArray, unit_vectors
from ..mesh import TriMesh
from ..points import FeaturePoints

OUTSIDE = 0.0
"""A lid's skin looks away from the eyeball by more than this cosine; its margin looks sideways, its inside back."""
INSIDE_COST = 20.0
"""How much longer a way counts where the surface looks at the eyeball."""
BEHIND = 2.0
"""A place lies behind the rim if the way through it costs this many times what one by it costs."""
_AS_SHORT = 0.02
"""Ways that are longer by less than this share are as short."""


def lid_steps(mesh: TriMesh, steps: sp.csr_matrix, ball: Eyeball) -> sp.csr_matrix:
    """The steps (V, V) of a graph on a face, longer where the surface looks at an eyeball.

    The cheapest way between two places of a lid then hugs the opening of the eye that lies between them.
    """
    away = unit_vectors(mesh.vertices - ball.centre)
    inwards = np.clip(OUTSIDE - np.einsum("vi,vi->v", mesh.vertex_normals, away), 0.0, 1.0)
    # Where the skin ends at the opening, its end is the margin, whichever way it is rolled in.
    inwards[mesh.boundary_vertices] = 0.0
    factors = 1 + INSIDE_COST * inwards
    entries = steps.tocoo()
    cost = entries.data * 0.5 * (factors[entries.row] + factors[entries.col])
    return sp.csr_matrix((cost, (entries.row, entries.col)), shape=steps.shape)


def shortest_way(steps: sp.csr_matrix, start: int, stop: int) -> IntArray:
    """Vertices of the shortest way from start to stop, both included; none if there is no way.

    steps : (V, V), the same both ways.
    """
    distance, before = dijkstra(steps, indices=start, return_predecessors=True)
    if not np.isfinite(distance[stop]):
        return np.empty(0, np.int64)
    way = [stop]
    while before[way[-1]] >= 0:
        way.append(int(before[way[-1]]))
    return np.array(way[::-1], np.int64)


@dataclass(frozen=True, eq=False)
class GuidedMargin:
    """A margin and its guides: between two of its corners that follow one another stand as many guides on every face.

    Attributes
    ----------
    guides : (G, V) csr, takes values at the vertices to the guides'.
    vertices : (n,) of the margin, from corner to corner.
    spread : (n, G) csr, takes values at the guides to the margin's vertices; rows add up to 1.
    """

    guides: sp.csr_matrix
    vertices: IntArray
    spread: sp.csr_matrix


def on_rim(mesh: TriMesh, steps: sp.csr_matrix, ends: tuple[int, int], near: int, reach: float) -> int:
    """The vertex at a place on the rim of an opening, or, for a place behind it, the nearest one on the rim.

    The way between the corners through a place behind the rim is much longer than one that goes by it.

    Parameters
    ----------
    steps : (V, V) graph of the steps allowed.
    ends : the corners. near : vertex at the place.
    reach : how far from it the way may go by.
    """
    away = np.linalg.norm(mesh.vertices - mesh.vertices[near], axis=1)
    total = dijkstra(steps, directed=False, indices=ends).sum(axis=0)
    least = total[away <= reach].min()
    if not np.isfinite(least) or total[near] <= BEHIND * least:
        return near
    total[away > reach] = np.inf
    as_short = np.flatnonzero(total <= (1 + _AS_SHORT) * least)
    return int(as_short[away[as_short].argmin()])


def guided_margin(mesh: TriMesh, steps: sp.csr_matrix, corners: IntArray, each: int) -> GuidedMargin | None:
    """The margin through vertices, with guides at equal shares of the way between them; None where there is no way.

    Parameters
    ----------
    steps : (V, V) graph of the steps allowed.
    corners : (P,) along the margin, from its one end to the other.
    each : guides from one of them to the next, which has the first of its own.
    """
    ways = [shortest_way(steps, int(a), int(b)) for a, b in pairwise(corners)]
    if not all(len(way) for way in ways):
        return None
    shares = [_shares(mesh.vertices[way]) for way in ways]
    # Along the whole margin: the number of the point behind, plus the share of the way to the next one.
    along = np.concatenate([share[bool(k) :] + k for k, share in enumerate(shares)])
    vertices = np.concatenate([way[bool(k) :] for k, way in enumerate(ways)])
    stations = np.arange(each * len(ways) + 1) / each
    guides = _interpolation(stations, along, len(vertices))
    to_mesh = sp.csr_matrix(
        (np.ones(len(vertices)), (np.arange(len(vertices)), vertices)), (len(vertices), len(mesh.vertices))
    )
    return GuidedMargin((guides @ to_mesh).tocsr(), vertices, _interpolation(along, stations, len(stations)))


def opposite(mesh: TriMesh, guides: FloatArray, margin: IntArray) -> sp.csr_matrix:
    """(G, V) places of a margin (n,) that lie as far along the line between the corners as guides (G, 3) do.

    guides : of the other margin, from corner to corner. What doubles back along the line is passed over.
    """
    line = guides[-1] - guides[0]
    length = max(float(line @ line), 1e-300)
    wanted, along = ((places - guides[0]) @ line / length for places in (guides, mesh.vertices[margin]))
    highest = np.maximum.accumulate(np.concatenate([[-np.inf], along[:-1]]))
    kept = np.flatnonzero((along > highest) & (along >= 0) & (along <= 1))
    kept = np.unique(np.concatenate([[0], kept[along[kept] < 1], [len(margin) - 1]]))
    along[0], along[-1] = 0.0, 1.0
    faced = _interpolation(np.clip(wanted, 0.0, 1.0), along[kept], len(kept))
    place = sp.csr_matrix((np.ones(len(kept)), (np.arange(len(kept)), margin[kept])), (len(kept), len(mesh.vertices)))
    return (faced @ place).tocsr()


def _shares(places: FloatArray) -> FloatArray:
    """Share of the way (n,) at each place (n, 3) of a chain; 0 to 1, evenly for places that coincide."""
    passed = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(places, axis=0), axis=1))])
    if passed[-1] <= 0:
        return np.linspace(0.0, 1.0, len(places))
    share: FloatArray = passed / passed[-1]
    return share


def _interpolation(wanted: FloatArray, known: FloatArray, count: int) -> sp.csr_matrix:
    """(W, count) weights that interpolate linearly from rising places (count,) to places (W,)."""
    after = np.clip(np.searchsorted(known, wanted), 1, max(count - 1, 1))
    if count == 1:
        return sp.csr_matrix(np.ones((len(wanted), 1)))
    gap = np.maximum(known[after] - known[after - 1], 1e-12)
    part = np.clip((wanted - known[after - 1]) / gap, 0.0, 1.0)
    rows = np.arange(len(wanted))
    entries = np.concatenate([1 - part, part]), (np.concatenate([rows, rows]), np.concatenate([after - 1, after]))
    return sp.csr_matrix(entries, shape=(len(wanted), count))


def has_points(points: FeaturePoints, names: Sequence[str]) -> bool:
    """Whether a face has all of these points."""
    return set(names) <= set(points.names)
