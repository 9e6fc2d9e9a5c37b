"""Where each vertex of the target lies on the source, from feature points on both."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from .arrays import BoolArray, FloatArray, IntArray, Progress, no_progress
from .closest_point import SurfaceFinder
from .errors import RetargetError
from .mesh import TriMesh
from .points import FeaturePoints, common_names, place_matrix
from .rigid import fit_similarity
from .smooth_warp import fit_smooth_warp
from .surface_fill import harmonic_fill


@dataclass(frozen=True, eq=False)
class Correspondence:
    """A place on the source for each target vertex.

    Attributes
    ----------
    face : (N,) source face of each target vertex; -1 where a component of the target has no counterpart.
    weights : (N, 3) barycentric weights of its corners.
    confidence : (N,) from 0 to 1; where it is 0 the place is a guess, and `matrix` takes the motion from neighbours.
    warped : (N, 3) target vertices moved onto the source, in source units.
    still_components : vertices of each target component that holds no feature point: they do not move.
    fill : (N, N) takes values at confident vertices to all vertices.
    """

    face: IntArray
    weights: FloatArray
    confidence: FloatArray
    warped: FloatArray
    still_components: tuple[IntArray, ...]
    fill: sp.csr_matrix

    def matrix(self, source_faces: IntArray, source_vertex_count: int) -> sp.csr_matrix:
        """(N, source_vertex_count) matrix that carries values of source vertices, such as displacements, to the target.

        Rows add up to 1, and to 0 for vertices that do not move.
        """
        placed = place_matrix(source_faces[self.face], self.weights, source_vertex_count)
        return (self.fill @ placed).tocsr()


def correspond(
    source: TriMesh,
    source_points: FeaturePoints,
    target: TriMesh,
    target_points: FeaturePoints,
    progress: Progress = no_progress,
) -> Correspondence:
    """Find the place on the source of each target vertex.

    Parameters
    ----------
    source, target : neutral faces, each in its own units, place and orientation.
    source_points, target_points : feature points; names that only one face has are left aside.

    Raises
    ------
    RetargetError : for fewer than 4 common points, for points in one plane, on one line or in one place, and for
        points of one face on different components.
    """
    names = common_names(source_points, target_points)
    if len(names) < 4:
        raise RetargetError(
            f"the faces have {len(names)} feature points in common, expected at least 4 that are not in one plane"
        )
    source_points, target_points = source_points.subset(names), target_points.subset(names)
    source_face = _face_component(source, source_points, "source")
    target_face = _face_component(target, target_points, "target")
    there = source_points.positions(source.vertices)
    progress(0.0, "warping the target onto the source")
    here = target_points.positions(target.vertices)
    similarity = fit_similarity(here, there)
    warp = fit_smooth_warp(similarity.apply(here), there)
    warped = warp.apply(similarity.apply(target.vertices))
    progress(0.3, "finding the places of the target's vertices on the source")
    finder = SurfaceFinder(source, np.flatnonzero(source_face[source.faces[:, 0]]))
    active = np.flatnonzero(target_face)
    normals = target.with_vertices(warped).vertex_normals
    found = finder.closest(warped[active], normals[active], _AGREEMENT)
    lost = np.flatnonzero(found.face < 0)
    guess = finder.closest(warped[active[lost]])
    face = np.full(len(target.vertices), -1, np.int64)
    weights = np.zeros((len(target.vertices), 3))
    face[active], weights[active] = found.face, found.weights
    face[active[lost]], weights[active[lost]] = guess.face, guess.weights
    confidence = np.zeros(len(target.vertices))
    confidence[active] = found.face >= 0
    labels = target.components
    still = tuple(np.flatnonzero(labels == k) for k in np.unique(labels[~target_face]))
    return Correspondence(face, weights, confidence, warped, still, harmonic_fill(target, confidence > 0, target_face))


_AGREEMENT = 0.2


def places_on_source(
    correspondence: Correspondence,
    source: TriMesh,
    target: TriMesh,
    corners: IntArray,
    weights: FloatArray,
) -> tuple[IntArray, FloatArray]:
    """Source places of any places on the target's surface.

    Parameters
    ----------
    corners : (M, 3) target vertices that hold each place, of components with feature points.
    weights : (M, 3) their weights.

    Returns
    -------
    (M, 3) source vertices, (M, 3) weights.
    """
    position = np.einsum("mk,mkc->mc", weights, correspondence.warped[corners])
    normals = target.with_vertices(correspondence.warped).vertex_normals
    normal = np.einsum("mk,mkc->mc", weights, normals[corners])
    finder = SurfaceFinder(source, np.unique(correspondence.face[correspondence.face >= 0]))
    found = finder.closest(position, normal, 0.0)
    guess = finder.closest(position)
    face = np.where(found.face >= 0, found.face, guess.face)
    return source.faces[face], np.where((found.face >= 0)[:, None], found.weights, guess.weights)


def predict_points(
    template: TriMesh, template_points: FeaturePoints, mesh: TriMesh, known_points: FeaturePoints
) -> FeaturePoints:
    """The known points of a face, and a proposal for each point that only the template has.

    Parameters
    ----------
    template, template_points : a face with all points.
    mesh, known_points : the face to complete; at least 4 of its points are the template's.

    Raises
    ------
    RetargetError : as `correspond`.
    """
    missing = [name for name in template_points.names if name not in set(known_points.names)]
    if not missing:
        return known_points
    wanted = template_points.subset(missing)
    correspondence = correspond(mesh, known_points, template, template_points)
    vertices, weights = places_on_source(correspondence, mesh, template, wanted.vertices, wanted.weights)
    return known_points.joined(FeaturePoints(tuple(missing), vertices, weights))


def _face_component(mesh: TriMesh, points: FeaturePoints, what: str) -> BoolArray:
    """(V,) true for the vertices of the component that holds the points."""
    label = mesh.components[points.vertices[:, 0]]
    face = np.bincount(label).argmax()
    off = [name for name, here in zip(points.names, label == face, strict=True) if not here]
    if off:
        raise RetargetError(
            f"{what}: feature points {', '.join(map(repr, off))} lie on another component than the other "
            f"{len(points) - len(off)}, expected all of them on the face's surface"
        )
    mask: BoolArray = mesh.components == face
    return mask
