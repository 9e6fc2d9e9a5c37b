"""Which rate the rows of a CSV table have, and which frames they leave out."""

from __future__ import annotations

import numpy as np

from ...core.arrays import FloatArray, IntArray
from ...core.errors import RetargetError
from .csv_table import CsvRow, CsvTable
from .number_rows import numbers
from .rates import CONTRADICTION, check_gaps, check_growing, checked_rate, frames_of_times

TIMES = ("time", "times", "timesec", "timeseconds", "timestamp", "seconds")
"""Names of a column of seconds, without what is no letter."""
FRAMES = ("frame", "frames", "framenumber", "frameno")
"""Names of a column that numbers the frames."""


def rows_timing(table: CsvTable, rows: list[CsvRow], fps: float | None) -> tuple[float, IntArray]:
    """Rate and frame numbers of rows: from a column of seconds, or else a stated rate and a column of numbers, if any.

    Parameters
    ----------
    fps : frames a second of a table that does not tell them.

    Returns
    -------
    Frames a second, and (N,) frame numbers from 0, growing.

    Raises
    ------
    RetargetError : if the rate is unknown or not believed, the table contradicts itself, times or numbers do not grow,
        or more frames are missing than there are.
    """
    stated = checked_rate(table.path, table.settings["fps"]) if "fps" in table.settings else None
    times = next((place for name, place in table.columns.items() if name in TIMES), None)
    if times is not None:
        rate, frames = frames_of_times(table.path, _column(table, rows, times), stated or fps)
        if stated is not None and abs(rate - stated) > CONTRADICTION * stated:
            raise RetargetError(f"{table.path} says {stated:g} frames a second, but its times are those of {rate:g}")
        return stated or rate, frames
    told = stated or fps
    if told is None:
        raise RetargetError(f"{table.path} has no times, expected a column of seconds or the frames a second")
    rate = checked_rate(table.path, told)
    numbered = next((place for name, place in table.columns.items() if name in FRAMES), None)
    if numbered is None:
        return rate, np.arange(len(rows))
    given = np.rint(_column(table, rows, numbered))
    check_growing(table.path, np.diff(given))
    check_gaps(table.path, given - given[0])
    return rate, (given - given[0]).astype(np.int64)


def _column(table: CsvTable, rows: list[CsvRow], place: int) -> FloatArray:
    """(N,) the numbers of a column."""
    return numbers(table.path, ((line, [cells[place]]) for line, cells in rows))
