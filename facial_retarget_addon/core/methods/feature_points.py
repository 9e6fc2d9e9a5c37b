"""Feature-point retargeting (Kshirsagar et al. 2003): the source's points drive the target's, and they its surface.

Motion is measured in the units of each face (FAPU), so that a wide mouth smiles as wide as it is. Only the points
travel: what the source does between them, wrinkles above all, does not.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from ..acting.eyeballs import Eyeball, find_eyeballs
from ..acting.eyelids import Lid, find_lids
from ..acting.fap_face import FapFace, fit_fap_face
from ..acting.point_deformer import PointDeformer, fit_deformer
from ..arrays import BoolArray, FloatArray, IntArray, Progress, no_progress
from ..errors import RetargetError
from ..matching.smooth_warp import fit_smooth_warp
from ..mesh import TriMesh
from ..mpeg4.channels import PointChannels
from ..mpeg4.faps import FAPS
from ..mpeg4.fapu import measure_fapu
from ..mpeg4.fdps import FDPS
from ..mpeg4.head import head_axes
from ..mpeg4.regions import point_lengths
from ..parts.acting_parts import moved_vertices, with_parts
from ..parts.eyes import EyeTurns, pair_eyeballs
from ..parts.known_head import know_head
from ..parts.report import still_components
from ..points import FeaturePoints, common_names
from ..problem import Problem
from .settings import FeaturePointSettings

ONE_WAY = [fap.number - 1 for fap in FAPS if fap.one_way]
"""Columns of the FAPs whose values below 0 have no meaning."""


class FeaturePointRetargeter:
    """A fitted pair of faces.

    Parameters
    ----------
    problem : the two faces.
    settings : of the method.
    points : the common points, on the source and on the target.
    """

    def __init__(
        self, problem: Problem, settings: FeaturePointSettings, points: tuple[FeaturePoints, FeaturePoints]
    ) -> None:
        """Fit; see `fit`."""
        self._problem = problem
        self._source, self._target = problem.source.mesh, problem.target.mesh
        self._points = points
        self._eyes = _eye_turns(problem, points, settings)
        self._motion: _FreeMotion | _FapMotion
        if settings.motion == "faps":
            self._motion = _FapMotion(problem, *points, settings)
        else:
            self._motion = _FreeMotion(problem, *points, settings, self._eyes.turning())
        self._read = points[0].positions(self._source.vertices)

    def frames(self, source: FloatArray) -> FloatArray:
        """Target positions (F, Vt, 3) float32 of source frames (F, Vs, 3)."""
        source = np.asarray(source)
        if source.ndim != 3 or source.shape[1:] != self._source.vertices.shape:
            raise RetargetError(
                f"source frames have shape {source.shape}, expected (F, {len(self._source.vertices)}, 3)"
            )
        there = self._points[0].positions(source.astype(np.float32)).astype(np.float64)
        return self._eyes.add_to(self._motion.frames(there - self._read.astype(np.float32)), source)

    def adjusted(self, settings: FeaturePointSettings) -> FeaturePointRetargeter:
        """The same: this method has no strengths."""
        return self

    def detail(self, source: FloatArray) -> tuple[FloatArray, IntArray]:
        """The target's frames and its faces: this method has no finer mesh."""
        return self.frames(source), self._target.faces

    @cached_property
    def counterpart(self) -> IntArray:
        """(Vt,) source vertex nearest to each target vertex when the points of both faces are laid on one another."""
        source, target = self._source, self._target
        warp = fit_smooth_warp(self._points[1].positions(target.vertices), self._read, stiffness=1e-3)
        nearest: IntArray = cKDTree(source.vertices).query(warp.apply(target.vertices))[1].astype(np.int64)
        return nearest

    @cached_property
    def report(self) -> Mapping[str, Any]:
        """Figures of the fit, as plain data."""
        warnings = [*self._motion.warnings]
        if self._problem.source.examples:
            warnings.append("examples are not used by this method")
        moves = moved_vertices(self._motion.deformer) | self._eyes.turning()
        still, named = still_components(self._target, moves, self._motion.parts)
        warnings += named
        return {
            "source": {"vertices": len(self._source.vertices), "faces": len(self._source.faces)},
            "target": {"vertices": len(self._target.vertices), "faces": len(self._target.faces)},
            "points": len(self._points[0]),
            **self._motion.report,
            "still_components": still,
            "examples": [],
            "warnings": warnings,
        }


def fit(problem: Problem, settings: FeaturePointSettings, progress: Progress = no_progress) -> FeaturePointRetargeter:
    """Fit the feature-point method to a pair of faces.

    Raises
    ------
    RetargetError : if the faces have too few points in common, or points without MPEG-4 names.

    References
    ----------
    Kshirsagar, Garchery and Magnenat-Thalmann 2003.
    """
    names = common_names(problem.source.points, problem.target.points)
    progress(0.0, "finding what each point moves")
    pair = problem.source.points.subset(names), problem.target.points.subset(names)
    retargeter = FeaturePointRetargeter(problem, settings, pair)
    progress(1.0, "fitted")
    return retargeter


class _FapMotion:
    """Points to FAPs by the source's units, FAPs to the target by its own: what the standard can say, and no more."""

    def __init__(
        self,
        problem: Problem,
        source_points: FeaturePoints,
        target_points: FeaturePoints,
        settings: FeaturePointSettings,
    ) -> None:
        known = [name for name in source_points.names if name in FDPS]
        self._rows = source_points.index(known)
        places = source_points.subset(known).positions(problem.source.mesh.vertices)
        axes = head_axes(known, places)
        fapu = measure_fapu(known, places, axes)
        self._channels = PointChannels(known, places, axes, fapu)
        self._face: FapFace = fit_fap_face(
            problem.target.mesh, target_points, settings.variant, named=problem.target.named_parts
        )
        self.deformer = self._face.deformer
        self.warnings = self._face.report["warnings"]
        self.parts: list[dict[str, Any]] = self._face.report["parts"]
        self.report = {"fapu": {"source": fapu.taken, "target": self._face.fapu.taken}, "parts": self.parts}

    def frames(self, displacements: FloatArray) -> FloatArray:
        """Target positions (F, Vt, 3) of displacements (F, P, 3) of the source's points."""
        values = self._channels.values(displacements[:, self._rows])
        values[:, ONE_WAY] = np.maximum(values[:, ONE_WAY], 0.0)
        return self._face.frames(values)


class _FreeMotion:
    """Every point moves along all three axes, each in the units of its region; lids close as far as the source's do."""

    def __init__(
        self,
        problem: Problem,
        source_points: FeaturePoints,
        target_points: FeaturePoints,
        settings: FeaturePointSettings,
        turning: BoolArray,
    ) -> None:
        source, target, named = problem.source.mesh, problem.target.mesh, problem.target.named_parts
        names = source_points.names
        places = [source_points.positions(source.vertices), target_points.positions(target.vertices)]
        self._axes = [head_axes(names, there) for there in places]
        fapus = [measure_fapu(names, there, axes) for there, axes in zip(places, self._axes, strict=True)]
        lengths = point_lengths(names, places[0], fapus)
        self._scale = lengths[1] / lengths[0]
        acting = np.ones((len(names), 3), bool)
        self.deformer: PointDeformer = fit_deformer(
            target, target_points, self._axes[1], acting, settings.variant, named=named
        )
        self.parts: list[dict[str, Any]] = []
        if settings.variant == "default":
            self.deformer, self.parts = with_parts(target, target_points, self.deformer, turning, named)
        balls = find_eyeballs(source, source_points, self._axes[0], problem.source.named_parts)
        self._lids = _lid_pairs(source, source_points, balls, self.deformer.lids)
        self._neutral = target.vertices.astype(np.float32)
        self.warnings = list(self.deformer.warnings)
        self.report = {"fapu": {"source": fapus[0].taken, "target": fapus[1].taken}, "parts": self.parts}

    def frames(self, displacements: FloatArray) -> FloatArray:
        """Target positions (F, Vt, 3) of displacements (F, P, 3) of the source's points."""
        shut = []
        left = np.array(displacements, np.float64)
        for row, ours, _ in self._lids:
            shut.append(ours.shut(left[:, row]))
            left[:, row] -= shut[-1][:, None] * ours.gap
        sent = (left @ self._axes[0].T * self._scale) @ self._axes[1]
        for share, (row, _, theirs) in zip(shut, self._lids, strict=True):
            sent[:, row] += share[:, None] * theirs.gap
        return self._neutral + self.deformer.displacements(sent)


def _eye_turns(
    problem: Problem, points: tuple[FeaturePoints, FeaturePoints], settings: FeaturePointSettings
) -> EyeTurns:
    """The eyeballs that both faces have; the published variant leaves them where they are."""
    own = np.full(len(problem.target.mesh.vertices), settings.variant == "paper")
    heads = [
        know_head(replace(face, points=on_face))
        for face, on_face in zip((problem.source, problem.target), points, strict=True)
    ]
    return pair_eyeballs(heads[0], heads[1], own)


def _lid_pairs(
    source: TriMesh, points: FeaturePoints, eyeballs: Mapping[str, Eyeball], lids: tuple[Lid, ...]
) -> list[tuple[int, Lid, Lid]]:
    """The row of each lid's middle, and the lid on the source and on the target."""
    ours = {lid.middle: lid for lid in find_lids(source, points, eyeballs)}
    return [(int(points.index([lid.middle])[0]), ours[lid.middle], lid) for lid in lids if lid.middle in ours]
