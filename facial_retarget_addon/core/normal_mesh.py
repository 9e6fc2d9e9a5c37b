"""Normal meshes: a face as a base mesh and signed offsets along normals, level by level."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from .arrays import BoolArray, FloatArray, IntArray
from .base_mesh import BaseLoop
from .boundary_curve import boundary_places
from .closest_point import SurfaceFinder
from .errors import RetargetError
from .mesh import TriMesh
from .points import FeaturePoints
from .raycast import EmbreeCaster, RayCaster
from .subdivision import Level, boundary_parameters

_AGREEMENT = 0.2
"""A hit counts where the surface normal's dot product with the ray's normal is above this."""
_REACH = 2.5
"""A hit counts within this many local edges."""
_OUTLIER = 1.5
"""A hit whose offset differs from its neighbours' median by more than this many local edges does not count."""


@dataclass(frozen=True, eq=False)
class NormalLevel:
    """One level of a normal mesh.

    Attributes
    ----------
    positions : (N, 3).
    faces : (M, 3).
    offsets : (N,) signed distance along the unit normal from the prediction; 0 where the vertex is not pierced.
    boundary : (B,) vertices on the base's boundary loops.
    displacement : (B, 3) from their prediction to their place on the loop's curve.
    failed : (N,) piercing errors: vertices no admissible hit was found for.
    fill : (K, N) csr, failed vertices as weighted means of the others.
    correction : (K, 3) from that mean to the closest place of the surface.
    place_face : (N,) face of the original mesh that each vertex lies on.
    place_weights : (N, 3) barycentric weights there.
    """

    positions: FloatArray
    faces: IntArray
    offsets: FloatArray
    boundary: IntArray
    displacement: FloatArray
    failed: BoolArray
    fill: sp.csr_matrix
    correction: FloatArray
    place_face: IntArray
    place_weights: FloatArray

    @property
    def piercing_errors(self) -> int:
        """Number of failed vertices."""
        return int(self.failed.sum())


@dataclass(frozen=True, eq=False)
class NormalMesh:
    """A face resampled on the hierarchy of a base mesh.

    base : (B, 3) positions of the feature points. steps, levels : subdivision and normal mesh of levels 1, 2, ….
    """

    base: FloatArray
    steps: tuple[Level, ...]
    levels: tuple[NormalLevel, ...]

    @property
    def piercing_errors(self) -> list[int]:
        """Failed vertices per level."""
        return [level.piercing_errors for level in self.levels]


def build_normal_mesh(
    mesh: TriMesh,
    points: FeaturePoints,
    loops: Sequence[BaseLoop],
    steps: Sequence[Level],
    caster: RayCaster | None = None,
) -> NormalMesh:
    """Pierce a face level by level.

    Every level is predicted by subdivision; boundary vertices move to the curves of their loops; every other
    vertex moves along its normal, either way, to the nearest hit on the face whose normal agrees and that
    is near. A vertex without such a hit, or whose offset is an outlier among its neighbours', is a *piercing
    error*: it becomes the mean of its neighbours, moved to the closest place of the surface with an agreeing
    normal.

    Parameters
    ----------
    mesh : the face.
    points : the base's vertices on it, in the base's order.
    loops : the base's boundary loops.
    steps : the subdivision hierarchy of the base, one step per level.
    caster : casts rays on `mesh`; Embree if none is given.

    References
    ----------
    Guskov et al. 2000; Na and Jung 2004, section 3, equations (6) and (7).
    """
    if not steps or steps[0].matrix.shape[1] != len(points):
        raise RetargetError(f"{len(points)} base points and a hierarchy that does not start from them")
    builder = _Builder(mesh, points, loops, steps, caster or EmbreeCaster(mesh))
    levels: list[NormalLevel] = []
    base = points.positions(mesh.vertices)
    previous = base
    for number, step in enumerate(steps):
        levels.append(builder.level(previous, step, number))
        previous = levels[-1].positions
    return NormalMesh(base, tuple(steps), tuple(levels))


class _Builder:
    def __init__(
        self,
        mesh: TriMesh,
        points: FeaturePoints,
        loops: Sequence[BaseLoop],
        steps: Sequence[Level],
        caster: RayCaster,
    ) -> None:
        self.mesh, self.caster = mesh, caster
        self.finder = SurfaceFinder(mesh)
        self.rings = boundary_parameters([loop.vertices for loop in loops], steps)
        base = points.positions(mesh.vertices)
        normals = points.positions(mesh.vertex_normals)
        finest = [self.rings[-1][k][1] for k in range(len(loops))]
        self.curves = [
            (t, boundary_places(mesh, self.finder, base[loop.vertices], normals[loop.vertices], t))
            for loop, t in zip(loops, finest, strict=True)
        ]

    def level(self, previous: FloatArray, step: Level, number: int) -> NormalLevel:
        predicted = step.matrix @ previous
        count = len(predicted)
        place_face = np.full(count, -1, np.int64)
        place_weights = np.zeros((count, 3))
        positions = predicted.copy()
        for (vertices, parameters), (fine, places) in zip(self.rings[number], self.curves, strict=True):
            rows = np.searchsorted(fine, parameters)
            positions[vertices] = places.point[rows]
            place_face[vertices] = places.face[rows]
            place_weights[vertices] = places.weights[rows]
        boundary = np.flatnonzero(place_face >= 0)
        moved = TriMesh(positions, step.faces)
        normals, edge = moved.vertex_normals, moved.vertex_edge_length
        inner = np.flatnonzero(place_face < 0)
        offset, face, weights = self.pierce(positions[inner], normals[inner], edge[inner])
        offsets = np.zeros(count)
        failed = np.zeros(count, bool)
        offsets[inner], place_face[inner], place_weights[inner] = offset, face, weights
        failed[inner] = face < 0
        failed |= self.outliers(moved, offsets, failed, place_face >= 0)
        offsets[failed] = 0.0
        positions = positions + offsets[:, None] * normals
        fill = neighbour_means(moved, failed)
        bad = np.flatnonzero(failed)
        correction = np.zeros((len(bad), 3))
        if len(bad):
            mean = fill @ positions
            positions[bad] = mean
            facing = TriMesh(positions, step.faces).vertex_normals[bad]
            near = self.finder.closest(mean, facing, _AGREEMENT)
            lost = near.face < 0
            if lost.any():
                for mine, other in zip(near, self.finder.closest(mean[lost]), strict=True):
                    mine[lost] = other
            positions[bad] = near.point
            correction = near.point - mean
            place_face[bad], place_weights[bad] = near.face, near.weights
        return NormalLevel(
            positions,
            step.faces,
            offsets,
            boundary,
            positions[boundary] - predicted[boundary],
            failed,
            fill,
            correction,
            place_face,
            place_weights,
        )

    def pierce(
        self, origins: FloatArray, normals: FloatArray, edge: FloatArray
    ) -> tuple[FloatArray, IntArray, FloatArray]:
        """Signed offset, face (-1: no admissible hit) and weights of the nearest admissible hit."""
        best = np.full(len(origins), np.inf)
        face = np.full(len(origins), -1, np.int64)
        weights = np.zeros((len(origins), 3))
        for sign in (1.0, -1.0):
            hits = self.caster.nearest(origins, sign * normals, _REACH * edge)
            agree = np.einsum("ij,ij->i", self.mesh.face_normals[hits.face], normals) > _AGREEMENT
            better = hits.found & agree & (hits.distance < np.abs(best))
            best[better] = sign * hits.distance[better]
            face[better], weights[better] = hits.face[better], hits.weights[better]
        return np.where(face >= 0, best, 0.0), face, weights

    def outliers(self, mesh: TriMesh, offsets: FloatArray, failed: BoolArray, on_curve: BoolArray) -> BoolArray:
        return np.zeros(len(offsets), bool)


def neighbour_means(mesh: TriMesh, unknown: BoolArray) -> sp.csr_matrix:
    """(K, N) matrix: the K unknown vertices as means of their neighbours, all means repeated until they rest."""
    bad = np.flatnonzero(unknown)
    count = len(mesh.vertices)
    if not len(bad):
        return sp.csr_matrix((0, count))
    i, j = np.concatenate([mesh.edges, mesh.edges[:, ::-1]]).T
    mean = sp.csr_matrix((np.ones(len(i)), (i, j)), shape=(count, count))[bad]
    degree = np.asarray(mean.sum(axis=1)).ravel()
    known = mean @ sp.diags((~unknown).astype(float))
    system = sp.diags(degree) - mean[:, bad]
    dense = splu(system.tocsc()).solve(known.tocsc()[:, np.unique(known.indices)].toarray())
    columns = np.unique(known.indices)
    rows = np.repeat(np.arange(len(bad)), len(columns))
    matrix = sp.csr_matrix((dense.ravel(), (rows, np.tile(columns, len(bad)))), shape=(len(bad), count))
    matrix.data[np.abs(matrix.data) < 1e-9] = 0
    matrix.eliminate_zeros()
    return matrix
