"""What every method offers."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import Any, Protocol

from ..arrays import FloatArray, IntArray, Progress, no_progress
from ..errors import RetargetError
from ..problem import Problem
from . import METHODS
from .settings import Settings


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

    def adjusted(self, settings: Any) -> Retargeter:
        """The same fit with other strengths; all other settings of the method must be those of the fit."""
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
