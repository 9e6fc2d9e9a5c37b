"""Wavelet retargeting (Min and Jung 2005), on a base mesh spanned by feature points.

Both faces become meshes of the same subdivision connectivity, unless they are such meshes already. The source's
displacement splits into that of the base and the differences of the wavelet coefficients; the base's goes to the
target through the local frames of the two base meshes, the coefficients' level by level. `mode` says what becomes of
the details: `framed` turns and scales them with the target's surface, `paper` pastes them as published.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, Progress, no_progress, progress_part
from ..carry import LinearMotion, Motion
from ..curvature import frame_rotations
from ..level_retargeter import LevelRetargeter
from ..levels.butterfly import butterfly
from ..levels.level_gains import Strengths
from ..levels.vertex_neighbours import adjacency
from ..mesh import TriMesh
from ..pair import Pair, prepare_pair
from ..parts.carried_parts import carried_parts
from ..points import place_matrix
from ..problem import Problem
from ..rigid import Similarity, closest_rotations
from ..seams.lids import lid_seams
from ..steering.residuals import spread_matrix
from ..subdivided_pair import subdivided_pair
from ..wavelets.lifting import Wavelets, integral_wavelets, wavelets
from ..wavelets.motion import RidingMotion, WaveletMotion
from .settings import WaveletSettings

_SMOOTHING = 8
"""Rounds in which each base vertex's rotation takes the mean of those around it; the paper has none."""
_REACH = 0.35
"""Eye separations over which base rotations spread to the vertices between and beyond them."""


@dataclass(frozen=True, eq=False)
class Frames:
    """How motion goes from the source's base to the target's.

    scale : of lengths, target over source.
    rotations : (B, 3, 3) at the base vertices.
    """

    scale: float
    rotations: FloatArray


def fit(problem: Problem, settings: WaveletSettings, progress: Progress = no_progress) -> LevelRetargeter:
    """Fit the wavelet method to a pair of faces.

    Raises
    ------
    RetargetError : if the points do not span a base mesh, or the examples do not fit the faces; names what to change.

    References
    ----------
    Min and Jung 2005.
    """
    preparing = progress_part(progress, 0.0, 0.8)
    pair = subdivided_pair(problem, settings.levels, butterfly) or prepare_pair(
        problem, settings.levels, settings.base_points, preparing, butterfly
    )
    examples = pair.steering_base.examples(problem)
    progress(0.8, "making the wavelets")
    levels = _Levels(pair, settings)
    strengths = Strengths(tuple(settings.gain(level) for level in range(len(pair.steps) + 1)), settings.detail_scale)
    progress(0.9, "preparing the motion")
    # Parts that an example moves are left to the examples.
    parts = carried_parts(problem.source, problem.target, pair.steering_base.moved(examples))
    lids = None if settings.mode == "paper" else lid_seams(problem, levels.scaled_turns)
    retargeter = LevelRetargeter(pair, levels.motion, strengths, levels.fine_motion, parts, lids)
    retargeter.learn(examples, settings.example_strength)
    progress(1.0, "fitted")
    return retargeter


class _Levels:
    """What is the same for all strengths of the levels."""

    def __init__(self, pair: Pair, settings: WaveletSettings) -> None:
        self._pair, self._mode = pair, settings.mode
        self._read = _read_matrix(pair, settings.source_mesh)
        self._wavelets = _wavelets(pair, settings)
        self._frames = _frames(pair, self._wavelets, self._read, settings.mode == "paper")
        self._turns = _spread(pair, self._frames.rotations)
        ride = sp.diags(pair.binding.inside) @ pair.binding.matrix.astype(np.float64)
        self._ride = ride.tocsr()
        self._finer = (sp.diags(pair.binding.inside) @ pair.carry - ride @ self._read).tocsr()
        self._beyond = (sp.diags(1 - pair.binding.inside) @ pair.carry).tocsr()

    def fine_motion(self, strengths: Strengths) -> WaveletMotion:
        """Motion of the target's finest level."""
        base, *details = _on_levels(self._pair, self._frames.rotations)
        turns = [strengths.gains[0] * self._frames.scale * base]
        for gain, rotations in zip(strengths.gains[1:], details, strict=True):
            turns.append(gain * self._detail_scale * (rotations if self._mode == "framed" else _unturned(rotations)))
        return WaveletMotion(self._read, self._pair.source.vertices, self._wavelets, turns)

    def motion(self, strengths: Strengths) -> Motion:
        """Motion of the target's vertices."""
        beyond = self._linear(strengths.gains[0] * self._beyond, self._frames.scale, self._turns)
        finer_turns = self._turns if self._mode == "framed" else _unturned(self._turns)
        finer = self._linear(strengths.detail * self._finer, self._detail_scale, finer_turns)
        return RidingMotion(self.fine_motion(strengths), self._ride, (beyond, finer))

    @property
    def scaled_turns(self) -> FloatArray:
        """(Vt, 3, 3) what displacements of the source are on the target."""
        return self._frames.scale * self._turns

    @property
    def _detail_scale(self) -> float:
        return 1.0 if self._mode == "paper" else self._frames.scale

    def _linear(self, matrix: sp.csr_matrix, scale: float, turns: FloatArray) -> LinearMotion:
        return LinearMotion(matrix, self._pair.source.vertices, Similarity(scale, np.eye(3), np.zeros(3)), turns)


def _read_matrix(pair: Pair, source_mesh: str) -> sp.csr_matrix:
    """(N, Vs) csr: the source's vertices to its fine mesh."""
    if source_mesh == "matched":
        return pair.fine_carry
    finest = pair.source_normal.levels[-1]
    return place_matrix(pair.source.faces[finest.place_face], finest.place_weights, len(pair.source.vertices))


def _wavelets(pair: Pair, settings: WaveletSettings) -> Wavelets:
    faces, count = pair.base.faces, len(pair.base.names)
    if settings.lifting == "integral":
        return integral_wavelets(faces, count, pair.steps)
    return wavelets(faces, count, pair.steps, settings.disc)


def _frames(pair: Pair, bank: Wavelets, read: sp.csr_matrix, paper: bool) -> Frames:
    """Frames of the two base meshes, which are what analysis leaves of the fine ones."""
    source, target = (
        TriMesh(bank.analyse(fine)[0], pair.base.faces) for fine in (read @ pair.source.vertices, pair.finest.positions)
    )
    if paper:
        # The printed ratio of areas is one of squared lengths.
        scale = float(np.sqrt(target.area / source.area))
        return Frames(scale, frame_rotations(source, target, "taubin", agreement=None))
    rotations = frame_rotations(source, target)
    around = adjacency(source) + sp.eye(len(rotations))
    for _ in range(_SMOOTHING):
        rotations = _mean(around, rotations)
    return Frames(pair.similarity.scale, rotations)


def _on_levels(pair: Pair, rotations: FloatArray) -> list[FloatArray]:
    """Rotations (n, 3, 3) of the base vertices and of each level's new ones, by subdivision."""
    found = [rotations]
    for step in pair.steps:
        finer = _mean(step.matrix, rotations)
        found.append(finer[len(rotations) :])
        rotations = finer
    return found


def _spread(pair: Pair, rotations: FloatArray) -> FloatArray:
    """(Vt, 3, 3) rotations at the target's vertices."""
    return _mean(spread_matrix(pair.target.vertices, pair.target_base, _REACH * pair.target_separation), rotations)


def _mean(matrix: sp.csr_matrix, rotations: FloatArray) -> FloatArray:
    """Rotations closest to what a matrix makes of others."""
    return closest_rotations((matrix @ rotations.reshape(-1, 9)).reshape(-1, 3, 3))[0]


def _unturned(rotations: FloatArray) -> FloatArray:
    return np.broadcast_to(np.eye(3), rotations.shape)
