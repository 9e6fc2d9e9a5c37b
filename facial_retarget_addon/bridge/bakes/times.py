"""The scene frames that are read and baked, with parts of frames between them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ...core.errors import RetargetError


class FrameTimes(Sequence[float]):
    """Scene frames at equal steps.

    Parameters
    ----------
    first, last : whole frames; the last one is met or passed by less than a step.
    step : frames between two of them; below 1 for sub-frames.

    Raises
    ------
    RetargetError : if the range is empty.
    """

    def __init__(self, first: int, last: int, step: float = 1.0) -> None:
        if last < first:
            raise RetargetError(f"the frame range ends at {last} before it starts at {first}")
        self.first, self.step = first, step
        self._count = int((last - first) / step + 1e-6) + 1

    def __len__(self) -> int:
        return self._count

    def __getitem__(self, row: int) -> float:
        """The scene frame of a row; whole ones are whole numbers."""
        if not -self._count <= row < self._count:
            raise IndexError(row)
        time = round(self.first + (row % self._count) * self.step, 4)
        return int(time) if time == int(time) else time

    def __iter__(self) -> Iterator[float]:
        return (self[row] for row in range(self._count))
