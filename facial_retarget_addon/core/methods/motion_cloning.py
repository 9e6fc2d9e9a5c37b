"""Facial motion cloning (Pandzic 2001): the source's motion, vertex by vertex, in the units of each face (FAPU).

The default finds the places that belong together in space, on the surfaces, and turns motion with them.
`variant = "paper"` finds them in the plane onto which both heads are unrolled.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray, IntArray, Progress, no_progress, progress_part, unit_vectors
from ..binding import apply_matrix
from ..carry import local_turns, turn
from ..cloning.cylinder import Cylinder
from ..cloning.normalisation import vertex_lengths
from ..cloning.plane_map import plane_map
from ..errors import RetargetError
from ..matching.correspondence import correspond
from ..mpeg4.fapu import Fapu, measure_fapu
from ..mpeg4.head import head_axes
from ..mpeg4.regions import OWN_PARTS, point_lengths
from ..parts.carried_parts import CarriedParts, carried_parts
from ..parts.report import still_components
from ..points import common_names
from ..problem import Problem
from ..steering.learned import Steering, SteeringBase, learn
from .settings import MotionCloningSettings

_AGREEMENT = 0.3
"""Normals of matched places whose dot product is below this say nothing about how the surface turns."""


class MotionCloningRetargeter:
    """A fitted pair of faces.

    Parameters
    ----------
    problem : the two faces.
    matrix : (Vt, Vs) takes values at the source's vertices to the target's.
    read : (3, 3) the source's displacements into the axes of its head. lengths : (Vs, 3) their units there.
    turns : (Vt, 3, 3) normalised motion to displacements of the target.
    fapus : of source and target.
    parts : what follows the target's skin.
    """

    def __init__(
        self,
        problem: Problem,
        matrix: sp.csr_matrix,
        read: FloatArray,
        lengths: FloatArray,
        turns: FloatArray,
        fapus: list[Fapu],
        parts: CarriedParts,
    ) -> None:
        self._problem, self._fapus, self._parts = problem, fapus, parts
        self._steering: Steering | None = None
        self._taught = np.zeros(len(problem.target.mesh.vertices), bool)
        self._matrix, self._turns = matrix.astype(np.float32), turns.astype(np.float32)
        self._read, self._per_length = read.T.astype(np.float32), (1 / lengths).astype(np.float32)
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
        normalised = ((source - self._source) @ self._read) * self._per_length
        return turn(apply_matrix(self._matrix, normalised), self._turns)

    def learn(self, base: SteeringBase, strength: float) -> None:
        """Learn from the problem's examples; the parts go on following the skin.

        Raises
        ------
        RetargetError : as `SteeringBase.examples`.
        """
        examples = base.examples(self._problem)
        follows = self._parts.moves[:, None]
        of_skin = [example._replace(target=np.where(follows, 0.0, example.target)) for example in examples]
        self._steering = learn(base, of_skin, self.plain, strength)
        if self._steering is not None:
            self._taught = base.moved(of_skin)

    def detail(self, source: FloatArray) -> tuple[FloatArray, IntArray]:
        """The target's frames and its faces: this method has no finer mesh."""
        return self.frames(source), self._problem.target.mesh.faces

    @cached_property
    def counterpart(self) -> IntArray:
        """(Vt,) source vertex that gives each target vertex the most of its motion, -1 where none does."""
        most = np.asarray(self._matrix.argmax(axis=1)).ravel().astype(np.int64)
        return np.where(self._moves, most, -1)

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
            "fapu": {"source": self._fapus[0].taken, "target": self._fapus[1].taken},
            "parts": self._parts.rows,
            "still_components": still,
            "examples": [] if self._steering is None else self._steering.figures,
            "warnings": warnings,
        }


def fit(problem: Problem, settings: MotionCloningSettings, progress: Progress = no_progress) -> MotionCloningRetargeter:
    """Fit motion cloning to a pair of faces.

    Raises
    ------
    RetargetError : if the faces have too few points in common, or points without MPEG-4 names, or the examples do not
        fit the faces.

    References
    ----------
    Pandzic 2001.
    """
    progress(0.0, "measuring both faces")
    source, target = problem.source.mesh, problem.target.mesh
    names = common_names(problem.source.points, problem.target.points)
    places = [face.points.subset(names).positions(face.mesh.vertices) for face in (problem.source, problem.target)]
    axes = [head_axes(names, there) for there in places]
    fapus = [measure_fapu(names, there, axis) for there, axis in zip(places, axes, strict=True)]
    skin = [name for name in names if name not in OWN_PARTS]
    points = problem.source.points.subset(skin), problem.target.points.subset(skin)
    marks = points[0].positions(source.vertices), points[1].positions(target.vertices)
    smooth = settings.variant == "default"
    lengths = [
        vertex_lengths(mesh.vertices, mark, at_points, smooth)
        for mesh, mark, at_points in zip((source, target), marks, point_lengths(skin, marks[0], fapus), strict=True)
    ]
    if smooth:
        found = correspond(source, points[0], target, points[1], progress_part(progress, 0.0, 0.8))
        matrix = found.matrix(source.faces, len(source.vertices))
    else:
        progress(0.2, "laying both faces in one plane")
        cylinders = [Cylinder(names, *measured) for measured in zip(places, axes, fapus, strict=True)]
        matrix = plane_map((source, target), points, cylinders, problem.make_caster)
    progress(0.8, "preparing the motion")
    turns = axes[1].T * lengths[1][:, None]
    if settings.motion == "local":
        turns = _local_turns(problem, matrix, axes[1].T @ axes[0], marks[1], fapus[1].es) @ turns
    parts = carried_parts(problem.source, problem.target, np.zeros(len(target.vertices), bool))
    retargeter = MotionCloningRetargeter(problem, matrix, axes[0], lengths[0], turns, fapus, parts)
    retargeter.learn(SteeringBase(source, target, *points, fapus[0].es, fapus[1].es), settings.example_strength)
    progress(1.0, "fitted")
    return retargeter


def _local_turns(
    problem: Problem, matrix: sp.csr_matrix, rotation: FloatArray, marks: FloatArray, separation: float
) -> FloatArray:
    """(Vt, 3, 3) rotations from the source's surface, its head turned like the target's, to the target's."""
    source, target = problem.source.mesh, problem.target.mesh
    carried = matrix @ source.vertex_normals
    before, after = unit_vectors(carried) @ rotation.T, target.vertex_normals
    agree = np.einsum("vi,vi->v", before, after) > _AGREEMENT
    trust = target.vertex_areas * (agree & (np.asarray(matrix.sum(axis=1)).ravel() > 0.5))
    return local_turns(before, after, target.vertices, trust, marks, separation, target.vertices)
