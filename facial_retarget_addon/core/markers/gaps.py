"""Gaps in a take of markers: frames in which a marker was hidden from the cameras."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from scipy.interpolate import PchipInterpolator

from ..arrays import BoolArray, FloatArray, IntArray
from ..errors import RetargetError
from .take import MarkerTake

WAYS = ("fill", "refuse")

LONGEST = 0.5
"""Seconds that a marker may be hidden and still be filled in."""


def fill_gaps(take: MarkerTake, how: str = "fill", longest: float = LONGEST) -> tuple[MarkerTake, dict[str, Any]]:
    """The take with every marker in every frame, and what was made up for that.

    Inside a take a hidden marker follows a smooth curve through its seen places that never swings beyond them
    (piecewise cubic, monotone in each coordinate); before its first and after its last place it keeps still.

    Parameters
    ----------
    how : "fill", or "refuse" to refuse any gap.
    longest : seconds; a longer gap is refused.

    Returns
    -------
    The filled take, and a plain table: gaps, frames (places that were filled in), longest (seconds), longest_marker
    ("" where there was no gap), and markers (name -> number of its gaps).

    Raises
    ------
    RetargetError : if a marker is never seen, if a gap is too long or not wanted, or if `how` is unknown.

    References
    ----------
    Fritsch and Carlson 1980 for the curve.
    """
    if how not in WAYS:
        raise RetargetError(f"markers of {take.name!r}: gaps shall be {how!r}, expected one of {', '.join(WAYS)}")
    hidden = ~np.isfinite(take.positions).all(axis=2)
    _check_seen(take, hidden)
    markers, starts, stops = _gaps(hidden)
    if not len(markers):
        return take, {"gaps": 0, "frames": 0, "longest": 0.0, "longest_marker": "", "markers": {}}
    lengths = (stops - starts) / take.fps
    worst = int(np.argmax(lengths))
    longest_marker = take.names[markers[worst]]
    where = f"marker {longest_marker!r} is hidden for {lengths[worst]:.3g} s from frame {starts[worst] + 1}"
    if how == "refuse":
        raise RetargetError(f"markers of {take.name!r} have {len(markers)} gaps, expected none: {where}")
    if lengths[worst] > longest:
        raise RetargetError(f"markers of {take.name!r}: {where}, expected gaps of at most {longest:g} s")
    report = {
        "gaps": len(markers),
        "frames": int(hidden.sum()),
        "longest": float(lengths[worst]),
        "longest_marker": longest_marker,
        "markers": {take.names[marker]: int((markers == marker).sum()) for marker in np.unique(markers)},
    }
    return replace(take, positions=_filled(take.positions, hidden)), report


def _filled(positions: FloatArray, hidden: BoolArray) -> FloatArray:
    filled = positions.copy()
    frames = np.arange(len(positions))
    for marker in np.flatnonzero(hidden.any(axis=0)):
        gap, seen = hidden[:, marker], frames[~hidden[:, marker]]
        places = positions[seen, marker]
        if len(seen) == 1:
            filled[:, marker] = places
        else:
            filled[gap, marker] = PchipInterpolator(seen, places)(np.clip(frames[gap], seen[0], seen[-1]))
    return filled


def _gaps(hidden: BoolArray) -> tuple[IntArray, IntArray, IntArray]:
    """Marker, first frame and frame after the last of every run of hidden frames."""
    edges = np.diff(np.pad(hidden.T, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    markers, starts = np.nonzero(edges == 1)
    return markers, starts, np.nonzero(edges == -1)[1]


def _check_seen(take: MarkerTake, hidden: BoolArray) -> None:
    never = [name for name, away in zip(take.names, hidden.all(axis=0), strict=True) if away]
    if never:
        raise RetargetError(
            f"markers of {take.name!r}: {', '.join(map(repr, never[:6]))}{' and more' if len(never) > 6 else ''} "
            f"are never seen in {len(hidden)} frames; leave them out"
        )
