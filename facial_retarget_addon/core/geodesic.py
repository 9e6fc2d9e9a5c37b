"""Surface distance along edges, from places anywhere on a mesh."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import dijkstra

from .arrays import FloatArray, IntArray
from .mesh import TriMesh
from .points import FeaturePoints


class Regions(NamedTuple):
    """Nearest place of each vertex: label (V,), -1 where none is near enough; distance (V,), inf there."""

    label: IntArray
    distance: FloatArray


def surface_distances(
    mesh: TriMesh, points: FeaturePoints, limit: float = np.inf, graph: sp.csr_matrix | None = None
) -> FloatArray:
    """Shortest edge path from each place to each vertex.

    The first piece leads straight from the place to the corners that hold it. Edge paths are some 7 %
    longer than exact geodesics; Kshirsagar et al. define their distance this way.

    Parameters
    ----------
    mesh : V vertices.
    points : K places.
    limit : where to stop; a limit makes this several times faster.
    graph : (V, V) lengths of the steps allowed; the mesh's edges if none is given.

    Returns
    -------
    (K, V) distances in the mesh's units, inf beyond the limit and on other components.
    """
    steps, sources = _graph_with_places(mesh, points, graph)
    distances: FloatArray = dijkstra(steps, directed=True, indices=sources, limit=limit)[:, : len(mesh.vertices)]
    return distances


def distances_between(from_places: FloatArray, mesh: TriMesh, points: FeaturePoints) -> FloatArray:
    """Surface distance (K, K) between places, out of their `surface_distances`; inf from a place to itself."""
    row, column = np.nonzero(points.weights > 0)
    corner = points.vertices[row, column]
    gap = np.linalg.norm(mesh.vertices[corner] - points.positions(mesh.vertices)[row], axis=1)
    between = np.full((len(points), len(points)), np.inf)
    np.minimum.at(between.T, row, (from_places[:, corner] + gap).T)
    between = np.minimum(between, between.T)
    np.fill_diagonal(between, np.inf)
    return between


def nearest_regions(
    mesh: TriMesh, points: FeaturePoints, limit: float = np.inf, graph: sp.csr_matrix | None = None
) -> Regions:
    """The region of each place: the vertices that lie nearest to it along the surface, in one pass."""
    steps, sources = _graph_with_places(mesh, points, graph)
    distance, _, source = dijkstra(
        steps, directed=True, indices=sources, limit=limit, min_only=True, return_predecessors=True
    )
    count = len(mesh.vertices)
    found = np.isfinite(distance[:count])
    return Regions(np.where(found, source[:count] - count, -1).astype(np.int64), distance[:count])


def shortcut_graph(mesh: TriMesh) -> sp.csr_matrix:
    """(V, V) lengths of the edges, and of the straight steps across them from corner to opposite corner.

    Paths on it are several times nearer to exact geodesics than edge paths, so that regions get smooth borders.
    """
    inner = np.flatnonzero(mesh.edge_face_count == 2)
    order = np.argsort(mesh.face_edges.ravel(), kind="stable")
    opposite = mesh.faces[:, [2, 0, 1]].ravel()[order]
    first = np.concatenate([[0], np.cumsum(mesh.edge_face_count)[:-1]])[inner].astype(np.int64)
    c, d = opposite[first], opposite[first + 1]
    origin = mesh.vertices[mesh.edges[inner, 0]]
    length = np.maximum(mesh.edge_lengths[inner], 1e-300)
    along = (mesh.vertices[mesh.edges[inner, 1]] - origin) / length[:, None]
    (c_along, c_away), (d_along, d_away) = (_unfold(mesh.vertices[v] - origin, along) for v in (c, d))
    across = c_along + (d_along - c_along) * c_away / np.maximum(c_away + d_away, 1e-300)
    straight = np.hypot(c_along - d_along, c_away + d_away)
    free = (across > 0) & (across < length) & (straight > 0)
    low, high = np.minimum(c, d)[free], np.maximum(c, d)[free]
    key = np.concatenate([mesh.edges @ np.array([len(mesh.vertices), 1]), low * len(mesh.vertices) + high])
    steps = np.concatenate([np.maximum(mesh.edge_lengths, 1e-12 * max(mesh.size, 1e-300)), straight[free]])
    order = np.lexsort((steps, key))
    unique, start = np.unique(key[order], return_index=True)
    i, j = unique // len(mesh.vertices), unique % len(mesh.vertices)
    half = sp.coo_matrix((steps[order][start], (i, j)), shape=(len(mesh.vertices),) * 2)
    return (half + half.T).tocsr()


def _unfold(offsets: FloatArray, along: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Coordinates along an edge and away from it, of offsets from its first vertex."""
    forward = np.einsum("ij,ij->i", offsets, along)
    return forward, np.sqrt(np.maximum(np.einsum("ij,ij->i", offsets, offsets) - forward**2, 0.0))


def _graph_with_places(
    mesh: TriMesh, points: FeaturePoints, graph: sp.csr_matrix | None
) -> tuple[sp.csr_matrix, IntArray]:
    """The steps allowed with one more node per place, from which edges lead to the corners that hold it."""
    count, places = len(mesh.vertices), len(points)
    row, column = np.nonzero(points.weights > 0)
    corner = points.vertices[row, column]
    gap = np.linalg.norm(mesh.vertices[corner] - points.positions(mesh.vertices)[row], axis=1)
    key, first = np.unique(row * count + corner, return_index=True)
    length = np.maximum(gap[first], 1e-12 * max(mesh.size, 1e-300))
    links = sp.csr_matrix((length, (key // count, key % count)), shape=(places, count))
    among = mesh.graph if graph is None else graph
    steps = sp.bmat([[among, None], [links, sp.csr_matrix((places, places))]], format="csr")
    return steps, np.arange(count, count + places)
