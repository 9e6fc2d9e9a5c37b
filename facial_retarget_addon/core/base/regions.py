"""A base mesh for any feature points: the dual of their geodesic regions on the skin.

Real heads have pockets (mouth and eyes that go on into sockets) and are closed behind. The skin is therefore
cut first: what is seen from outside and what lies near a point.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import dijkstra

from ..arrays import BoolArray, FloatArray, IntArray
from ..closest_point import SurfaceFinder
from ..errors import RetargetError
from ..geodesic import distances_between, nearest_regions, shortcut_graph, surface_distances
from ..levels.subdivision import split_faces
from ..mesh import TriMesh
from ..points import FeaturePoints
from ..raycast import CasterFactory, EmbreeCaster, RayCaster
from .manifold_part import manifold_part

_REACH = 0.8
"""The base ends where the nearest point is farther away than this many eye separations."""
_DIRECTIONS = 64
_OPEN = 0.1
"""Skin is open where this share of all directions sees it."""
_RIM = 0.06
"""Pockets are followed inwards this many eye separations: lips and lids roll in."""
_DOUBLED = 0.9
"""A point in a pocket is left out if a point on the open skin is nearer than this many rims: a second ring of a lid."""
_DENSITY = 60
"""Vertices per point that a region needs to have a shape."""
_DETOUR = 2.0
"""A triangle whose edge is this many times longer along the skin bridges a pocket."""
_NEAR_SKIN = 0.15
"""A gap is closed where the new triangle stays this near to the skin, as a share of its longest edge."""


_SLIVER = 0.25
"""A gap is not closed by a triangle whose height is below this share of its longest edge."""


class _Skin(NamedTuple):
    mesh: TriMesh
    points: FeaturePoints
    chosen: IntArray
    graph: sp.csr_matrix
    kept: BoolArray
    between: FloatArray


def dual_triangulation(mesh: TriMesh, points: FeaturePoints, make_caster: CasterFactory = EmbreeCaster) -> IntArray:
    """Triangulation of feature points whose edges join neighbouring regions of the skin.

    Returns
    -------
    (F, 3) rows of `points`, oriented like the mesh, manifold and in one piece. Points that lie deep in a
    pocket or out of reach are in no triangle.

    Raises
    ------
    RetargetError : if the points' regions do not meet.

    References
    ----------
    Kshirsagar et al. (regions of feature points).
    """
    skin = _cut_skin(*_refined(mesh, points), make_caster)
    seeds = skin.points.subset([points.names[k] for k in skin.chosen])
    label = nearest_regions(skin.mesh, seeds, np.inf, skin.graph).label
    of_face = np.where(skin.kept & (label >= 0), skin.chosen[label], -1)[skin.mesh.faces]
    three = (of_face != np.roll(of_face, 1, axis=1)).all(axis=1)
    triangles = _net_triangles(of_face[three & (of_face >= 0).all(axis=1)])
    if not len(triangles):
        raise RetargetError(
            f"the regions of the {len(points)} feature points do not meet on the surface, "
            f"expected points spread over the face: move {', '.join(points.names[:4])}"
        )
    places = points.positions(mesh.vertices)
    detour = _detour(triangles, places, skin.between)
    triangles, detour = triangles[detour < _DETOUR], detour[detour < _DETOUR]
    triangles = manifold_part(triangles, detour, len(points))
    return _close_gaps(triangles, places, skin)


def _net_triangles(corners: IntArray) -> IntArray:
    """Each triple of regions once, the way round in which it is met more often; dropped where both are as many.

    Two regions whose common border is broken meet a third one several times, both ways round.
    """
    turned = np.take_along_axis(corners, (corners.argmin(axis=1)[:, None] + np.arange(3)) % 3, axis=1)
    forward = turned[:, 1] < turned[:, 2]
    triple, index = np.unique(np.sort(corners, axis=1), axis=0, return_inverse=True)
    net = np.bincount(index.ravel(), np.where(forward, 1, -1), len(triple))
    triangles: IntArray = np.where(net[:, None] > 0, triple, triple[:, [0, 2, 1]])[net != 0]
    return triangles


def _refined(mesh: TriMesh, points: FeaturePoints) -> tuple[TriMesh, FeaturePoints]:
    """The same surface with enough vertices around each point."""
    reach = _REACH * eye_separation(mesh, points)
    while np.isfinite(nearest_regions(mesh, points, reach).distance).sum() < _DENSITY * len(points):
        mesh, points = _split(mesh, points)
    return mesh, points


def eye_separation(mesh: TriMesh, points: FeaturePoints) -> float:
    """Distance of the eyes' middles.

    Without the eyes' corners: 1.2 times the points' median distance to their middle.
    """
    row = {name: k for k, name in enumerate(points.names)}
    places = points.positions(mesh.vertices)
    corners = [row.get(name, -1) for name in ("3.7", "3.11", "3.8", "3.12")]
    if min(corners) >= 0:
        return float(np.linalg.norm(places[corners[:2]].mean(axis=0) - places[corners[2:]].mean(axis=0)))
    return 1.2 * float(np.median(np.linalg.norm(places - places.mean(axis=0), axis=1)))


def _split(mesh: TriMesh, points: FeaturePoints) -> tuple[TriMesh, FeaturePoints]:
    """Every triangle cut into four, flat; every point put on the small triangle that holds it."""
    count = len(mesh.vertices)
    middles = mesh.vertices[mesh.edges].mean(axis=1)
    fine = TriMesh(np.concatenate([mesh.vertices, middles]), split_faces(mesh.faces, mesh.face_edges, count))
    key = mesh.edges[:, 0] * count + mesh.edges[:, 1]
    corners = points.vertices
    after = np.roll(corners, -1, axis=1)
    wanted = np.minimum(corners, after) * count + np.maximum(corners, after)
    row = np.minimum(np.searchsorted(key, wanted), len(key) - 1)
    middle = np.where(key[row] == wanted, row + count, corners)
    # Middle k lies on the edge from corner k to k + 1; a place is the sum over its small triangle's corners.
    weights = points.weights
    heavy = weights.max(axis=1) > 0.5
    big = weights.argmax(axis=1)
    line = np.arange(len(points))
    around = (big + 2) % 3
    outer = np.stack([corners[line, big], middle[line, big], middle[line, around]], axis=1)
    outer_weights = np.stack(
        [2 * weights[line, big] - 1, 2 * weights[line, (big + 1) % 3], 2 * weights[line, around]], axis=1
    )
    inner_weights = 1 - 2 * np.roll(weights, -2, axis=1)
    chosen = np.where(heavy[:, None], outer, middle)
    return fine, FeaturePoints(points.names, chosen, np.where(heavy[:, None], outer_weights, inner_weights))


def _cut_skin(mesh: TriMesh, points: FeaturePoints, make_caster: CasterFactory) -> _Skin:
    """The skin that the base may cover: in reach of a point, and open or a rim of a pocket."""
    separation = eye_separation(mesh, points)
    reach = _REACH * separation
    graph = shortcut_graph(mesh)
    near = nearest_regions(mesh, points, reach, graph)
    seen = _openness(mesh, near.label >= 0, make_caster(mesh)) >= _OPEN
    if not seen.any():
        raise RetargetError(
            f"no skin around the {len(points)} feature points is seen from outside, "
            "expected a surface whose normals point outwards"
        )
    depth = dijkstra(graph, directed=False, indices=np.flatnonzero(seen), min_only=True, limit=reach)
    from_points = surface_distances(mesh, points, 2.5 * reach, graph)
    between = distances_between(from_points, mesh, points)
    # Low-poly lips: the skin around a point counts even where the rim is narrower than a triangle.
    spacing = between.min(axis=1)
    spacing[~np.isfinite(spacing)] = 0.0
    kept = (near.label >= 0) & ((depth <= _RIM * separation) | (near.distance <= 0.5 * spacing[near.label]))
    kept &= np.isfinite(depth)
    point_depth = np.asarray(points.matrix(len(mesh.vertices)) @ np.where(np.isfinite(depth), depth, reach))
    behind = _behind_others(point_depth, between, _RIM * separation)
    kept &= seen | ~np.isin(near.label, behind)
    inside = sp.diags(kept.astype(float))
    cut = (inside @ graph @ inside).tocsr()
    cut.eliminate_zeros()
    return _Skin(mesh, points, np.setdiff1d(np.arange(len(points)), behind), cut, kept, between)


def _behind_others(depth: FloatArray, between: FloatArray, rim: float) -> IntArray:
    """Points in a pocket with another point between them and the open skin."""
    nearest = between.argmin(axis=1)
    gap = between[np.arange(len(depth)), nearest]
    deep: BoolArray = (depth > rim) & (depth[nearest] < depth) & (gap < depth)
    to_open = between[:, depth <= 0].min(axis=1, initial=np.inf)
    doubled: BoolArray = (depth > 0) & (to_open < _DOUBLED * rim)
    return np.flatnonzero(deep | doubled)


def _openness(mesh: TriMesh, wanted: BoolArray, caster: RayCaster) -> FloatArray:
    """(V,) share of all directions in which nothing hides a vertex; 0 where it is not wanted."""
    k = np.arange(_DIRECTIONS) + 0.5
    height, turn = 1 - 2 * k / _DIRECTIONS, np.pi * (1 + np.sqrt(5)) * k
    radius = np.sqrt(1 - height**2)
    directions = np.stack([radius * np.cos(turn), radius * np.sin(turn), height], axis=1)
    chosen = np.flatnonzero(wanted)
    normals = mesh.vertex_normals[chosen]
    row, column = np.nonzero(normals @ directions.T > 0)
    start = mesh.vertices[chosen] + 1e-4 * mesh.size * normals
    free = ~caster.nearest(start[row], directions[column]).found
    share = np.zeros(len(mesh.vertices))
    share[chosen] = np.bincount(row[free], minlength=len(chosen)) / _DIRECTIONS
    return share


def _detour(triangles: IntArray, places: FloatArray, between: FloatArray) -> FloatArray:
    """(F,) the greatest ratio of surface distance to straight distance among each triangle's edges."""
    a, b = triangles, np.roll(triangles, -1, axis=1)
    straight = np.maximum(np.linalg.norm(places[a] - places[b], axis=2), 1e-300)
    ratio: FloatArray = (between[a, b] / straight).max(axis=1)
    return ratio


def _close_gaps(triangles: IntArray, places: FloatArray, skin: _Skin) -> IntArray:
    """Triangles added at notches of the boundary where they lie on the skin."""
    faces = skin.mesh.faces[skin.kept[skin.mesh.faces].all(axis=1)]
    finder = SurfaceFinder(TriMesh(skin.mesh.vertices, faces))
    refused: set[tuple[int, ...]] = set()
    while True:
        added = _next_gap(triangles, places, skin.between, finder, refused)
        if added is None:
            return triangles
        triangles = np.concatenate([triangles, added[None]])


def _next_gap(
    triangles: IntArray,
    places: FloatArray,
    between: FloatArray,
    finder: SurfaceFinder,
    refused: set[tuple[int, ...]],
) -> IntArray | None:
    """The smallest triangle over two neighbouring boundary edges that lies on the skin."""
    mesh = TriMesh(places, triangles)
    taken = set(map(tuple, mesh.edges.tolist()))
    candidates = []
    for ring in mesh.boundary_loops:
        if len(set(ring.tolist())) < len(ring):
            continue
        for a, b, c in zip(ring, np.roll(ring, -1), np.roll(ring, -2), strict=True):
            closes = len(ring) == 3
            if not closes and (min(a, c), max(a, c)) in taken:
                continue
            corners = np.array([c, b, a])
            if tuple(sorted(corners.tolist())) not in refused:
                candidates.append(corners)
    if not candidates:
        return None
    corners = np.array(candidates)
    longest = np.linalg.norm(places[corners] - places[np.roll(corners, -1, axis=1)], axis=2).max(axis=1)
    for k in np.argsort(longest):
        direct = _detour(corners[k : k + 1], places, between)[0] < _DETOUR
        if direct and _on_skin(places[corners[k]], longest[k], finder):
            return np.asarray(corners[k])
        refused.add(tuple(sorted(corners[k].tolist())))
    return None


def _on_skin(corners: FloatArray, longest: float, finder: SurfaceFinder) -> bool:
    """Whether a triangle's middle and its edges' middles are near to skin that faces the same way."""
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    length = float(np.linalg.norm(normal))
    if length < _SLIVER * longest**2:
        return False
    samples = np.concatenate([corners.mean(axis=0)[None], (corners + np.roll(corners, -1, axis=0)) / 2])
    near = finder.closest(samples, np.broadcast_to(normal / length, samples.shape), 0.2, _NEAR_SKIN * longest)
    return bool((near.face >= 0).all())
