"""Facial motion cloning (Pandzic 2001): the source's motion, vertex by vertex, onto a face of other proportions.

The default finds the places that belong together in space, on the surfaces, scales motion as the heads are, turns it
with them, closes lids as far as the source's, and smooths away what folds. `motion = "regional"` and `"compliant"`
measure it in the units of each face (FAPU); `variant = "paper"` finds places in the plane onto which both heads are
unrolled.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray, IntArray, Progress, no_progress, progress_part, unit_vectors
from ..base.regions import eye_separation
from ..binding import multiply
from ..carry import local_turns, steady_turns
from ..cloning.cylinder import Cylinder
from ..cloning.normalisation import vertex_lengths
from ..cloning.plane_map import plane_map
from ..errors import RetargetError
from ..matching.coarse_source import smooth_coarse_source
from ..matching.correspondence import correspond
from ..mpeg4.fapu import Fapu, measure_fapu
from ..mpeg4.head import head_axes
from ..mpeg4.regions import OWN_PARTS, point_lengths
from ..parts.carried_parts import CarriedParts, carried_parts
from ..parts.report import still_components
from ..points import FeaturePoints, common_names
from ..problem import Problem
from ..rigid import Similarity, fit_similarity
from ..seams.lids import LidSeams, lid_seams
from ..steering.base_places import denser_base
from ..steering.learned import Example, Steering, SteeringBase, learn
from ..unfolding import Unfolding
from .settings import MotionCloningSettings

_AGREEMENT = 0.3
"""Normals of matched places whose dot product is below this say nothing about how the surface turns."""
_TURN_REACH = 0.28
"""Neighbourhood of a local frame, in eye separations."""


class Units(NamedTuple):
    """How motion is measured on the source and given back on the target.

    read : (3, 3) the source's displacements into the axes of its head. lengths : (Vs, 3) or (1, 3) their units there.
    turns : (Vt, 3, 3) measured motion to displacements of the target.
    rotation : (3, 3) of the source's head to the target's.
    figures : for the report.
    """

    read: FloatArray
    lengths: FloatArray
    turns: FloatArray
    rotation: FloatArray
    figures: dict[str, Any]


class MotionCloningRetargeter:
    """A fitted pair of faces.

    Parameters
    ----------
    problem : the two faces.
    matrix : (Vt, Vs) takes values at the source's vertices to the target's.
    units : of the motion.
    parts : what follows the target's skin.
    """

    def __init__(self, problem: Problem, matrix: sp.csr_matrix, units: Units, parts: CarriedParts) -> None:
        self._problem, self._parts, self._figures = problem, parts, units.figures
        self._smoothing: sp.csr_matrix | None = None
        self._steering: Steering | None = None
        self._lessons: tuple[SteeringBase, list[Example]]
        self._seams: LidSeams | None = None
        self._unfolding: Unfolding | None = None
        self._taught = np.zeros(len(problem.target.mesh.vertices), bool)
        self._matrix, self._turns = matrix.astype(np.float32), units.turns.astype(np.float32)
        self._read, self._per_length = units.read.T.astype(np.float32), (1 / units.lengths).astype(np.float32)
        self._source = problem.source.mesh.vertices.astype(np.float32)
        self._target = problem.target.mesh.vertices.astype(np.float32)

    def frames(self, source: FloatArray) -> FloatArray:
        """Target positions (F, Vt, 3) float32 of source frames (F, Vs, 3)."""
        source = np.asarray(source)
        if source.ndim != 3 or source.shape[1:] != self._source.shape:
            raise RetargetError(f"source frames have shape {source.shape}, expected (F, {len(self._source)}, 3)")
        moved = self.plain(source.astype(np.float32))
        if self._steering is not None:
            moved = self._steering.steer(moved, source.astype(np.float32))
        moved = self._parts.add_to(moved, source)
        moved += self._target
        return moved

    def plain(self, source: FloatArray) -> FloatArray:
        """Displacements (F, Vt, 3) float32 of frames (F, Vs, 3) float32, without examples, of the skin alone."""
        acted = source - self._source
        # All frames of a vertex lie side by side until the motion is done.
        every = np.ascontiguousarray(acted.transpose(1, 0, 2))
        if self._smoothing is not None:
            every = _each_column(self._smoothing, every)
        measured = (every.reshape(-1, 3) @ self._read).reshape(every.shape) * self._per_length[:, None]
        moved = _each_column(self._matrix, measured) @ self._turns.transpose(0, 2, 1)
        moved = np.ascontiguousarray(moved.transpose(1, 0, 2))
        if self._seams is not None:
            moved = self._seams.correct(moved, acted)
        # What an artist's example folds is left as it is: examples are added afterwards.
        return moved if self._unfolding is None else self._unfolding.mend(moved, source)

    def fair(self, seams: LidSeams, scale: float) -> None:
        """From now on smooth what a coarse source does, close lids as far as the source's, and mend what folds.

        scale : target units for one unit of the source.
        """
        source, target = self._problem.source.mesh, self._problem.target.mesh
        self._unfolding = Unfolding(source, target, self.counterpart)
        smoothing, matrix = smooth_coarse_source(self._matrix, source, target, scale)
        self._smoothing = None if smoothing is None else smoothing.astype(np.float32)
        self._matrix, self._seams = matrix.astype(np.float32), seams

    def learn(self, base: SteeringBase, strength: float) -> None:
        """Learn from the problem's examples; the parts go on following the skin.

        Raises
        ------
        RetargetError : as `SteeringBase.examples`.
        """
        examples = base.examples(self._problem)
        follows = self._parts.moves[:, None]
        of_skin = [example._replace(target=np.where(follows, 0.0, example.target)) for example in examples]
        self._lessons = base, of_skin
        self._steering = learn(base, of_skin, self.plain, strength)
        if self._steering is not None:
            self._taught = base.moved(of_skin)

    def adjusted(self, settings: MotionCloningSettings) -> MotionCloningRetargeter:
        """The same fit with another strength of the examples."""
        again = copy(self)
        again.__dict__.pop("report", None)
        again._steering = learn(*self._lessons, self.plain, settings.example_strength)
        if again._steering is not None:
            again._taught = self._lessons[0].moved(self._lessons[1])
        return again

    def detail(self, source: FloatArray) -> tuple[FloatArray, IntArray]:
        """The target's frames and its faces: this method has no finer mesh."""
        return self.frames(source), self._problem.target.mesh.faces

    @cached_property
    def counterpart(self) -> IntArray:
        """(Vt,) source vertex that gives each target vertex the most of its motion, -1 where none does."""
        rows = np.flatnonzero(self._moves)
        starts = self._matrix.indptr[rows]
        most = np.repeat(np.maximum.reduceat(self._matrix.data, starts), np.diff(self._matrix.indptr)[rows])
        there = np.where(self._matrix.data == most, np.arange(len(most)), len(most))
        found = np.full(len(self._target), -1, np.int64)
        found[rows] = self._matrix.indices[np.minimum.reduceat(there, starts)]
        return found

    @property
    def _moves(self) -> BoolArray:
        """(Vt,) true for vertices that the source moves."""
        moves: BoolArray = self._matrix.getnnz(axis=1) > 0
        return moves

    @cached_property
    def report(self) -> Mapping[str, Any]:
        """Figures of the fit, as plain data."""
        source, target = self._problem.source, self._problem.target
        moves = self._moves | self._parts.moves | self._taught
        still, warnings = still_components(target.mesh, moves, self._parts.rows)
        return {
            "source": {"vertices": len(source.mesh.vertices), "faces": len(source.mesh.faces)},
            "target": {"vertices": len(target.mesh.vertices), "faces": len(target.mesh.faces)},
            "points": len(common_names(source.points, target.points)),
            **self._figures,
            "lids": [] if self._seams is None else list(self._seams.sides),
            "parts": self._parts.rows,
            "still_components": still,
            "examples": [] if self._steering is None else self._steering.figures,
            "warnings": warnings,
        }


def fit(problem: Problem, settings: MotionCloningSettings, progress: Progress = no_progress) -> MotionCloningRetargeter:
    """Fit motion cloning to a pair of faces.

    Raises
    ------
    RetargetError : if the faces have too few points in common, or points without MPEG-4 names where units of regions
        are asked for, or the examples do not fit the faces.

    References
    ----------
    Pandzic 2001.
    """
    progress(0.0, "measuring both faces")
    source, target = problem.source.mesh, problem.target.mesh
    names = common_names(problem.source.points, problem.target.points)
    skin = [name for name in names if name not in OWN_PARTS]
    points = problem.source.points.subset(skin), problem.target.points.subset(skin)
    separations = eye_separation(source, points[0]), eye_separation(target, points[1])
    published = settings.variant == "paper"
    if published:
        progress(0.2, "laying both faces in one plane")
        cylinders = [Cylinder(names, *measured) for measured in _measured_heads(problem, names)]
        matrix = plane_map((source, target), points, cylinders, problem.make_caster)
    else:
        found = correspond(source, points[0], target, points[1], progress_part(progress, 0.0, 0.7))
        matrix = found.matrix(source.faces, len(source.vertices))
        across = fit_similarity(points[0].positions(source.vertices), points[1].positions(target.vertices))
    progress(0.7, "preparing the motion")
    if published or settings.motion != "local":
        units = _regional_units(problem, names, points, smooth=not published)
    else:
        units = _head_units(across, len(target.vertices))
    if settings.motion != "compliant":
        turned = _local_turns(problem, matrix, units.rotation, points[1].positions(target.vertices), separations[1])
        units = units._replace(turns=(turned if published else steady_turns(turned)) @ units.turns)
    parts = carried_parts(problem.source, problem.target, np.zeros(len(target.vertices), bool))
    retargeter = MotionCloningRetargeter(problem, matrix, units, parts)
    if not published and settings.motion != "compliant":
        measured = np.broadcast_to(units.read / units.lengths[:, :, None], (len(source.vertices), 3, 3))
        retargeter.fair(lid_seams(problem, units.turns, measured), across.scale)
    progress(0.9, "learning from the examples")
    base = SteeringBase(source, target, *points, *separations)
    if problem.source.examples and not published:
        base = denser_base(base, found)
    retargeter.learn(base, settings.example_strength)
    progress(1.0, "fitted")
    return retargeter


def _each_column(matrix: sp.csr_matrix, values: FloatArray) -> FloatArray:
    """Matrix (M, N) times values (N, F, 3): (M, F, 3)."""
    product: FloatArray = multiply(matrix, values.reshape(len(values), -1)).reshape(-1, *values.shape[1:])
    return product


def _measured_heads(problem: Problem, names: Sequence[str]) -> list[tuple[FloatArray, FloatArray, Fapu]]:
    """Places (P, 3) of the points, axes (3, 3) of the head and units of each face."""
    heads = []
    for face in (problem.source, problem.target):
        places = face.points.subset(names).positions(face.mesh.vertices)
        axes = head_axes(names, places)
        heads.append((places, axes, measure_fapu(names, places, axes)))
    return heads


def _head_units(across: Similarity, count: int) -> Units:
    """One length for the whole head: the source's own, and the scale between both heads.

    count : of the target's vertices.
    """
    turns = np.broadcast_to(across.scale * across.rotation, (count, 3, 3))
    return Units(np.eye(3), np.ones((1, 3)), turns, across.rotation, {"scale": across.scale})


def _regional_units(
    problem: Problem, names: Sequence[str], points: tuple[FeaturePoints, FeaturePoints], smooth: bool
) -> Units:
    """The lengths of the FAPs that act in each region of a face, along the axes of its head."""
    meshes = problem.source.mesh, problem.target.mesh
    (_, here, ours), (_, there, theirs) = _measured_heads(problem, names)
    marks = [part.positions(mesh.vertices) for part, mesh in zip(points, meshes, strict=True)]
    at_points = point_lengths(points[0].names, marks[0], [ours, theirs])
    lengths = [
        vertex_lengths(mesh.vertices, mark, units, smooth)
        for mesh, mark, units in zip(meshes, marks, at_points, strict=True)
    ]
    figures = {"fapu": {"source": ours.taken, "target": theirs.taken}}
    return Units(here, lengths[0], there.T * lengths[1][:, None], there.T @ here, figures)


def _local_turns(
    problem: Problem, matrix: sp.csr_matrix, rotation: FloatArray, marks: FloatArray, separation: float
) -> FloatArray:
    """(Vt, 3, 3) rotations from the source's surface, its head turned like the target's, to the target's."""
    source, target = problem.source.mesh, problem.target.mesh
    carried = matrix @ source.vertex_normals
    before, after = unit_vectors(carried) @ rotation.T, target.vertex_normals
    agree = np.einsum("vi,vi->v", before, after) > _AGREEMENT
    trust = target.vertex_areas * (agree & (np.asarray(matrix.sum(axis=1)).ravel() > 0.5))
    return local_turns(before, after, target.vertices, trust, marks, separation, target.vertices, _TURN_REACH)
