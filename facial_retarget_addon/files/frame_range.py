"""Which frames of a take are wanted: first, last and step, counted from 1."""

from __future__ import annotations

import re
from dataclasses import dataclass

from ..core.errors import RetargetError

_TEXT = re.compile(r"(\d{0,9}):(\d{0,9})(?::(\d{0,9}))?|(\d{1,9})")


@dataclass(frozen=True)
class FrameRange:
    """Frames of a take.

    Attributes
    ----------
    first : counted from 1.
    last : included; None for the take's last.
    step : every so many frames.
    """

    first: int = 1
    last: int | None = None
    step: int = 1

    @classmethod
    def of_text(cls, text: str) -> FrameRange:
        """Read FIRST:LAST or FIRST:LAST:STEP, each of them optional, or the number of one frame.

        Raises
        ------
        RetargetError : for anything else.
        """
        found = _TEXT.fullmatch(text.strip())
        if not found:
            raise RetargetError(f"frames are {text!r}, expected FIRST:LAST or FIRST:LAST:STEP, such as 1:200:10")
        first, last, step, single = found.groups()
        if single:
            first = last = single
        frames = cls(int(first or 1), int(last) if last else None, int(step or 1))
        if frames.first < 1 or frames.step < 1 or (frames.last is not None and frames.last < frames.first):
            raise RetargetError(f"frames are {text!r}, expected a first one from 1, a last one after it, a step from 1")
        return frames

    def __str__(self) -> str:
        step = f":{self.step}" if self.step > 1 else ""
        return f"{self.first}:{'' if self.last is None else self.last}{step}"

    @property
    def whole(self) -> bool:
        """Whether every frame of any take is among them."""
        return self == EVERY_FRAME

    def rows(self, count: int) -> slice:
        """Rows of these frames in a take of `count`; RetargetError if it has none or not all of them."""
        last = count if self.last is None else self.last
        if self.first > count or last > count:
            raise RetargetError(f"frames {self.first} to {last} are wanted, but the take has {count}")
        return slice(self.first - 1, last, self.step)


EVERY_FRAME = FrameRange()
