"""More base points between the given ones, matched through the correspondence."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..closest_point import SurfaceFinder
from ..matching.correspondence import Correspondence, places_on_source
from ..mesh import TriMesh
from ..points import FeaturePoints
from .base_mesh import BaseMesh
from .insertion import insert_points
from .placed_points import PlacedPoints


class _Rule(NamedTuple):
    """When a vertex counts as inside the base.

    Attributes
    ----------
    agreement : least dot product of its normal and the base's.
    reach : greatest distance from the base, in its mean edges.
    depth : least weight at the far corner of a border edge.
    """

    agreement: float
    reach: float
    depth: float


_INSIDE = _Rule(agreement=0.3, reach=1.0, depth=0.08)
_FIT_FOR_A_POINT = _Rule(agreement=0.8, reach=0.35, depth=0.1)
"""A new point is stricter: in a nostril or an ear it would fold the base, and piercing would fail around it."""


def refine_base(
    base: BaseMesh,
    source: TriMesh,
    source_points: FeaturePoints,
    target: TriMesh,
    target_points: FeaturePoints,
    correspondence: Correspondence,
    wanted: int,
) -> tuple[BaseMesh, FeaturePoints, FeaturePoints]:
    """A base of `wanted` points, and its points on both faces in the base's order.

    The new points are the target's vertices inside the base that lie farthest from all points, one
    after the other; the correspondence says where they are on the source. Boundary loops stay as
    they are.
    """
    on_source, on_target = source_points.subset(base.names), target_points.subset(base.names)
    spread = _farthest_vertices(base, target, on_target, correspondence, wanted - len(base.names))
    if not len(spread):
        return base, on_source, on_target
    names = tuple(f"between_{k + 1}" for k in range(len(spread)))
    corners = np.repeat(spread[:, None], 3, axis=1)
    weights = np.tile([1.0, 0.0, 0.0], (len(spread), 1))
    matched = places_on_source(correspondence, source, target, corners, weights)
    on_source = on_source.joined(FeaturePoints(names, *matched))
    on_target = on_target.joined(FeaturePoints(names, corners, weights))
    placed = [PlacedPoints.on(source, on_source), PlacedPoints.on(target, on_target)]
    rows = np.arange(len(base.names), len(on_source))
    faces = insert_points(base.faces, rows, placed)
    kept = np.unique(faces)
    chosen = [on_source.names[k] for k in kept]
    refined = replace(base, names=tuple(chosen), faces=np.searchsorted(kept, faces))
    return refined, on_source.subset(chosen), on_target.subset(chosen)


def _farthest_vertices(
    base: BaseMesh, target: TriMesh, points: FeaturePoints, correspondence: Correspondence, count: int
) -> IntArray:
    """Up to `count` target vertices inside the base, each the farthest from all points before it."""
    inside = np.flatnonzero(inside_base(base, target, points, _FIT_FOR_A_POINT) & (correspondence.confidence > 0.5))
    return farthest_vertices(target.vertices, inside, points.positions(target.vertices), count)


def farthest_vertices(vertices: FloatArray, candidates: IntArray, taken: FloatArray, count: int) -> IntArray:
    """Up to `count` of the candidates, each the farthest from all places that are taken and from all before it.

    Parameters
    ----------
    vertices : (V, 3). candidates : (n,) some of them. taken : (m, 3) places, at least one.
    """
    if count <= 0 or not len(candidates):
        return np.empty(0, np.int64)
    places = vertices[candidates]
    gap = np.full(len(candidates), np.inf)
    for position in taken:
        np.minimum(gap, _squared(places - position), out=gap)
    chosen: list[int] = []
    for _ in range(min(count, len(candidates))):
        best = int(np.argmax(gap))
        chosen.append(int(candidates[best]))
        np.minimum(gap, _squared(places - places[best]), out=gap)
    return np.array(chosen, np.int64)


def _squared(vectors: FloatArray) -> FloatArray:
    squared: FloatArray = np.einsum("ij,ij->i", vectors, vectors)
    return squared


def inside_base(base: BaseMesh, mesh: TriMesh, points: FeaturePoints, rule: _Rule = _INSIDE) -> BoolArray:
    """(V,) true for vertices of a face that lie inside its base mesh.

    points : the base's points on this face, in the base's order.
    """
    flat = TriMesh(points.positions(mesh.vertices), base.faces)
    reach = rule.reach * flat.edge_lengths.mean()
    near = SurfaceFinder(flat).closest(mesh.vertices, mesh.vertex_normals, rule.agreement, reach)
    on_border = (flat.edge_face_count == 1)[flat.face_edges[near.face]]
    # Edge k of a face lies opposite corner k + 2.
    far_weights = near.weights[:, [2, 0, 1]]
    inside: BoolArray = (near.face >= 0) & ~(on_border & (far_weights < rule.depth)).any(axis=1)
    return inside
