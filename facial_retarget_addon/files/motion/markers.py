"""Marker files of every format that is read, by suffix."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ...core.errors import RetargetError
from ...core.markers.take import MarkerTake
from .bvh import read_bvh
from .c3d_markers import read_c3d
from .marker_csv import read_marker_csv
from .trc import read_trc

READERS: dict[str, Callable[[Path], MarkerTake]] = {
    ".trc": read_trc,
    ".c3d": read_c3d,
    ".bvh": read_bvh,
    ".csv": read_marker_csv,
}
"""Suffix -> reader."""


def read_markers(path: Path) -> MarkerTake:
    """Read tracked markers from TRC, C3D, BVH or CSV.

    Raises
    ------
    RetargetError : if the suffix is another one, or as the reader of the format.
    """
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise RetargetError(
            f"markers {path} are a {path.suffix or 'file without a suffix'}, expected {', '.join(READERS)}"
        )
    return reader(path)
