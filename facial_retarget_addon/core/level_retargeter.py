"""A fitted pair of faces whose motion is made of levels: what the multiresolution methods hand back."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import copy
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray
from .binding import apply_matrix
from .carry import Motion
from .errors import RetargetError
from .levels.level_gains import Strengths
from .methods.settings import LevelSettings
from .pair import Pair
from .parts.carried_parts import CarriedParts
from .parts.report import still_components
from .seams.lids import LidSeams
from .steering.learned import Example, Steering, learn


class LevelMotion(NamedTuple):
    """What one level adds to the target's motion: displacements (F, Vt, 3)."""

    name: str
    displacements: FloatArray


LevelsOf = Callable[[FloatArray], list[LevelMotion]]
"""Takes source frames (F, Vs, 3); see `LevelRetargeter.levels`."""


class LevelRetargeter:
    """A fitted pair of faces.

    Parameters
    ----------
    pair : the two faces.
    make_motion : gives the motion of the target's vertices, before the examples, for strengths of its levels.
    strengths : the settings'.
    make_fine_motion : gives the motion of the target's finest level for strengths of its levels.
    parts : what follows the skin, and the eyeballs; None for nothing.
    lids : close the motion's lids as far as the source's; None to leave them as they are carried. Their correction
        counts as motion of the base.
    """

    def __init__(
        self,
        pair: Pair,
        make_motion: Callable[[Strengths], Motion],
        strengths: Strengths,
        make_fine_motion: Callable[[Strengths], Motion],
        parts: CarriedParts | None = None,
        lids: LidSeams | None = None,
    ) -> None:
        self._pair, self._make_motion, self._strengths = pair, make_motion, strengths
        self._make_fine_motion, self._parts = make_fine_motion, parts
        self._lids = lids if lids is not None and lids.sides else None
        self._carried = make_motion(strengths)
        self._whole = self._carried if strengths.plain else make_motion(strengths.whole)
        self._steering: Steering | None = None
        self._examples: list[Example] = []
        self._measured: list[Example] = []
        self._source = pair.source.vertices.astype(np.float32)
        self._target = pair.target.vertices.astype(np.float32)

    def learn(self, examples: list[Example], trust: float) -> None:
        """Let examples steer the motion, from 0 (not at all) to 1."""
        self._examples = examples
        self._steering = learn(self._pair.steering_base, examples, self.plain, trust)

    def measure(self, examples: list[Example]) -> None:
        """Report how well the motion meets examples that it already comes from."""
        self._measured = examples

    def adjusted(self, settings: LevelSettings) -> LevelRetargeter:
        """The same fit with other strengths of the levels, the detail and the examples."""
        gains = tuple(settings.gain(level) for level in range(len(self._strengths.gains)))
        again = copy(self)
        for made in ("report", "_up_to_each_level", "_fine_motion"):
            again.__dict__.pop(made, None)
        again._strengths = Strengths(gains, settings.detail_scale)
        if again._strengths != self._strengths:
            again._carried = self._whole if again._strengths.plain else self._make_motion(again._strengths)
        again.learn(self._examples, settings.example_strength)
        return again

    def plain(self, frames: FloatArray) -> FloatArray:
        """Displacements (F, Vt, 3) of frames (F, Vs, 3) float32, without examples and parts."""
        return self._shut(self._carried(frames), frames)

    def prepare_levels(self) -> None:
        """Make now what other strengths will need, so that they act at once."""
        self._make_motion(self._strengths.up_to(1))

    @property
    def _figures(self) -> list[dict[str, Any]]:
        """How well each example is met, and how well the others foretell it."""
        if self._steering is not None:
            return self._steering.figures
        base, rest = self._pair.steering_base, self._pair.source.vertices
        moved = (self.plain((rest + example.source).astype(np.float32)[None])[0] for example in self._measured)
        return [
            {"name": example.name, "fit": base.error(there, example.target)}
            for example, there in zip(self._measured, moved, strict=False)
        ]

    @cached_property
    def report(self) -> Mapping[str, Any]:
        """Figures of the fit, as plain data."""
        report = self._pair.report()
        moves = self._pair.correspondence.face >= 0
        rows: list[dict[str, Any]] = []
        if self._parts is not None:
            moves |= self._parts.moves
            rows = self._parts.rows
        still, named = still_components(self._pair.target, moves, rows)
        return {
            **report,
            "parts": rows,
            "still_components": still,
            "lids": [] if self._lids is None else list(self._lids.sides),
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
        moved = self._with_parts(self._steered(frames, self.plain(frames)), frames)
        moved += self._target
        return moved

    def detail(self, source: FloatArray) -> tuple[FloatArray, IntArray]:
        """The finest mesh of source frames (F, Vs, 3): positions (F, N, 3) float32, faces (M, 3)."""
        frames, finest = self._checked(source), self._pair.finest
        fine = self._fine_motion(frames)
        if self._steering is not None or self._lids is not None:
            carried = self._carried(frames)
            added = self._steered(frames, self._shut(carried.copy(), frames)) - carried
            fine += apply_matrix(self._pair.fine_places.astype(np.float32), added)
        fine += finest.positions.astype(np.float32)
        return fine, finest.faces

    def at_finest(self, values: FloatArray) -> FloatArray:
        """Values of the target's vertices (Vt,) at the vertices of the finest mesh (N,)."""
        fine: FloatArray = self._pair.fine_places @ values
        return fine

    @property
    def skin(self) -> BoolArray:
        """(Vt,) target vertices of the components that the finest mesh lies on: not eyes, teeth or lashes."""
        components = self._pair.target.components
        shown: BoolArray = np.isin(components, components[np.unique(self._pair.fine_places.indices)])
        return shown

    def level_faces(self, level: int) -> IntArray:
        """Faces (M, 3) of a level, 1 the coarsest; its vertices are the first ones of the finest mesh.

        Raises
        ------
        RetargetError : if there is no such level.
        """
        steps = self._pair.steps
        if not 1 <= level <= len(steps):
            raise RetargetError(f"level {level} was asked for, and the method has levels 1 to {len(steps)}")
        return steps[level - 1].faces

    def levels(self, source: FloatArray) -> list[LevelMotion]:
        """What the base, each level, the detail and the examples add to the motion of source frames (F, Vs, 3).

        They add up to what `frames` returns, minus the target's neutral.
        """
        frames = self._checked(source)
        names = ["base", *(f"level {k}" for k in range(1, len(self._strengths.gains))), "detail"]
        moves = [motion(frames) for motion in self._up_to_each_level]
        if self._lids is not None:
            missed = self._missed_at_lids(self._whole(frames), frames)
            moves = [self._lids.add(moved, missed) for moved in moves]
        wholes = [self._with_parts(moved, frames) for moved in moves]
        if self._steering is not None:
            names.append("examples")
            wholes.append(self._with_parts(self._steered(frames, self.plain(frames)), frames))
        before = [np.zeros_like(wholes[0]), *wholes[:-1]]
        return [LevelMotion(name, now - then) for name, now, then in zip(names, wholes, before, strict=True)]

    @cached_property
    def _up_to_each_level(self) -> list[Motion]:
        """Motion of the base alone, of the base and level 1, and so on, at last with the detail; lids as carried."""
        counts = range(1, len(self._strengths.gains) + 1)
        return [*(self._make_motion(self._strengths.up_to(count)) for count in counts), self._carried]

    @cached_property
    def _fine_motion(self) -> Motion:
        return self._make_fine_motion(self._strengths)

    def _shut(self, carried: FloatArray, frames: FloatArray) -> FloatArray:
        """The carried motion of frames, in place, with its lids as far shut as the source's."""
        if self._lids is None:
            return carried
        whole = carried if self._carried is self._whole else self._whole(frames)
        return self._lids.add(carried, self._missed_at_lids(whole, frames))

    def _missed_at_lids(self, whole: FloatArray, frames: FloatArray) -> FloatArray:
        """What the motion at full strength misses at the lids' guides, as strong as the base's motion."""
        assert self._lids is not None
        return np.float32(self._strengths.gains[0]) * self._lids.missed(whole, frames - self._source)

    def _steered(self, frames: FloatArray, carried: FloatArray) -> FloatArray:
        return carried if self._steering is None else self._steering.steer(carried, frames)

    def _with_parts(self, moved: FloatArray, frames: FloatArray) -> FloatArray:
        return moved if self._parts is None else self._parts.add_to(moved, frames)

    def _checked(self, source: FloatArray) -> FloatArray:
        if source.ndim != 3 or source.shape[1:] != self._source.shape:
            raise RetargetError(f"source frames have shape {source.shape}, expected (F, {len(self._source)}, 3)")
        return np.asarray(source, np.float32)
