"""Where each vertex of the target lies on the source, from feature points on both."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from .arrays import BoolArray, FloatArray, IntArray, Progress, no_progress
from .closest_point import SurfaceFinder
from .errors import RetargetError
from .map_repair import believable, wrong_side
from .mesh import TriMesh
from .points import FeaturePoints, common_names, place_matrix
from .rigid import fit_similarity
from .smooth_warp import fit_smooth_warp
from .surface_fill import HarmonicFill
from .surface_fit import fit_surface

_AGREEMENT = 0.2
_REACH = 0.3
_STIFFNESS = 0.01
_DECAY = 0.3
"""How far motion reaches past the source's surface, in extents of the points."""


@dataclass(frozen=True, eq=False)
class Correspondence:
    """A place on the source for each target vertex.

    Attributes
    ----------
    face : (N,) source face of each target vertex; -1 on components without feature points.
    weights : (N, 3) barycentric weights of its corners.
    confidence : (N,) from 0 to 1; where it is 0 the place is a guess, and `matrix` takes the motion from neighbours.
    warped : (N, 3) target vertices bent onto the source, in source units.
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

        Rows add up to 1, to 0 for vertices that do not move, and to less than 1 where the motion fades because the
        source has no surface there.
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

    The target is moved by a similarity, warped smoothly through the points and bent onto the source; then each vertex
    takes the closest place where the normals agree. Places that would tear or fold the target, that lie on the other
    lip or lid, or past the source's border, are not believed.

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
    here = target_points.positions(target.vertices)
    extent = float(np.linalg.norm(there - there.mean(axis=0), axis=1).max())
    progress(0.0, "warping the target onto the source")
    similarity = fit_similarity(here, there)
    warp = fit_smooth_warp(similarity.apply(here), there, _STIFFNESS)
    warped = target.with_vertices(warp.apply(similarity.apply(target.vertices)))
    finder = SurfaceFinder(source, np.flatnonzero(source_face[source.faces[:, 0]]))
    active = np.flatnonzero(target_face)
    progress(0.1, "bending the target onto the source")
    held = target_points.matrix(len(target.vertices))
    bent = target.with_vertices(fit_surface(warped, active, held, there, finder, extent))
    progress(0.6, "finding the places of the target's vertices on the source")
    found = finder.closest(bent.vertices[active], bent.vertex_normals[active], _AGREEMENT, _REACH * extent)
    lost = found.face < 0
    guess = finder.closest(bent.vertices[active[lost]])
    face = np.full(len(target.vertices), -1, np.int64)
    weights = np.zeros((len(target.vertices), 3))
    distance = np.full(len(target.vertices), np.inf)
    face[active], weights[active], distance[active] = found.face, found.weights, found.distance
    face[active[lost]], weights[active[lost]], distance[active[lost]] = guess.face, guess.weights, guess.distance
    sure = target_face.copy()
    sure[active[lost]] = False
    progress(0.8, "mending the map")
    past_border = _on_border(source, face, weights) & (distance > 0.05 * extent)
    decay = np.where(past_border | (distance > _REACH * extent), 1.0, 0.0)
    decay *= target.vertex_edge_length / (_DECAY * extent / similarity.scale) ** 2
    place_vertices = source.faces[face, weights.argmax(axis=1)]
    sure &= ~past_border & ~wrong_side(
        source, _vertices(source_points), target, _vertices(target_points), place_vertices, extent
    )
    places = np.einsum("nk,nkc->nc", weights, source.vertices[source.faces[face]])
    sure = believable(target, bent, similarity.scale, places, sure | ~target_face, decay) & target_face
    fill = HarmonicFill(target, sure, decay).matrix()
    confidence = np.where(sure, 1 / (1 + (distance / (0.1 * extent)) ** 2), 0.0)
    labels = target.components
    still = tuple(np.flatnonzero(labels == k) for k in np.unique(labels[~target_face]))
    return Correspondence(face, weights, confidence, bent.vertices, still, fill)


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
    component = source.components[source.faces[correspondence.face.max(), 0]]
    finder = SurfaceFinder(source, np.flatnonzero(source.components[source.faces[:, 0]] == component))
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


def _vertices(points: FeaturePoints) -> IntArray:
    """(P,) the vertex nearest to each point."""
    vertices: IntArray = points.vertices[np.arange(len(points)), points.weights.argmax(axis=1)]
    return vertices


def _on_border(mesh: TriMesh, face: IntArray, weights: FloatArray) -> BoolArray:
    """(N,) true for places on a boundary edge of the mesh."""
    open_edge = mesh.edge_face_count[mesh.face_edges] == 1
    # Edge k of a face lies opposite to its corner k + 2.
    border: BoolArray = (open_edge[face] & (weights[:, [2, 0, 1]] <= 1e-9)).any(axis=1) & (face >= 0)
    return border
