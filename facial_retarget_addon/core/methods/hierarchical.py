"""Hierarchical retargeting (Na and Jung 2004), on a base mesh spanned by feature points.

The plain carry takes the source's motion at the counterpart of each target vertex through the
similarity of the two heads; on the normal mesh it splits into levels, each with its strength. The
examples then steer it. `variant = "paper"` is the published method instead.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays import FloatArray, IntArray, Progress, no_progress
from ..binding import apply_matrix
from ..carry import BlendedMotion, Motion, PiercedMotion
from ..errors import RetargetError
from ..levels.level_gains import scale_fine, scale_levels
from ..pair import Pair, prepare_pair
from ..paper_motion import PaperMotion
from ..parts.carried_parts import CarriedParts, carried_parts
from ..parts.report import still_components
from ..problem import Problem
from ..steering.learned import Example, Steering, learn
from ..steering.rbf import MultiquadricMaps, fit_multiquadrics
from .settings import HierarchicalSettings

_MERGE = 1e-3
"""Eye separations: the paper's multiquadric centres closer than this are one."""


class HierarchicalRetargeter:
    """A fitted pair of faces.

    Parameters
    ----------
    pair : the two faces.
    motion : of the target's vertices, before the examples.
    make_fine_motion : gives the motion of the target's finest level, made when it is first asked for.
    steering : what the examples add; None without any.
    figures : of the examples, for the report.
    parts : what follows the skin, and the eyeballs; None for nothing.
    """

    def __init__(
        self,
        pair: Pair,
        motion: Motion,
        make_fine_motion: Callable[[], Motion],
        steering: Steering | None,
        figures: list[dict[str, Any]],
        parts: CarriedParts | None = None,
    ) -> None:
        self._pair, self._motion, self._make_fine_motion = pair, motion, make_fine_motion
        self._steering, self._figures, self._parts = steering, figures, parts
        self._source = pair.source.vertices.astype(np.float32)
        self._target = pair.target.vertices.astype(np.float32)

    @cached_property
    def report(self) -> Mapping[str, Any]:
        """Figures of the fit, as plain data."""
        report = self._pair.report()
        moves = self._pair.correspondence.face >= 0
        rows: list[dict[str, Any]] = []
        if self._parts is not None:
            moves |= self._parts.moves
            rows = self._parts.rows
        still, named = still_components(self._pair.target, moves)
        return {
            **report,
            "parts": rows,
            "still_components": still,
            "examples": self._figures,
            "warnings": report["warnings"] + named,
        }

    @property
    def counterpart(self) -> IntArray:
        """(Vt,) nearest source vertex of each target vertex's counterpart, -1 for none."""
        return self._pair.counterpart

    def frames(self, source: FloatArray) -> FloatArray:
        """Target positions (F, Vt, 3) float32 of source frames (F, Vs, 3)."""
        frames = self._checked(source)
        moved = self._steered(frames, self._motion(frames))
        if self._parts is not None:
            moved = self._parts.add_to(moved, frames)
        moved += self._target
        return moved

    def detail(self, source: FloatArray) -> tuple[FloatArray, IntArray]:
        """The finest normal mesh of source frames (F, Vs, 3): positions (F, N, 3) float32, faces (M, 3)."""
        frames, finest = self._checked(source), self._pair.finest
        fine = self._fine_motion(frames)
        if self._steering is not None:
            carried = self._motion(frames)
            fine += apply_matrix(self._pair.fine_places.astype(np.float32), self._steered(frames, carried) - carried)
        fine += finest.positions.astype(np.float32)
        return fine, finest.faces

    @cached_property
    def _fine_motion(self) -> Motion:
        return self._make_fine_motion()

    def _steered(self, frames: FloatArray, carried: FloatArray) -> FloatArray:
        return carried if self._steering is None else self._steering.steer(carried, frames)

    def _checked(self, source: FloatArray) -> FloatArray:
        if source.ndim != 3 or source.shape[1:] != self._source.shape:
            raise RetargetError(f"source frames have shape {source.shape}, expected (F, {len(self._source)}, 3)")
        return np.asarray(source, np.float32)


def fit(problem: Problem, settings: HierarchicalSettings, progress: Progress = no_progress) -> HierarchicalRetargeter:
    """Fit the hierarchical method to a pair of faces.

    Raises
    ------
    RetargetError : if the points do not span a base mesh, or the examples do not fit the faces; names what to change.

    References
    ----------
    Na and Jung 2004, sections 3 and 4.
    """
    pair = prepare_pair(problem, settings.levels, settings.base_points, lambda share, what: progress(0.9 * share, what))
    examples = pair.steering_base.examples(problem)
    progress(0.9, "preparing the motion")
    if settings.variant == "paper":
        retargeter = _paper(pair, settings, examples)
    else:
        # Parts that an example moves are left to the examples.
        parts = carried_parts(problem.source, problem.target, pair.steering_base.moved(examples))
        retargeter = _default(pair, settings, examples, parts)
    progress(1.0, "fitted")
    return retargeter


# ---- the default variant ------------------------------------------------------------------------


def _default(
    pair: Pair, settings: HierarchicalSettings, examples: list[Example], parts: CarriedParts
) -> HierarchicalRetargeter:
    gains = [settings.gain(level) for level in range(settings.levels + 1)]
    local = settings.frames == "local"
    matrix = pair.carry
    if settings.detail_scale != 1.0 or any(gain != 1.0 for gain in gains):
        ride, inside = pair.binding.matrix, pair.binding.inside
        matrix = scale_levels(matrix, pair.fine_carry, ride, inside, pair.steps, gains, settings.detail_scale)
    motion: Motion = pair.linear_motion(matrix, pair.target.vertices, local)

    def fine_motion() -> Motion:
        places = pair.finest.positions
        if settings.read == "track":
            return pair.linear_motion(scale_fine(pair.fine_carry, pair.steps, gains), places, local)
        turns = pair.turns(places) if local else None
        return PiercedMotion(pair.reader(pierce=True), pair.source_normal, gains, pair.similarity, turns)

    if settings.read == "pierce":
        motion = BlendedMotion(fine_motion(), pair.binding, motion)
    steering = learn(pair.steering_base, examples, motion, settings.example_strength)
    figures = [] if steering is None else steering.figures
    return HierarchicalRetargeter(pair, motion, fine_motion, steering, figures, parts)


# ---- the published variant ----------------------------------------------------------------------


def _paper(pair: Pair, settings: HierarchicalSettings, examples: list[Example]) -> HierarchicalRetargeter:
    gains = [settings.gain(level) for level in range(settings.levels + 1)]
    reader = pair.reader(settings.read == "pierce")
    paper = PaperMotion(reader, _base_maps(pair, examples), pair.source_normal, pair.target_normal, gains)
    motion = BlendedMotion(paper, pair.binding, pair.linear_motion(pair.carry, pair.target.vertices, local=False))
    figures = []
    for example in examples:
        moved = motion((pair.source.vertices + example.source).astype(np.float32)[None])[0]
        figures.append({"name": example.name, "fit": pair.steering_base.error(moved, example.target)})
    return HierarchicalRetargeter(pair, motion, lambda: paper, None, figures)


def _base_maps(pair: Pair, examples: list[Example]) -> MultiquadricMaps:
    """Equations (3) and (4) for every base vertex, with neutral among the centres."""
    rotation = pair.similarity.rotation
    centres, values = [np.zeros_like(pair.source_base)], [np.zeros_like(pair.target_base)]
    for example in examples:
        centres.append(pair.source_points.positions(example.source))
        # The maps work in the source's orientation; the heads' rotation follows.
        values.append(pair.target_points.positions(example.target) @ rotation)
    maps = fit_multiquadrics(
        np.stack(centres, axis=1),
        np.stack(values, axis=1),
        _MERGE * pair.source_separation,
        pair.similarity.scale,
        linear=False,
    )
    return maps.turned(rotation)
