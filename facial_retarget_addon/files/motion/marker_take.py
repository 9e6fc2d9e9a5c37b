"""What the readers of marker files share: the take that they make of names and positions."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ...core.arrays import FloatArray
from ...core.errors import RetargetError
from ...core.markers.take import MarkerTake
from .number_rows import LARGEST


def marker_take(path: Path, fps: float, names: Sequence[str], positions: FloatArray, units: str = "") -> MarkerTake:
    """A take named after its file, in which a marker without one coordinate was not seen at all.

    Parameters
    ----------
    names : of the M markers.
    positions : (F, M, 3), NaN where a coordinate is missing.

    Raises
    ------
    RetargetError : if there are no frames or no markers, a name is empty or appears twice, or a coordinate is larger
        than LARGEST.
    """
    if not names or not len(positions):
        raise RetargetError(
            f"{path} has {len(names)} markers and {len(positions)} frames, expected at least one of each"
        )
    seen: set[str] = set()
    for name in names:
        if not name or name in seen:
            raise RetargetError(f"{path}: marker {name!r:.60} appears twice or has no name, expected unique names")
        seen.add(name)
    if (np.abs(positions) > LARGEST).any():
        frame, marker, _ = np.argwhere(np.abs(positions) > LARGEST)[0]
        raise RetargetError(
            f"{path}: marker {names[marker]!r:.60} is farther than {LARGEST:g} away in frame {frame + 1}"
        )
    seen_whole = np.isfinite(positions).all(axis=2, keepdims=True)
    return MarkerTake(path.stem, fps, tuple(names), np.where(seen_whole, positions, np.nan), units)
