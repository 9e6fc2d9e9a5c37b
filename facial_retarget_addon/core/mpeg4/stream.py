"""A take of Facial Animation Parameters, frame by frame."""

from __future__ import annotations

from dataclasses import dataclass

from ..arrays import BoolArray, FloatArray, IntArray


@dataclass(frozen=True, eq=False)
class FapStream:
    """FAPs over time, as a `.fap` file holds them.

    Attributes
    ----------
    name : of the take.
    fps : frames a second.
    values : (F, 68) float64, column n - 1 is FAP n; 0 where a frame does not use it. Columns 0 and 1 stay 0.
    used : (F, 68) which FAPs each frame states.
    viseme : (F, 4) int64: two selected visemes, their blend 0-63, whether the frame defines the viseme.
    expression : (F, 6) int64: expression and intensity 0-63 twice, neutral redefined, whether the frame defines it.
    """

    name: str
    fps: float
    values: FloatArray
    used: BoolArray
    viseme: IntArray
    expression: IntArray

    def __len__(self) -> int:
        return len(self.values)
