"""Normal meshes: a face as a base mesh and signed offsets along normals, level by level."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray, IntArray, unit_vectors
from ..base.base_mesh import BaseLoop
from ..base.boundary_curve import BoundaryCurves
from ..closest_point import Nearest, SurfaceFinder, closest_agreeing
from ..errors import RetargetError
from ..mesh import TriMesh
from ..points import FeaturePoints
from ..raycast import CasterFactory, EmbreeCaster, RayCaster
from .piercing import AGREEMENT, Pierced, outliers, pierce
from .subdivision import Level, boundary_parameters
from .vertex_neighbours import adjacency, edge_lengths_around, incidence, mean_of_known, pick, spread_inwards, widen

_SPREAD_ROUNDS = 6
_SECOND_LOOKS = 2
_SOFTNESS = (0, 1, 2, 3, 5, 8, 12, 18, 24)
"""Rings over which a second look averages its normal, tried in this order."""


@dataclass(frozen=True, eq=False)
class SecondLook:
    """Vertices that are pierced again, from the mean of their neighbours along a softened normal.

    vertices : (K,). fill : (K, N) csr to that mean. direction : (K, M) csr, face vectors to the normal, not yet of
    unit length. offsets : (K,) along it; 0 where this look found nothing either.
    """

    vertices: IntArray
    fill: sp.csr_matrix
    direction: sp.csr_matrix
    offsets: FloatArray


@dataclass(frozen=True, eq=False)
class NormalLevel:
    """One level of a normal mesh.

    Attributes
    ----------
    positions : (N, 3), on the face.
    faces : (M, 3).
    offsets : (N,) signed distance along the unit normal of the prediction; 0 on the boundary and where another rule
        placed the vertex (`second_looks`, `failed`).
    boundary : (B,) vertices on the base's boundary loops.
    displacement : (B, 3) from where subdivision puts them to their place on the loop's curve.
    spread : (N, B) csr: how the prediction's other vertices follow the displacement.
    second_looks : vertices without an admissible hit at first, and how they were pierced then.
    failed : (N,) true for piercing errors: no look found an admissible hit.
    fill : (K, N) csr, failed vertices as means of their neighbours.
    correction : (K, 3) from that mean to the closest place of the face whose normal agrees.
    place_face : (N,) face of the original mesh that each vertex lies on.
    place_weights : (N, 3) barycentric weights there.
    """

    positions: FloatArray
    faces: IntArray
    offsets: FloatArray
    boundary: IntArray
    displacement: FloatArray
    spread: sp.csr_matrix
    second_looks: tuple[SecondLook, ...]
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

    base : (B, 3) positions of the base's points. steps, levels : subdivision and normal mesh of levels 1, 2, ….
    """

    base: FloatArray
    steps: tuple[Level, ...]
    levels: tuple[NormalLevel, ...]

    @property
    def piercing_errors(self) -> list[int]:
        """Failed vertices per level."""
        return [level.piercing_errors for level in self.levels]

    @property
    def second_looks(self) -> list[int]:
        """Vertices per level that missed at first and were pierced from the mean of their neighbours."""
        return [sum(int((look.offsets != 0).sum()) for look in level.second_looks) for level in self.levels]


def build_normal_mesh(
    mesh: TriMesh,
    points: FeaturePoints,
    loops: Sequence[BaseLoop],
    steps: Sequence[Level],
    make_caster: CasterFactory = EmbreeCaster,
) -> NormalMesh:
    """Pierce a face level by level.

    Every level is predicted by subdivision; its boundary vertices move to the curves of their loops and the
    others near by follow, except for old ones where the scheme is interpolating: those stay where they are. Then
    every other vertex moves along the prediction's unit normal (area-weighted), either way, to the nearest hit whose
    normal agrees and that is near. Hits that are outliers among their neighbours are dropped. What missed is looked
    for again from the mean of its neighbours along normals averaged over growing rings, by the same rule.

    What no look finds is a *piercing error*: it becomes the mean of its neighbours, moved to the closest place of the
    surface whose normal agrees. Vertices found by a second look are not errors, but are counted in `second_looks`.

    Parameters
    ----------
    mesh : the face; components without a point (eyes, teeth, lashes) are not looked at.
    points : the base's vertices on it, in the base's order.
    loops : the base's boundary loops.
    steps : the subdivision hierarchy of the base, one step per level.
    make_caster : makes what casts rays on the skin; Embree unless another one is given.

    Raises
    ------
    RetargetError : if the hierarchy does not start from the points.

    References
    ----------
    Guskov et al. 2000; Na and Jung 2004, section 3, equations (6) and (7).
    """
    if not steps or steps[0].matrix.shape[1] != len(points):
        start = steps[0].matrix.shape[1] if steps else 0
        raise RetargetError(f"the hierarchy starts from {start} base vertices, but {len(points)} points arrived")
    rows = _skin_faces(mesh, points)
    skin = TriMesh(mesh.vertices, mesh.faces[rows], mesh.polygons[rows])
    builder = _Builder(skin, points, loops, steps, make_caster(skin))
    base = points.positions(mesh.vertices)
    levels: list[NormalLevel] = []
    positions, places = base, builder.base_places(base)
    for number, step in enumerate(steps):
        level = builder.level(positions, places, step, number)
        positions, places = level.positions, _Places(level.place_face, level.place_weights)
        levels.append(replace(level, place_face=rows[level.place_face]))
    return NormalMesh(base, tuple(steps), tuple(levels))


def _skin_faces(mesh: TriMesh, points: FeaturePoints) -> IntArray:
    """Rows of the faces of the components that hold points."""
    held = np.isin(mesh.components, mesh.components[points.holders])
    return np.flatnonzero(held[mesh.faces[:, 0]])


class _Places:
    """Where on the face each vertex of a level lies, as it becomes known."""

    def __init__(self, face: IntArray, weights: FloatArray) -> None:
        self.face, self.weights = face, weights

    @classmethod
    def unknown(cls, count: int) -> _Places:
        return cls(np.full(count, -1, np.int64), np.zeros((count, 3)))

    def put(
        self, vertices: IntArray, places: Nearest | Pierced | _Places, rows: IntArray | slice = slice(None)
    ) -> None:
        self.face[vertices], self.weights[vertices] = places.face[rows], places.weights[rows]


class _Builder:
    """The face, and where the boundary loops run on it."""

    def __init__(
        self,
        mesh: TriMesh,
        points: FeaturePoints,
        loops: Sequence[BaseLoop],
        steps: Sequence[Level],
        caster: RayCaster,
    ) -> None:
        self._mesh, self._caster = mesh, caster
        self._finder = SurfaceFinder(mesh)
        self._rings = boundary_parameters([loop.vertices for loop in loops], steps)
        base = points.positions(mesh.vertices)
        normals = points.positions(mesh.vertex_normals)
        curves = BoundaryCurves(mesh, self._finder)
        self._curves = []
        for loop, (_, parameters) in zip(loops, self._rings[-1], strict=True):
            places = curves.places(base[loop.vertices], normals[loop.vertices], parameters)
            self._curves.append((parameters, places))

    def base_places(self, base: FloatArray) -> _Places:
        """Where the base's vertices (B, 3) lie."""
        found = self._finder.closest(base)
        return _Places(found.face, found.weights)

    def level(self, coarse: FloatArray, known: _Places, step: Level, number: int) -> NormalLevel:
        """Predict, move the boundary, pierce, look again, fill; known : places of the coarse vertices."""
        predicted = step.matrix @ coarse
        positions = predicted.copy()
        places = _Places.unknown(len(predicted))
        self._place_boundary(number, positions, places)
        boundary = np.flatnonzero(places.face >= 0)
        neighbours = adjacency(TriMesh(positions, step.faces))
        spread = spread_inwards(neighbours, boundary, _SPREAD_ROUNDS)
        if step.interpolating:
            kept = np.flatnonzero(places.face[: len(coarse)] < 0)
            places.put(kept, known, kept)
            follows = np.ones(len(predicted))
            follows[kept] = 0.0
            spread = (sp.diags(follows) @ spread).tocsr()
            spread.eliminate_zeros()
        displacement = (positions - predicted)[boundary]
        positions += spread @ displacement
        prediction = TriMesh(positions, step.faces)
        offsets, failed = self._pierce(prediction, neighbours, places)
        positions = positions + offsets[:, None] * prediction.vertex_normals
        looks = []
        for _ in range(_SECOND_LOOKS):
            if failed.any():
                looks.append(self._look_again(positions, step.faces, neighbours, failed, places))
        unknown = np.flatnonzero(failed)
        fill = mean_of_known(neighbours, unknown)
        correction = self._fill(positions, step.faces, neighbours, unknown, fill, places)
        return NormalLevel(
            positions,
            step.faces,
            offsets,
            boundary,
            displacement,
            spread,
            tuple(looks),
            failed,
            fill,
            correction,
            places.face,
            places.weights,
        )

    def _place_boundary(self, number: int, positions: FloatArray, places: _Places) -> None:
        for (vertices, parameters), (fine, curve) in zip(self._rings[number], self._curves, strict=True):
            rows = np.searchsorted(fine, parameters)
            positions[vertices] = curve.point[rows]
            places.put(vertices, curve, rows)

    def _pierce(self, predicted: TriMesh, neighbours: sp.csr_matrix, places: _Places) -> tuple[FloatArray, BoolArray]:
        """Offsets (N,) of the first look, and what it missed."""
        inner = np.flatnonzero(places.face < 0)
        edges = edge_lengths_around(neighbours, predicted.vertices)
        found = pierce(
            self._mesh, self._caster, predicted.vertices[inner], predicted.vertex_normals[inner], edges[inner]
        )
        offsets = np.zeros(len(edges))
        offsets[inner] = found.offset
        hit = np.zeros(len(edges), bool)
        hit[inner] = found.face >= 0
        failed = np.zeros(len(edges), bool)
        failed[inner] = found.face < 0
        places.put(inner, found)
        failed |= outliers(neighbours, offsets, hit, edges)
        offsets[failed] = 0.0
        return offsets, failed

    def _look_again(
        self, positions: FloatArray, faces: IntArray, neighbours: sp.csr_matrix, failed: BoolArray, places: _Places
    ) -> SecondLook:
        """Pierce failed vertices from the mean of their neighbours; updates positions, failed and places."""
        unknown = np.flatnonzero(failed)
        fill = mean_of_known(neighbours, unknown)
        positions[unknown] = fill @ positions
        mesh = TriMesh(positions.copy(), faces)
        touching = incidence(mesh)
        edges = edge_lengths_around(neighbours, mesh.vertices)
        offsets = np.zeros(len(unknown))
        directions = sp.csr_matrix((len(unknown), len(faces)))
        rows, done = np.arange(len(unknown)), 0
        around = pick(unknown, len(positions))
        for softness in _SOFTNESS:
            around, done = widen(around, neighbours, softness - done), softness
            direction = around @ touching
            normals = unit_vectors(direction @ mesh.face_vectors)
            found = pierce(self._mesh, self._caster, mesh.vertices[unknown[rows]], normals, around @ edges)
            hit = np.flatnonzero(found.face >= 0)
            vertices = unknown[rows[hit]]
            offsets[rows[hit]] = found.offset[hit]
            directions = directions + pick(rows[hit], len(unknown)).T @ direction[hit]
            positions[vertices] += found.offset[hit, None] * normals[hit]
            failed[vertices] = False
            places.put(vertices, found, hit)
            rows, around = rows[found.face < 0], around[found.face < 0]
            if not len(rows):
                break
        return SecondLook(unknown, fill, directions.tocsr(), offsets)

    def _fill(
        self,
        positions: FloatArray,
        faces: IntArray,
        neighbours: sp.csr_matrix,
        unknown: IntArray,
        fill: sp.csr_matrix,
        places: _Places,
    ) -> FloatArray:
        """Put piercing errors on the surface near their neighbours' mean; returns the way there (K, 3)."""
        if not len(unknown):
            return np.zeros((0, 3))
        mean = fill @ positions
        positions[unknown] = mean
        facing = TriMesh(positions, faces).vertex_normals[unknown]
        edges = edge_lengths_around(neighbours, positions)[unknown]
        near = closest_agreeing(self._finder, mean, facing, AGREEMENT, edges)
        positions[unknown] = near.point
        places.put(unknown, near)
        correction: FloatArray = near.point - mean
        return correction
