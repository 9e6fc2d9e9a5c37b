"""Where motion of a target's vertices comes from, by the plane in which both faces are aligned."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray, IntArray
from ..mesh import TriMesh
from ..mpeg4.mean_face import place_missing
from ..points import FeaturePoints, place_matrix
from ..raycast import CasterFactory
from .alignment import align
from .cylinder import Cylinder, Unrolled
from .interpolation import least_excess, outermost
from .lip_regions import lip_outlines, lip_regions

SUPPORT = 0.02
"""Radius of the antialiasing in the plane (Pandzic 2001, "Antialiasing")."""
_AROUND = np.arange(8) * np.pi / 4
_SAMPLES = np.vstack([np.zeros((1, 2)), SUPPORT * np.column_stack([np.cos(_AROUND), np.sin(_AROUND)])])


def plane_map(
    meshes: tuple[TriMesh, TriMesh],
    points: tuple[FeaturePoints, FeaturePoints],
    cylinders: Sequence[Cylinder],
    make_caster: CasterFactory,
) -> sp.csr_matrix:
    """(Vt, Vs) matrix that takes values at the source's vertices to the target's.

    Each target vertex takes the mean of what lies at its place in the plane and at eight places around it, from the
    outermost triangle; those that no triangle holds do not count. Where no place is held, the closest triangle by
    `least_excess` gives. A lip takes nothing from triangles that touch the other lip. Components of the target
    without feature points take nothing.

    Parameters
    ----------
    meshes : source and target, neutral.
    points : of the two, the same names in the same order.
    cylinders : of the two.

    References
    ----------
    Pandzic 2001, "Mapping facial motion".
    """
    source, target = meshes
    names = points[0].names
    flat = [cylinder.unroll(mesh.vertices) for cylinder, mesh in zip(cylinders, meshes, strict=True)]
    marks = [
        cylinder.unroll(given.positions(mesh.vertices)).plane
        for cylinder, given, mesh in zip(cylinders, points, meshes, strict=True)
    ]
    ours, theirs = (_lips(*face) for face in zip(meshes, points, cylinders, flat, strict=True))
    taking = np.flatnonzero(_with_points(target, points[1]))
    places = align(names, marks[1], marks[0], flat[1].plane[taking])
    faces = _front(source, points[0], flat[0])
    corners = np.zeros((len(taking), len(_SAMPLES), 3), np.int64)
    weights = np.zeros((len(taking), len(_SAMPLES), 3))
    for lip in (-1, 0, 1):
        some = np.flatnonzero(theirs[taking] == lip)
        open_to = faces if lip == 0 else faces[(ours[faces] != -lip).all(axis=1)]
        if len(some) and len(open_to):
            corners[some], weights[some] = _sampled(places[some], flat[0], open_to, make_caster)
    shape = (len(taking), 3 * len(_SAMPLES))
    rows = place_matrix(corners.reshape(shape), weights.reshape(shape), len(source.vertices))
    spread = sp.csr_matrix((np.ones(len(taking)), (taking, np.arange(len(taking)))), (len(theirs), len(taking)))
    return (spread @ rows).tocsr()


def _sampled(
    places: FloatArray, unrolled: Unrolled, faces: IntArray, make_caster: CasterFactory
) -> tuple[IntArray, FloatArray]:
    """Corners and weights (N, samples, 3) of places (N, 2); the weights of a place add up to 1."""
    queries = (places[:, None] + _SAMPLES).reshape(-1, 2)
    face, weights = (
        part.reshape(len(places), len(_SAMPLES), *part.shape[1:])
        for part in outermost(queries, unrolled, faces, make_caster)
    )
    held = (face >= 0).sum(axis=1)
    weights = weights / np.maximum(held, 1)[:, None, None]
    lost = held == 0
    face[lost, 0], weights[lost, 0] = least_excess(places[lost], unrolled.plane[faces])
    return faces[face], weights


def _lips(mesh: TriMesh, points: FeaturePoints, cylinder: Cylinder, unrolled: Unrolled) -> IntArray:
    """(V,) region of each vertex; corners of the regions that have no point are placed by the average face."""
    positions = points.positions(mesh.vertices)
    upper, lower = (
        cylinder.unroll(np.array(list(place_missing(points.names, positions, outline).values()))).plane
        for outline in lip_outlines(points.names)
    )
    return lip_regions(upper, lower, unrolled.plane)


def _front(mesh: TriMesh, points: FeaturePoints, unrolled: Unrolled) -> IntArray:
    """Triangles of the components with points that do not lie across the seam at the back of the head."""
    angles = unrolled.plane[mesh.faces, 0]
    across = np.ptp(angles, axis=1) > np.pi
    front: IntArray = mesh.faces[_with_points(mesh, points)[mesh.faces[:, 0]] & ~across]
    return front


def _with_points(mesh: TriMesh, points: FeaturePoints) -> BoolArray:
    """(V,) true on components that hold a feature point."""
    holding: BoolArray = np.isin(mesh.components, mesh.components[points.vertices])
    return holding
