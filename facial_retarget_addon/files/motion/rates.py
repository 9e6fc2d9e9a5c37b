"""Frames a second: which are believed, and which the times of a recording tell."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core.arrays import FloatArray, IntArray
from ...core.errors import RetargetError

SLOWEST, FASTEST = 1.0, 10_000.0
"""Frames a second; anything else is a mistake."""
STANDARD_RATES = (
    24000 / 1001,
    24,
    25,
    30000 / 1001,
    30,
    48,
    50,
    60000 / 1001,
    60,
    72,
    90,
    100,
    120000 / 1001,
    120,
    240,
)
STANDARD_TOLERANCE = 1e-3
"""A measured rate that lies this near to a standard one is that one: cameras' clocks and rounded times miss it."""
CONTRADICTION = 0.02
"""Share by which the times of a file may differ from its stated rate."""


def checked_rate(path: Path, rate: float | str) -> float:
    """A rate that a file states; RetargetError if it is no number from SLOWEST to FASTEST."""
    try:
        fps = float(rate)
    except ValueError:
        fps = np.nan
    if not SLOWEST <= fps <= FASTEST:
        shown = rate if isinstance(rate, str) else f"{rate:g}"
        raise RetargetError(
            f"{path} has {shown[:40]!r} frames a second, expected a number from {SLOWEST:g} to {FASTEST:g}"
        )
    return fps


def measured_rate(path: Path, fps: float) -> float:
    """A rate that was measured on the times of a file: the standard one it stands for, or itself if there is none."""
    fps = checked_rate(path, fps)
    nearest = min(STANDARD_RATES, key=lambda rate: abs(rate - fps))
    return float(nearest) if abs(nearest - fps) <= STANDARD_TOLERANCE * fps else fps


def frames_of_times(path: Path, times: FloatArray, fps: float | None) -> tuple[float, IntArray]:
    """Rate and frame numbers of rows that have times and may leave frames out.

    Parameters
    ----------
    times : (N,) seconds, in the order of the rows.
    fps : frames a second of a single row, if somebody tells them.

    Returns
    -------
    Frames a second, and (N,) frame numbers from 0. The usual step between two rows (the median) is one frame.

    Raises
    ------
    RetargetError : if there are fewer than two rows and nobody tells the rate, or the times do not grow.
    """
    if len(times) == 1 and fps is not None:
        return checked_rate(path, fps), np.zeros(1, np.int64)
    if len(times) < 2:
        raise RetargetError(f"{path} has {len(times)} frames, expected at least two: their times tell the rate")
    steps = np.diff(times)
    check_growing(path, steps)
    usual = np.quantile(steps, 0.5, method="lower")
    numbers = np.concatenate([[0.0], np.cumsum(np.maximum(np.rint(steps / usual), 1))])
    check_gaps(path, numbers)
    return measured_rate(path, float(numbers[-1] / (times[-1] - times[0]))), numbers.astype(np.int64)


def check_growing(path: Path, steps: FloatArray) -> None:
    """RetargetError names the first frame whose time or number is not after the one before."""
    bad = np.flatnonzero(~((steps > 0) & (steps < np.inf)))
    if len(bad):
        raise RetargetError(
            f"{path}: the time of frame {bad[0] + 2} is not after the frame before, expected growing times"
        )


def check_gaps(path: Path, numbers: FloatArray) -> None:
    """RetargetError if more frames were left out, by their numbers from 0, than there are."""
    missing = numbers[-1] + 1 - len(numbers)
    if not missing <= len(numbers):
        raise RetargetError(
            f"{path}: {missing:.0f} frames are missing between {len(numbers)}, expected at most as many"
        )


def check_times(path: Path, fps: float, times: FloatArray) -> None:
    """RetargetError if times (N,), one a frame, contradict the rate that the same file states."""
    lasts, expected = float(times[-1] - times[0]), (len(times) - 1) / fps
    if not abs(lasts - expected) <= CONTRADICTION * expected + 0.5 / fps:
        raise RetargetError(
            f"{path} says {fps:g} frames a second, but its {len(times)} frames last {lasts:.6g} s by their times, "
            f"expected {expected:.6g} s"
        )
