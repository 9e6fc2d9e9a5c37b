"""Which places of a map from surface to surface can be believed."""

from __future__ import annotations

import numpy as np
from scipy.sparse.csgraph import dijkstra

from .arrays import BoolArray, FloatArray, IntArray
from .mesh import TriMesh
from .surface_fill import HarmonicFill

_STRETCH = 2.0
_ROUNDS = 4


def torn_vertices(mesh: TriMesh, lengths: FloatArray, places: FloatArray) -> BoolArray:
    """(V,) true at the ends of edges that places (V, 3) stretch too far, and at the corners of faces that they flip.

    Parameters
    ----------
    mesh : the mesh, bent near to its places.
    lengths : (E,) what the edges should measure.
    """
    ends = mesh.edges
    stretched = np.linalg.norm(places[ends[:, 0]] - places[ends[:, 1]], axis=1) > _STRETCH * lengths
    flipped = np.einsum("fc,fc->f", mesh.with_vertices(places).face_vectors, mesh.face_vectors) < 0
    torn = np.zeros(len(mesh.vertices), bool)
    torn[ends[stretched].ravel()] = True
    torn[mesh.faces[flipped].ravel()] = True
    return torn


def believable(
    rest: TriMesh, bent: TriMesh, scale: float, places: FloatArray, sure: BoolArray, decay: FloatArray
) -> BoolArray:
    """(V,) the vertices among `sure` whose places leave the mesh whole once the others are filled from them.

    Parameters
    ----------
    rest, bent : the mesh as it was, and bent near to its places.
    scale : units of `bent` per unit of `rest`.
    places : (V, 3) the places, in the units of `bent`.
    decay : (V,) as for `HarmonicFill`, for the vertices that are not sure.
    """
    plain = scale * rest.edge_lengths
    lengths = np.maximum(np.clip(bent.edge_lengths, 0.5 * plain, 2 * plain), 1e-9 * bent.size)
    sure = sure.copy()
    here = places
    for _ in range(_ROUNDS):
        torn = torn_vertices(bent, lengths, here) & sure
        if not torn.any():
            break
        sure &= ~torn
        here = HarmonicFill(rest, sure, decay).values(places)
    return sure


def wrong_side(
    source: TriMesh,
    source_points: IntArray,
    target: TriMesh,
    target_points: IntArray,
    place_vertices: IntArray,
    extent: float,
) -> BoolArray:
    """(Vt,) true for target vertices that were placed on the other lip or lid.

    Each vertex belongs to the point that is nearest along its surface. Two points are opposite where they are near in
    space and far along the source's surface. A vertex is on the wrong side where its place lies well inside the
    region of a point opposite to its own.

    Parameters
    ----------
    source_points, target_points : (P,) vertices at the points.
    place_vertices : (Vt,) source vertex next to each target vertex's place.
    extent : size of the region that holds the points, in source units.
    """
    near = 0.5 * extent
    position = source.vertices[source_points]
    gap = np.linalg.norm(position[:, None] - position, axis=2)
    along = dijkstra(source.graph, indices=source_points, limit=3.03 * near)[:, source_points]
    opposite = (gap < near) & (along > 3 * gap) & (along > 0.15 * near)
    here = _nearest_point(target, target_points)
    there = _nearest_point(source, source_points)
    place_point = np.where(here >= 0, there[place_vertices], -1)
    suspect = (place_point >= 0) & opposite[here, place_point]
    wrong = np.zeros(len(target.vertices), bool)
    for point in np.unique(here[suspect]):
        allowed = np.flatnonzero((there >= 0) & ~opposite[point, there])
        depth = dijkstra(source.graph, indices=allowed, min_only=True, limit=0.12 * extent)
        mine = np.flatnonzero(suspect & (here == point))
        wrong[mine] = depth[place_vertices[mine]] > 0.06 * extent
    return wrong


def _nearest_point(mesh: TriMesh, points: IntArray) -> IntArray:
    """(V,) index of the point (P,) nearest along the surface, -1 where none can be reached."""
    distance, _, origin = dijkstra(mesh.graph, indices=points, min_only=True, return_predecessors=True)
    index = np.full(len(mesh.vertices), -1, np.int64)
    index[points] = np.arange(len(points))
    nearest: IntArray = np.where(np.isfinite(distance), index[np.where(np.isfinite(distance), origin, 0)], -1)
    return nearest
