"""How long work will still take, told only where it is known. No bpy, no NumPy."""

from __future__ import annotations

from collections import deque

AFTER, SHARE = 2.0, 0.05
"""Seconds and share of the work before which nothing is said."""
RECENT = 0.3
"""Share of the time so far that counts as recent."""
AGREE = 2.0
"""The recent pace and that since the start may differ by this factor; else how long it takes is not known."""


class TimeLeft:
    """Watches the share done; `seconds` is what is left, 0 where it is not known.

    start : when the work began, in seconds.
    """

    def __init__(self, start: float) -> None:
        self.seconds = 0.0
        self._start = start
        self._seen: deque[tuple[float, float]] = deque([(start, 0.0)])

    def see(self, share: float, now: float) -> None:
        """Take note of the share done (0 to 1) at a time in seconds."""
        self._seen.append((now, share))
        recent = now - RECENT * (now - self._start)
        while len(self._seen) > 2 and self._seen[1][0] <= recent:
            self._seen.popleft()
        self.seconds = self._left(share, now)

    def _left(self, share: float, now: float) -> float:
        gone = now - self._start
        before, less = self._seen[0]
        if gone < AFTER or share < SHARE or share <= less:
            return 0.0
        overall = (1.0 - share) * gone / share
        lately = (1.0 - share) * (now - before) / (share - less)
        if max(overall, lately) > AGREE * min(overall, lately):
            return 0.0
        return 0.5 * (overall + lately)


def spoken(seconds: float) -> tuple[str, dict[str, int]]:
    """A time left as a text with {fields} and what fills them, coarse as it is no promise; "" where it is not known."""
    if seconds <= 0:
        return "", {}
    if seconds < 60:
        step = 1 if seconds < 10 else 5
        return "{seconds} s left", {"seconds": max(step * round(seconds / step), 1)}
    return "{minutes} min left", {"minutes": round(seconds / 60)}
