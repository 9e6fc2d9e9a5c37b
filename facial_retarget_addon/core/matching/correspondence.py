"""Where each vertex of the target lies on the source, from feature points on both."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.spatial.distance import cdist

from ..arrays import BoolArray, FloatArray, IntArray, Progress, no_progress, unit_vectors
from ..closest_point import Nearest, SurfaceFinder, closest_agreeing
from ..errors import RetargetError
from ..mesh import TriMesh
from ..points import FeaturePoints, common_names, place_matrix
from ..rigid import fit_similarity
from .map_repair import believable
from .sides import Sides
from .smooth_warp import fit_smooth_warp
from .surface_fill import HarmonicFill
from .surface_fit import fit_surface

_AGREEMENT = 0.2
_REACH = 0.3
_STIFFNESS = 0.01
_LEAN = 1e-6
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
    lip or lid, past the source's border, or at an edge that would lie across an opening of the source, are not
    believed.

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
    for what, points, mesh in (("source", source_points, source), ("target", target_points, target)):
        _refuse_twins(points, len(mesh.vertices), what)
    there = source_points.positions(source.vertices)
    here = target_points.positions(target.vertices)
    extent = float(np.linalg.norm(there - there.mean(axis=0), axis=1).max())
    finder = SurfaceFinder(source, np.flatnonzero(source_face[source.faces[:, 0]]))
    active = np.flatnonzero(target_face)
    progress(0.0, "warping the target onto the source")
    similarity = fit_similarity(here, there)
    warp = fit_smooth_warp(similarity.apply(here), there, _STIFFNESS)
    warped = target.with_vertices(warp.apply(similarity.apply(target.vertices)))
    lean = _lean(warped.vertices, there)
    progress(0.1, "bending the target onto the source")
    held = target_points.matrix(len(target.vertices))
    bent = target.with_vertices(fit_surface(warped, active, held, there, finder, extent, lean))
    progress(0.6, "finding the places of the target's vertices on the source")
    found, agrees = _places(finder, bent, active, extent, lean)
    progress(0.8, "mending the map")
    sides = Sides(source, source_points.holders, target, target_points.holders, extent)
    crossed = _to_own_side(sides, source, bent, found, extent)
    own = target_face[target.edges].all(axis=1)
    next_to = source.faces[found.face, found.weights.argmax(axis=1)]
    bridged = sides.bridged(target.edges[own], next_to, similarity.scale * target.edge_lengths[own])
    past_border = _on_border(source, found) & (found.distance > 0.05 * extent)
    far = past_border | (found.distance > _REACH * extent)
    decay = np.where(far, target.vertex_edge_length / (_DECAY * extent / similarity.scale) ** 2, 0.0)
    sure = (agrees & ~past_border & ~crossed & ~bridged) | ~target_face
    sure = believable(target, bent, similarity.scale, found.point, sure) & target_face
    confidence = np.where(sure, 1 / (1 + (found.distance / (0.1 * extent)) ** 2), 0.0)
    labels = target.components
    still = tuple(np.flatnonzero(labels == k) for k in np.unique(labels[~target_face]))
    fill = HarmonicFill(target, sure, decay).matrix()
    return Correspondence(found.face, found.weights, confidence, bent.vertices, still, fill)


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
    found = closest_agreeing(finder, position, normal, 0.0)
    return source.faces[found.face], found.weights


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


def _lean(places: FloatArray, points: FloatArray) -> FloatArray:
    """(V, 3) next to nothing, by which places lean along a direction that the order of the points (P, 3) gives.

    Faces that mirror themselves have places that are as near to the one side as to the other: leaning decides between
    them, wherever the face stands, instead of the rounding of a machine.
    """
    middle = points.mean(axis=0)
    direction = unit_vectors((np.sin(np.arange(1, len(points) + 1)) @ (points - middle))[None])[0]
    lean: FloatArray = _LEAN * ((places - middle) @ direction)[:, None] * direction
    return lean


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


def _refuse_twins(points: FeaturePoints, vertex_count: int, what: str) -> None:
    """RetargetError if two points hold the same place of the surface; two lips may touch."""
    places = points.matrix(vertex_count)[:, np.unique(points.vertices)].toarray()
    first, second = np.nonzero(np.triu(cdist(places, places) < 1e-6, 1))
    if len(first):
        raise RetargetError(
            f"{what}: feature points {points.names[first[0]]!r} and {points.names[second[0]]!r} lie in the same place, "
            "expected different places"
        )


def _places(
    finder: SurfaceFinder, bent: TriMesh, active: IntArray, extent: float, lean: FloatArray
) -> tuple[Nearest, BoolArray]:
    """Places of the vertices, face -1 for those that are not active; (V,) true where the normals agree."""
    points, normals, leaning = bent.vertices[active], bent.vertex_normals[active], (bent.vertices + lean)[active]
    nearest = finder.on_faces(points, finder.closest(leaning, normals, _AGREEMENT, _REACH * extent).face)
    lost = nearest.face < 0
    count = len(bent.vertices)
    places = Nearest(np.full(count, np.inf), np.full(count, -1, np.int64), np.zeros((count, 3)), bent.vertices.copy())
    for whole, some, guess in zip(
        places, nearest, finder.on_faces(points[lost], finder.closest(leaning[lost]).face), strict=True
    ):
        some[lost] = guess
        whole[active] = some
    agrees = np.zeros(count, bool)
    agrees[active] = ~lost
    return places, agrees


def _to_own_side(sides: Sides, source: TriMesh, bent: TriMesh, places: Nearest, extent: float) -> BoolArray:
    """Move places (in place) from the other lip or lid to the own one where it is as near.

    Returns (V,) true for places that stay well inside the other side. Near the borders of the sides, which the points
    give only roughly, a place is left where it is.
    """
    next_to = source.faces[places.face, places.weights.argmax(axis=1)]
    deep = np.zeros(len(next_to), bool)
    for vertices, faces, depth in sides.groups(np.flatnonzero(sides.crossed(next_to))):
        own = SurfaceFinder(source, faces).closest(bent.vertices[vertices], bent.vertex_normals[vertices], _AGREEMENT)
        near = own.distance < places.distance[vertices] + 0.003 * extent
        for whole, some in zip(places, own, strict=True):
            whole[vertices[near]] = some[near]
        deep[vertices] = ~near & (depth[next_to[vertices]] > 0.06 * extent)
    return deep


def _on_border(mesh: TriMesh, places: Nearest) -> BoolArray:
    """(N,) true for places on the mesh's border: at most two corners hold them, both of them boundary vertices."""
    holds = places.weights > 1e-6
    inside = holds & ~mesh.boundary_vertices[mesh.faces[places.face]]
    border: BoolArray = ~inside.any(axis=1) & ~holds.all(axis=1) & (places.face >= 0)
    return border
