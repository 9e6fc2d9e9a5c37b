"""What a method learns from a problem's examples: read and checked, learned on a base, with figures for the report."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray
from ..binding import apply_matrix
from ..errors import RetargetError
from ..mesh import TriMesh
from ..points import FeaturePoints
from ..problem import Problem
from .residuals import ExamplePairs, ExampleRegions, ExampleResiduals

_STILL = 1e-6
"""Eye separations: an example whose base moves less is the neutral."""


class Example(NamedTuple):
    """An example's displacements: source (Vs, 3), target (Vt, 3)."""

    name: str
    source: FloatArray
    target: FloatArray


@dataclass(frozen=True, eq=False)
class SteeringBase:
    """The places on both faces whose motion tells which examples a frame is made of.

    Attributes
    ----------
    source, target : neutral meshes.
    source_points, target_points : (B,) the places.
    source_separation, target_separation : distance of the eyes, in each face's units.
    """

    source: TriMesh
    target: TriMesh
    source_points: FeaturePoints
    target_points: FeaturePoints
    source_separation: float
    target_separation: float

    def examples(self, problem: Problem) -> list[Example]:
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
            for which, positions, mesh in (("source", here[name], self.source), ("target", there[name], self.target)):
                if np.shape(positions) != mesh.vertices.shape:
                    raise RetargetError(
                        f"example {name!r} of the {which} has shape {np.shape(positions)}, "
                        f"expected {mesh.vertices.shape} like its neutral"
                    )
            example = Example(name, here[name] - self.source.vertices, there[name] - self.target.vertices)
            if self.tells(example.source):
                found.append(example)
            elif np.abs(example.target).max(initial=0.0) > _STILL * self.target_separation:
                raise RetargetError(
                    f"example {name!r} moves the target but not the source's feature points, expected motion on both"
                )
        return found

    def tells(self, displacement: FloatArray) -> bool:
        """Whether a displacement (Vs, 3) of the source moves its points."""
        moved = np.abs(self.source_points.positions(displacement)).max(initial=0.0)
        return bool(moved > _STILL * self.source_separation)

    @cached_property
    def regions(self) -> ExampleRegions:
        """What is the same for all examples."""
        return ExampleRegions(
            self.source_points.positions(self.source.vertices),
            self.source_separation,
            self.target_points.positions(self.target.vertices),
            self.target.vertices,
            self.target.vertex_areas,
            self.target_separation,
        )

    def moved(self, examples: list[Example]) -> BoolArray:
        """(Vt,) whether any example moves a vertex of the target."""
        own: BoolArray = np.zeros(len(self.target.vertices), bool)
        for example in examples:
            own |= np.abs(example.target).max(axis=1) > _STILL * self.target_separation
        return own

    def error(self, moved: FloatArray, wanted: FloatArray) -> float:
        """Norm of the error of displacements (Vt, 3) over the norm of the wanted ones, weighted by area."""
        areas = self.target.vertex_areas
        error, size = (float(areas @ np.square(values).sum(axis=1)) for values in (moved - wanted, wanted))
        return float(np.sqrt(error / size)) if size > 0 else 0.0


@dataclass(frozen=True, eq=False)
class Steering:
    """What the examples add to a plain motion.

    Attributes
    ----------
    base, examples, pairs, trust : what they were learned from.
    residuals : what was learned.
    rest : (Vs, 3) float32, the source's neutral. read : (B, Vs) csr float32, its values at the base.
    """

    base: SteeringBase
    examples: list[Example]
    pairs: ExamplePairs
    trust: float
    residuals: ExampleResiduals
    rest: FloatArray
    read: sp.csr_matrix

    def steer(self, carried: FloatArray, frames: FloatArray) -> FloatArray:
        """Displacements (F, Vt, 3) float32 for carried ones and the source's frames (F, Vs, 3) float32."""
        return self.residuals.steer(carried, apply_matrix(self.read, frames - self.rest))

    @cached_property
    def figures(self) -> list[dict[str, Any]]:
        """Per example, how well it is met, and how well the others foretell it."""
        figures = []
        for m, example in enumerate(self.examples):
            met = self.residuals.steer(self.pairs.carried[m : m + 1], self.pairs.base[m : m + 1])[0]
            figure: dict[str, Any] = {"name": example.name, "fit": self.base.error(met, example.target)}
            if len(self.examples) > 1:
                foretold = self.base.regions.leave_one_out(self.pairs, m, self.trust)
                figure["leave_one_out"] = self.base.error(foretold, example.target)
            figures.append(figure)
        return figures


def learn(
    base: SteeringBase, examples: list[Example], motion: Callable[[FloatArray], FloatArray], trust: float
) -> Steering | None:
    """Learn from examples; None where there is nothing to learn.

    Parameters
    ----------
    motion : the plain motion, source frames (F, Vs, 3) float32 to target displacements (F, Vt, 3) float32.
    trust : how far the examples steer, from 0 to 1.
    """
    if not examples or trust == 0:
        return None
    source = np.stack([example.source for example in examples])
    at_base = np.stack([base.source_points.positions(displacement) for displacement in source])
    carried = motion((base.source.vertices + source).astype(np.float32))
    pairs = ExamplePairs(at_base, carried, np.stack([example.target for example in examples]))
    rest = base.source.vertices.astype(np.float32)
    read = base.source_points.matrix(len(rest)).astype(np.float32)
    return Steering(base, examples, pairs, trust, base.regions.fit(pairs, trust), rest, read)
