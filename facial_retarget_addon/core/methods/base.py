"""What goes into a method and what comes out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, Protocol

from ..arrays import FloatArray, IntArray, Progress, no_progress
from ..errors import RetargetError
from ..mesh import TriMesh
from ..points import FeaturePoints
from ..raycast import CasterFactory, EmbreeCaster
from . import METHODS
from .settings import Settings


@dataclass(frozen=True, eq=False)
class Face:
    """A neutral face, its feature points, and the examples that it was given.

    examples : name -> (V, 3) positions of the same vertices.
    """

    mesh: TriMesh
    points: FeaturePoints
    examples: Mapping[str, FloatArray] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Problem:
    """A source face, a target face, and the base mesh if the artist made one.

    base : triangles over point names, counter-clockwise seen from outside; None to have one made.
    make_caster : makes what casts rays on a mesh: Embree, or Blender's BVHTree where no Embree wheel exists.
    """

    source: Face
    target: Face
    base: tuple[tuple[str, str, str], ...] | None = None
    make_caster: CasterFactory = EmbreeCaster


class Retargeter(Protocol):
    """A fitted method: the fast part."""

    @property
    def report(self) -> Mapping[str, Any]:
        """Figures of the fit, as plain data: piercing errors per level, coverage, scale, example fit, warnings."""
        ...

    @property
    def counterpart(self) -> IntArray:
        """(Vt,) source vertex nearest to each target vertex's counterpart, -1 where there is none."""
        ...

    def frames(self, source: FloatArray) -> FloatArray:
        """Target positions of source frames: (F, Vs, 3) -> (F, Vt, 3) float32, each in its own object's units."""
        ...

    def detail(self, source: FloatArray) -> tuple[FloatArray, IntArray]:
        """The fine mesh of source frames: positions (F, N, 3) float32, faces (M, 3)."""
        ...


def fit(method: str, problem: Problem, settings: Settings, progress: Progress = no_progress) -> Retargeter:
    """Fit a method to a pair of faces; slow, once per pair.

    Raises
    ------
    RetargetError : for an unknown method, or a problem that cannot be solved; says what to change.
    """
    if method not in METHODS:
        raise RetargetError(f"method {method!r} is unknown, expected one of {', '.join(METHODS)}")
    module = import_module(f".{method}", __package__)
    retargeter: Retargeter = module.fit(problem, settings, progress)
    return retargeter
