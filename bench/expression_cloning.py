"""The peer: expression cloning (Noh and Neumann 2001).

1. Radial basis functions h(d) = sqrt(d² + s_j²), s_j the distance from centre j to the nearest other one, warp the
   source onto the target's points; here on top of a similarity, so that size and
   place of the heads do not matter.
2. A cylindrical projection finds the place of the warped source before or behind every target vertex: the nearer of
   the two that faces the same way, so that what lies inside a head is not matched with its skin. A vertex that sees
   none takes the closest place of all that faces its way.
3. Lip contact: a vertex of one lip that landed on the other lip goes to the nearest place of its own.
4. A motion vector is turned by the local frames of the source and of the warped source (normal and a
   projected edge) and scaled along their axes by the ratio of the local bounding boxes, up to a limit.
5. Barycentric weights carry the vectors to the target's vertices.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse.csgraph import dijkstra
from scipy.spatial.distance import cdist

from facial_retarget_addon.core.arrays import FloatArray, IntArray, cross, unit_vectors
from facial_retarget_addon.core.closest_point import SurfaceFinder, closest_agreeing
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.mpeg4.head import head_axes
from facial_retarget_addon.core.points import FeaturePoints, place_matrix
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.core.steering.rbf import multiquadric

from .alignment import AGREEMENT, common_places, head_similarity

LIMIT = 1.2
"""Largest local scale, as a multiple of the heads' scale, and the inverse of the smallest.

The smaller, the less this peer errs on the real pair (0.39 at 3, 0.31 at 1.2); 1 would leave the boxes out.
"""
LIPS = (("8.1", "8.5", "8.6", "8.9", "8.10"), ("8.2", "8.7", "8.8"))
"""Points on the outer edges of the upper and of the lower lip: those on the inner edges may lie on either lip."""
CORNERS = ("8.3", "8.4")
REACH = 0.5
"""Vertices belong to a lip up to this many mouth widths from its outer edge, along the surface."""


class ExpressionCloning:
    """Fitted to a pair of faces."""

    def __init__(self, problem: Problem) -> None:
        """Warp, project, and work out how every motion vector turns and scales."""
        source, self._target = problem.source.mesh, problem.target.mesh.vertices
        self._source = source.vertices
        self._scale = head_similarity(problem).scale
        warped = source.with_vertices(warp(problem))
        face, weights = _project(problem, warped)
        align_lips(problem, warped, face, weights)
        self._carry = place_matrix(source.faces[face], weights, len(source.vertices))
        self._turn = _local_maps(source, warped, self._scale)

    def frames(self, source: FloatArray) -> FloatArray:
        """Target positions (F, Vt, 3) of source frames (F, Vs, 3)."""
        motion = np.einsum("vij,fvj->fvi", self._turn, source - self._source)
        moved: FloatArray = self._target + np.stack([self._carry @ one for one in motion])
        return moved


def warp(problem: Problem) -> FloatArray:
    """(Vs, 3) the source's vertices warped so that its points meet the target's."""
    places, images = common_places(problem)
    start = head_similarity(problem)
    apart = cdist(places, places)
    nearest = (apart + np.diag(np.full(len(places), np.inf))).min(axis=1)
    weights = np.linalg.solve(multiquadric(apart, nearest), images - start.apply(places))
    vertices = problem.source.mesh.vertices
    warped: FloatArray = start.apply(vertices) + multiquadric(cdist(vertices, places), nearest) @ weights
    return warped


def _project(problem: Problem, warped: TriMesh) -> tuple[IntArray, FloatArray]:
    """Face (Vt,) and weights (Vt, 3) of the nearest place along the line from the head's axis to each vertex."""
    points, vertices = problem.target.points, problem.target.mesh.vertices
    up = head_axes(points.names, points.positions(vertices))[1]
    out = vertices - vertices.mean(axis=0)
    out = unit_vectors(out - (out @ up)[:, None] * up)
    caster = problem.make_caster(warped)
    hits = [caster.nearest(vertices, side * out) for side in (1.0, -1.0)]
    face = np.stack([hit.face for hit in hits])
    agree = np.einsum("hvi,vi->hv", warped.face_normals[face], problem.target.mesh.vertex_normals) > AGREEMENT
    distance = np.where((face >= 0) & agree, [hit.distance for hit in hits], np.inf)
    every, nearer = np.arange(len(vertices)), distance.argmin(axis=0)
    found, weights = face[nearer, every], np.stack([hit.weights for hit in hits])[nearer, every]
    missed = np.isinf(distance.min(axis=0))
    if missed.any():
        normals = problem.target.mesh.vertex_normals[missed]
        closest = closest_agreeing(SurfaceFinder(warped), vertices[missed], normals, AGREEMENT)
        found[missed], weights[missed] = closest.face, closest.weights
    return found, weights


def align_lips(problem: Problem, warped: TriMesh, face: IntArray, weights: FloatArray) -> None:
    """Send vertices that landed on the wrong lip to the nearest place of their own, in place."""
    sides = [lip_of(one) for one in (problem.source, problem.target)]
    landed = sides[0][warped.faces[face, weights.argmax(axis=1)]]
    for lip in (1, -1):
        own = np.flatnonzero((sides[0][warped.faces] == lip).all(axis=1))
        wrong = np.flatnonzero((sides[1] == lip) & (landed == -lip))
        if len(own) and len(wrong):
            nearest = SurfaceFinder(warped, own).closest(problem.target.mesh.vertices[wrong])
            face[wrong], weights[wrong] = nearest.face, nearest.weights


def lip_of(face: Face) -> IntArray:
    """(V,) 1 on the upper lip, -1 on the lower one, 0 elsewhere and where the points do not say."""
    held = [[name for name in names if name in face.points.names] for names in LIPS]
    if not all(held) or not set(CORNERS) <= set(face.points.names):
        return np.zeros(len(face.mesh.vertices), np.int64)
    corners = face.points.subset(CORNERS).positions(face.mesh.vertices)
    reach = REACH * float(np.linalg.norm(corners[0] - corners[1]))
    upper, lower = (
        dijkstra(face.mesh.graph, indices=_nearest_corners(face.points.subset(names)), min_only=True, limit=reach)
        for names in held
    )
    lip: IntArray = np.where(upper < lower, 1, np.where(lower < upper, -1, 0))
    return lip


def _nearest_corners(points: FeaturePoints) -> IntArray:
    corners: IntArray = points.vertices[np.arange(len(points)), points.weights.argmax(axis=1)]
    return corners


def _local_maps(source: TriMesh, warped: TriMesh, scale: float) -> FloatArray:
    """(Vs, 3, 3) maps of motion vectors: into the source's frame, scaled, out of the warped source's frame."""
    i, j = np.concatenate([source.edges, source.edges[:, ::-1]]).T
    first = np.arange(len(source.vertices))
    first[i] = j
    before, after = (_local_frames(mesh, first) for mesh in (source, warped))
    boxes = [_boxes(mesh.vertices, frames, i, j) for mesh, frames in ((source, before), (warped, after))]
    flat = boxes[0] <= 1e-9 * source.size
    ratio = np.where(flat, scale, boxes[1] / np.where(flat, 1.0, boxes[0]))
    ratio = np.clip(ratio, scale / LIMIT, scale * LIMIT)
    maps: FloatArray = np.einsum("vki,vk,vkj->vij", after, ratio, before)
    return maps


def _local_frames(mesh: TriMesh, neighbour: IntArray) -> FloatArray:
    """(V, 3, 3) rows: an edge in the tangent plane, the normal's cross product with it, and the normal."""
    normal = mesh.vertex_normals
    edge = mesh.vertices[neighbour] - mesh.vertices
    tangent = unit_vectors(edge - np.einsum("vi,vi->v", edge, normal)[:, None] * normal)
    frames: FloatArray = np.stack([tangent, cross(normal, tangent), normal], axis=1)
    return frames


def _boxes(vertices: FloatArray, frames: FloatArray, i: IntArray, j: IntArray) -> FloatArray:
    """(V, 3) sides of the box around each vertex and its neighbours, along the axes of its frame."""
    along = np.einsum("eki,ei->ek", frames[i], vertices[j] - vertices[i])
    low, high = np.zeros((2, len(vertices), 3))
    np.minimum.at(low, i, along)
    np.maximum.at(high, i, along)
    sides: FloatArray = high - low
    return sides
