"""Timecodes, HH:MM:SS:FF with fractions of a frame, as seconds and back."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...core.arrays import FloatArray
from ...core.errors import RetargetError

_FORM = re.compile(r"(\d{1,2}):(\d{1,2}):(\d{1,2})([:;])(\d{1,3}(?:\.\d{1,9})?)")
_HALF_A_DAY = 12 * 3600.0
_BASES = (24, 25, 30, 48, 50, 60, 90, 100, 120, 240)


@dataclass(frozen=True)
class Clock:
    """How the last field of a timecode counts.

    Attributes
    ----------
    base : its numbers in a second. It need not be the take's rate: a take of 30 frames a second may be written in
        steps of two by a clock of 60.
    drop : NTSC's drop-frame clock (a semicolon before the field), which leaves out the first base / 15 numbers of each
        minute but every tenth, and is slower by 1001 / 1000, so that it agrees with the clock on the wall.
    """

    base: int = 60
    drop: bool = False

    @property
    def dropped(self) -> int:
        """Numbers left out in a minute."""
        return self.base // 15 if self.drop else 0

    @property
    def rate(self) -> float:
        """Numbers in a true second."""
        return self.base / 1.001 if self.drop else float(self.base)

    def seconds(self, fields: FloatArray) -> FloatArray:
        """(N,) seconds of (N, 4) hours, minutes, seconds and the last field; the day may end in between."""
        minutes = fields[:, 0] * 60 + fields[:, 1]
        count = (minutes * 60 + fields[:, 2]) * self.base + fields[:, 3]
        count -= self.dropped * (minutes - minutes // 10)
        seconds = count / self.rate
        days = np.concatenate([[0], np.cumsum(np.diff(seconds) < -_HALF_A_DAY)])
        return seconds + days * 2 * _HALF_A_DAY

    def text(self, seconds: float) -> str:
        """The timecode of a time, to a thousandth of the last field."""
        whole, thousandths = divmod(round(seconds * self.rate * 1000), 1000)
        tens, rest = divmod(whole, 600 * self.base - 9 * self.dropped)
        minutes = 10 * tens
        if rest >= 60 * self.base:
            minutes += 1 + (rest - 60 * self.base) // (60 * self.base - self.dropped)
        label = whole + self.dropped * (minutes - minutes // 10)
        total, field = divmod(label, self.base)
        separator = ";" if self.drop else ":"
        return (
            f"{total // 3600 % 24:02d}:{total // 60 % 60:02d}:{total % 60:02d}{separator}{field:02d}.{thousandths:03d}"
        )


def timecode_seconds(path: Path, timecodes: Sequence[str]) -> tuple[FloatArray, Clock]:
    """Seconds (N,) of timecodes, and the clock that counts their last field.

    The clock is found where the seconds change: there the field starts again, after its last number. A take without
    such a place has a clock of 60, as Live Link Face writes it, or the next one that holds its largest number.

    Raises
    ------
    RetargetError : if one is no timecode.
    """
    found = [_FORM.fullmatch(text.strip()) for text in timecodes]
    bad = next((text for text, match in zip(timecodes, found, strict=True) if match is None), None)
    if bad is not None:
        raise RetargetError(f"{path} has the timecode {bad!r:.40}, expected hours:minutes:seconds:frames")
    matches = [match for match in found if match is not None]
    fields = np.array([[float(match[group]) for group in (1, 2, 3, 5)] for match in matches]).reshape(-1, 4)
    clock = Clock(_base(fields), any(match[4] == ";" for match in matches))
    return clock.seconds(fields), clock


def _base(fields: FloatArray) -> int:
    """How many numbers the last field has in a second."""
    largest = float(fields[:, 3].max(initial=0))
    possible = [base for base in _BASES if base > largest] or [int(largest) + 1]
    seconds, steps = np.diff(fields[:, 2]) % 60, np.diff(fields[:, 3])
    within = steps[(seconds == 0) & (steps > 0)]
    across = -steps[(seconds == 1) & (steps < 0)]
    if not len(within) or not len(across):
        return next((base for base in possible if base >= Clock.base), possible[-1])
    seen = float(np.median(across) + np.median(within))
    return min(possible, key=lambda base: abs(base - seen))
