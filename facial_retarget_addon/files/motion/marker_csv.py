"""Marker tables as CSV: a column for each coordinate, named <marker>_x, <marker>.X, <marker>:x or <marker> X."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core.errors import RetargetError
from ...core.markers.take import MarkerTake
from .csv_table import CsvTable, read_csv_table
from .csv_times import rows_timing
from .marker_take import marker_take
from .number_rows import numbers


def read_marker_csv(path: Path, fps: float | None = None) -> MarkerTake:
    """Read a table of markers. A blank coordinate, or a frame that is left out, means that a marker was not seen.

    Parameters
    ----------
    fps : frames a second of a table that has no column of seconds and no line "fps, 60" before its header.

    Raises
    ------
    RetargetError : if the file cannot be read, a marker has not all three coordinates, a row is malformed, the rate is
        unknown or not believed, or more frames are missing than there are.
    """
    return table_markers(read_csv_table(path, "a CSV table of markers"), fps)


def has_markers(table: CsvTable) -> bool:
    """Whether any column is a coordinate of a marker."""
    return any(map(_coordinate, table.names))


def table_markers(table: CsvTable, fps: float | None = None) -> MarkerTake:
    """The take that a table holds; see `read_marker_csv`."""
    markers: dict[str, dict[str, int]] = {}
    for place, column in enumerate(table.names):
        found = _coordinate(column)
        if found and markers.setdefault(found[0], {}).setdefault(found[1], place) != place:
            raise RetargetError(f"{table.path} has the column {column!r:.60} twice")
    if not markers:
        raise RetargetError(f"{table.path} has no markers, expected columns such as chin_x, chin_y and chin_z")
    for name, axes in markers.items():
        if len(axes) < 3:
            missing = ", ".join(axis for axis in "xyz" if axis not in axes)
            raise RetargetError(f"{table.path}: marker {name!r:.60} has no column for {missing}")
    places = [axes[axis] for axes in markers.values() for axis in "xyz"]
    rows = [*table.rows()]
    if not rows:
        raise RetargetError(f"{table.path} has no frames")
    given = numbers(table.path, ((line, [cells[place] for place in places]) for line, cells in rows))
    rate, frames = rows_timing(table, rows, fps)
    positions = np.full((frames[-1] + 1, len(markers), 3), np.nan)
    positions[frames] = given.reshape(len(rows), -1, 3)
    return marker_take(table.path, rate, [*markers], positions, table.settings.get("units", ""))


def _coordinate(column: str) -> tuple[str, str] | None:
    """Marker and axis of a column, or None."""
    stem, axis = column[:-1], column[-1:].lower()
    marker = stem.rstrip().rstrip("_.:").rstrip()
    return (marker, axis) if marker and marker != stem and axis in ("x", "y", "z") else None
