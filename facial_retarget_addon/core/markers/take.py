"""Optical markers: named points in space, frame by frame, with gaps."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import RetargetError


@dataclass(frozen=True, eq=False)
class MarkerTake:
    """Tracked markers over time.

    Attributes
    ----------
    name : of the take.
    fps : frames a second.
    names : (M,) unique marker names.
    positions : (F, M, 3) float64 in the file's units and axes, NaN where a marker was not seen.
    units : as the file states them, "" if it does not.
    """

    name: str
    fps: float
    names: tuple[str, ...]
    positions: FloatArray
    units: str = ""

    def __len__(self) -> int:
        return len(self.positions)

    def index(self, names: Iterable[str]) -> IntArray:
        """Row of each name; RetargetError names those that are missing."""
        row = {name: i for i, name in enumerate(self.names)}
        wanted = list(names)
        missing = [name for name in wanted if name not in row]
        if missing:
            raise RetargetError(f"markers {', '.join(map(repr, missing))} are not in the take {self.name!r}")
        return np.array([row[name] for name in wanted], np.int64)

    def subset(self, names: Iterable[str]) -> MarkerTake:
        """The markers of these names alone, each once, in this order."""
        once = tuple(dict.fromkeys(names))
        return replace(self, names=once, positions=self.positions[:, self.index(once)])
