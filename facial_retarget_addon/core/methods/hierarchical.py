"""Hierarchical retargeting (Na and Jung 2004), on a base mesh spanned by feature points.

The plain carry takes the source's motion at the counterpart of each target vertex through the
similarity of the two heads; on the normal mesh it splits into levels, each with its strength. The
examples then steer it. `variant = "paper"` is the published method instead.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any, NamedTuple

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
from ..steering.rbf import MultiquadricMaps, fit_multiquadrics
from ..steering.residuals import ExamplePairs, ExampleRegions, ExampleResiduals
from .settings import HierarchicalSettings

_STILL = 1e-6
"""Eye separations: an example whose base moves less is the neutral."""
_MERGE = 1e-3
"""Eye separations: the paper's multiquadric centres closer than this are one."""


class Example(NamedTuple):
    """An example's displacements: source (Vs, 3), target (Vt, 3)."""

    name: str
    source: FloatArray
    target: FloatArray


class HierarchicalRetargeter:
    """A fitted pair of faces.

    Parameters
    ----------
    pair : the two faces.
    motion : of the target's vertices, before the examples.
    make_fine_motion : gives the motion of the target's finest level, made when it is first asked for.
    residuals : what the examples add; None without any.
    figures : of the examples, for the report.
    parts : what follows the skin, and the eyeballs; None for nothing.
    """

    def __init__(
        self,
        pair: Pair,
        motion: Motion,
        make_fine_motion: Callable[[], Motion],
        residuals: ExampleResiduals | None,
        figures: list[dict[str, Any]],
        parts: CarriedParts | None = None,
    ) -> None:
        self._pair, self._motion, self._make_fine_motion = pair, motion, make_fine_motion
        self._residuals, self._figures, self._parts = residuals, figures, parts
        self._source = pair.source.vertices.astype(np.float32)
        self._target = pair.target.vertices.astype(np.float32)
        self._base = pair.source_points.matrix(len(self._source)).astype(np.float32)

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
        if self._residuals is not None:
            carried = self._motion(frames)
            fine += apply_matrix(self._pair.fine_places.astype(np.float32), self._steered(frames, carried) - carried)
        fine += finest.positions.astype(np.float32)
        return fine, finest.faces

    @cached_property
    def _fine_motion(self) -> Motion:
        return self._make_fine_motion()

    def _steered(self, frames: FloatArray, carried: FloatArray) -> FloatArray:
        if self._residuals is None:
            return carried
        return self._residuals.steer(carried, apply_matrix(self._base, frames - self._source))

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
    examples = read_examples(problem, pair)
    progress(0.9, "preparing the motion")
    if settings.variant == "paper":
        retargeter = _paper(pair, settings, examples)
    else:
        retargeter = _default(pair, settings, examples, _parts(problem, pair, examples))
    progress(1.0, "fitted")
    return retargeter


def read_examples(problem: Problem, pair: Pair) -> list[Example]:
    """The problem's examples as displacements, without those that are the neutral on both faces.

    Raises
    ------
    RetargetError : for an example on one face only, of another vertex count, or that moves the target alone.
    """
    here, there = problem.source.examples, problem.target.examples
    found = []
    for name in [*here, *(name for name in there if name not in here)]:
        if name not in here or name not in there:
            missing = "source" if name not in here else "target"
            raise RetargetError(f"example {name!r} is missing on the {missing}, expected one on each face")
        for which, positions, mesh in (("source", here[name], pair.source), ("target", there[name], pair.target)):
            if np.shape(positions) != mesh.vertices.shape:
                raise RetargetError(
                    f"example {name!r} of the {which} has shape {np.shape(positions)}, "
                    f"expected {mesh.vertices.shape} like its neutral"
                )
        example = Example(name, here[name] - pair.source.vertices, there[name] - pair.target.vertices)
        base_motion = np.abs(pair.source_points.positions(example.source)).max(initial=0.0)
        if base_motion > _STILL * pair.source_separation:
            found.append(example)
        elif np.abs(example.target).max(initial=0.0) > _STILL * pair.target_separation:
            raise RetargetError(
                f"example {name!r} moves the target but not the source's feature points, expected motion on both"
            )
    return found


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
    residuals, figures = _steering(pair, examples, motion, settings.example_strength)
    return HierarchicalRetargeter(pair, motion, fine_motion, residuals, figures, parts)


def _parts(problem: Problem, pair: Pair, examples: list[Example]) -> CarriedParts:
    """What follows the target's skin, and its eyeballs; parts that an example moves are left to the examples."""
    own = np.zeros(len(pair.target.vertices), bool)
    for example in examples:
        own |= np.abs(example.target).max(axis=1) > _STILL * pair.target_separation
    return carried_parts(problem.source, problem.target, own)


def _steering(
    pair: Pair, examples: list[Example], motion: Motion, trust: float
) -> tuple[ExampleResiduals | None, list[dict[str, Any]]]:
    """What the examples add to a motion, and how well they are met."""
    if not examples or trust == 0:
        return None, []
    source = np.stack([example.source for example in examples])
    base = np.stack([pair.source_points.positions(displacement) for displacement in source])
    carried = motion((pair.source.vertices + source).astype(np.float32))
    pairs = ExamplePairs(base, carried, np.stack([example.target for example in examples]))
    regions = ExampleRegions(
        pair.source_base,
        pair.source_separation,
        pair.target_base,
        pair.target.vertices,
        pair.target.vertex_areas,
        pair.target_separation,
    )
    residuals = regions.fit(pairs, trust)
    figures = []
    for m, example in enumerate(examples):
        met = residuals.steer(carried[m : m + 1], base[m : m + 1])[0]
        figure = {"name": example.name, "fit": _relative_error(pair, met, example.target)}
        if len(examples) > 1:
            figure["leave_one_out"] = _relative_error(pair, regions.leave_one_out(pairs, m, trust), example.target)
        figures.append(figure)
    return residuals, figures


# ---- the published variant ----------------------------------------------------------------------


def _paper(pair: Pair, settings: HierarchicalSettings, examples: list[Example]) -> HierarchicalRetargeter:
    gains = [settings.gain(level) for level in range(settings.levels + 1)]
    reader = pair.reader(settings.read == "pierce")
    paper = PaperMotion(reader, _base_maps(pair, examples), pair.source_normal, pair.target_normal, gains)
    motion = BlendedMotion(paper, pair.binding, pair.linear_motion(pair.carry, pair.target.vertices, local=False))
    figures = []
    for example in examples:
        moved = motion((pair.source.vertices + example.source).astype(np.float32)[None])[0]
        figures.append({"name": example.name, "fit": _relative_error(pair, moved, example.target)})
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


def _relative_error(pair: Pair, moved: FloatArray, wanted: FloatArray) -> float:
    """Norm of the error over the norm of the wanted motion, weighted by area."""
    areas = pair.target.vertex_areas
    error, size = (float(areas @ np.square(values).sum(axis=1)) for values in (moved - wanted, wanted))
    return float(np.sqrt(error / size)) if size > 0 else 0.0
