"""Optical markers: named points in space, frame by frame, with gaps."""

from __future__ import annotations

from dataclasses import dataclass

from .arrays import FloatArray


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
