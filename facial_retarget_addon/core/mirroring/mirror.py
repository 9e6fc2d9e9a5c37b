"""The mirror image of a face on its surface: exact where its polygons mirror themselves, by the points elsewhere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray, IntArray, Progress, no_progress, progress_part
from ..base.regions import eye_separation
from ..closest_point import SurfaceFinder, closest_agreeing
from ..errors import RetargetError
from ..matching.correspondence import correspond
from ..mesh import TriMesh
from ..mpeg4.head import LEFT
from ..placing.template import partner
from ..points import FeaturePoints, place_matrix
from ..shapes.sides import FEATHER
from .twins import PolygonWalk, mirror_twins

WAYS = ("LEFT_TO_RIGHT", "RIGHT_TO_LEFT", "BOTH", "FLIP")
"""What `Mirror.shape` can do."""
_REACH = 0.05
"""How far the mirror images of a component may lie from the reflected places on the mean, in sizes of the head."""


class Plane(NamedTuple):
    """The plane of the middle: a unit normal (3,) to the subject's left, and its distance from the origin along it."""

    left: FloatArray
    middle: float

    def reflected(self, places: FloatArray) -> FloatArray:
        """Places (..., 3) mirrored."""
        mirrored: FloatArray = places - 2 * self.side(places)[..., None] * self.left
        return mirrored

    def side(self, places: FloatArray) -> FloatArray:
        """(...) how far places (..., 3) lie to the left."""
        side: FloatArray = places @ self.left - self.middle
        return side

    def turned(self, displacements: FloatArray) -> FloatArray:
        """Displacements (..., 3) mirrored."""
        mirrored: FloatArray = displacements - 2 * (displacements @ self.left)[..., None] * self.left
        return mirrored


@dataclass(frozen=True, eq=False)
class Mirror:
    """Left and right of one head.

    Attributes
    ----------
    matrix : (V, V) csr, takes values at all vertices from the mirror images of their places.
    plane : the plane of the middle.
    left_share : (V,) 1 on the left, 0 on the right, between them smooth; a place and its image add up to 1.
    exact : (V,) whether the image is a vertex, and the vertex its image's image.
    """

    matrix: sp.csr_matrix
    plane: Plane
    left_share: FloatArray
    exact: BoolArray

    def flipped(self, displacements: FloatArray) -> FloatArray:
        """Displacements (V, 3) with left and right exchanged."""
        flipped: FloatArray = self.plane.turned(self.matrix @ displacements)
        return flipped

    def shape(self, displacements: FloatArray, way: str) -> FloatArray:
        """Displacements (V, 3) mirrored.

        Parameters
        ----------
        way : LEFT_TO_RIGHT or RIGHT_TO_LEFT for one half on both sides, BOTH for the mean of the halves, FLIP for the
            halves exchanged.

        Raises
        ------
        RetargetError : for another way.
        """
        if way not in WAYS:
            raise RetargetError(f"{way!r} is no way to mirror, expected one of {', '.join(WAYS)}")
        flipped = self.flipped(displacements)
        if way == "FLIP":
            return flipped
        share = {"LEFT_TO_RIGHT": self.left_share, "RIGHT_TO_LEFT": 1 - self.left_share}.get(way)
        own = np.full((len(displacements), 1), 0.5) if share is None else share[:, None]
        mirrored: FloatArray = own * displacements + (1 - own) * flipped
        return mirrored


def fit_mirror(
    mesh: TriMesh, counts: IntArray, corners: IntArray, points: FeaturePoints, progress: Progress = no_progress
) -> Mirror:
    """Find the mirror image of every vertex of a head.

    Parameters
    ----------
    counts, corners : the artist's polygons, as of `MeshFile`; whether these mirror themselves decides.
    points : of the head; pairs of left and right tell where the middle is. Without any it is the plane X = 0, and
        left is +X, as Blender's own mirroring has it.

    Raises
    ------
    RetargetError : if neither the polygons mirror themselves nor the points tell what lies opposite to what.
    """
    plane = _plane_of_points(mesh, points) or Plane(np.array([1.0, 0.0, 0.0]), 0.0)
    progress(0.0, "comparing left and right")
    walk = PolygonWalk(np.asarray(counts, np.int64), np.asarray(corners, np.int64))
    twins = mirror_twins(walk, mesh.components, mesh.vertices, plane.reflected(mesh.vertices), _REACH * mesh.size)
    skin = mesh.components == _skin(mesh, points)
    if twins[skin].min() >= 0:
        held = np.flatnonzero(twins >= 0)
        plane = _plane(mesh.vertices[held], mesh.vertices[twins[held]], plane.left)
        rest = _by_nearest(mesh, plane)
    else:
        twins[:] = -1
        rest = _by_points(mesh, points, plane, progress_part(progress, 0.2, 0.9))
    exact = twins >= 0
    exactly = sp.csr_matrix((exact.astype(float), (np.arange(len(twins)), np.maximum(twins, 0))), rest.shape)
    matrix = (exactly + sp.diags((~exact).astype(float)) @ rest).tocsr()
    matrix.eliminate_zeros()
    side = plane.side(mesh.vertices)
    border = FEATHER * (eye_separation(mesh, points) if len(points) else 0.25 * mesh.size)
    t = np.clip(0.5 + 0.25 * (side - matrix @ side) / border, 0.0, 1.0)
    return Mirror(matrix, plane, t * t * (3 - 2 * t), exact)


def _skin(mesh: TriMesh, points: FeaturePoints) -> int:
    """The component that holds most points, the largest one without any."""
    labels = mesh.components[points.holders] if len(points) else mesh.components[mesh.faces[:, 0]]
    return int(np.bincount(labels).argmax())


def _plane_of_points(mesh: TriMesh, points: FeaturePoints) -> Plane | None:
    """The plane between left and right points; None without a pair."""
    swapped = _swapped(points)
    pairs = [(name, partner(name)) for name in swapped.names if _is_left(name)]
    if not pairs:
        return None
    here, there = (part.positions(mesh.vertices) for part in (points.subset(swapped.names), swapped))
    row = {name: k for k, name in enumerate(swapped.names)}
    left = np.sum([here[row[one]] - here[row[other]] for one, other in pairs], axis=0)
    return _plane(here, there, left)


def _is_left(name: str) -> bool:
    return name in LEFT or (partner(name) != name and "l" in name.split("_"))


def _plane(places: FloatArray, images: FloatArray, left: FloatArray) -> Plane:
    """The plane whose reflection takes places (N, 3) to their images (N, 3) best; each image's image is among them.

    Then the sum of products of places and images is symmetric, and the best reflection is in the plane across its
    least eigenvector: the orthogonal Procrustes problem with the determinant -1 (Schönemann 1966; Umeyama 1991).
    """
    middle = 0.5 * (places + images).mean(axis=0)
    products = (places - middle).T @ (images - middle)
    normal = np.linalg.eigh(products + products.T)[1][:, 0]
    normal = normal if normal @ left >= 0 else -normal
    return Plane(normal, float(middle @ normal))


def _swapped(points: FeaturePoints) -> FeaturePoints:
    """The points under the names of their partners, as the mirror image of the face has them; single ones left out."""
    names = [name for name in points.names if partner(name) in points.names]
    there = points.subset([partner(name) for name in names])
    return FeaturePoints(tuple(names), there.vertices, there.weights)


def _mirror_image(mesh: TriMesh, plane: Plane) -> TriMesh:
    """The mesh mirrored, its faces turned around so that they still look outwards."""
    return TriMesh(plane.reflected(mesh.vertices), mesh.faces[:, ::-1], mesh.polygons)


def _by_nearest(mesh: TriMesh, plane: Plane) -> sp.csr_matrix:
    """(V, V) values from the nearest place of the mirrored surface that looks the same way."""
    image = _mirror_image(mesh, plane)
    found = closest_agreeing(SurfaceFinder(image), mesh.vertices, mesh.vertex_normals, 0.0)
    return place_matrix(image.faces[found.face], found.weights, len(mesh.vertices))


def _by_points(mesh: TriMesh, points: FeaturePoints, plane: Plane, progress: Progress) -> sp.csr_matrix:
    """(V, V) values from where the mirrored face, under the names of the other side, corresponds."""
    swapped = _swapped(points)
    if not any(_is_left(name) for name in swapped.names):
        raise RetargetError(
            "left and right do not mirror each other in the mesh, and none of the points are pairs of left and right: "
            "expected such points, or polygons that mirror themselves"
        )
    image = _mirror_image(mesh, plane)
    found = correspond(image, swapped, mesh, points.subset(swapped.names), progress)
    matrix = found.matrix(image.faces, len(mesh.vertices)).tolil()
    if found.still_components:
        still = np.concatenate(found.still_components)
        matrix[still] = _by_nearest(mesh, plane)[still]
    return matrix.tocsr()
