"""ARKit face weights as CSV: what Live Link Face records, and plain tables of the 52 weights."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Literal

import numpy as np

from ...core.arrays import FloatArray, IntArray
from ...core.errors import RetargetError
from ...core.mpeg4.arkit import ARKIT
from ...core.mpeg4.arkit_take import ArkitTake
from ..documents import MOST_FAULTS
from ..whole import write_whole
from .csv_table import CsvRow, CsvTable, letters, read_csv_table
from .csv_times import rows_timing
from .number_rows import numbers
from .rates import checked_rate, frames_of_times
from .timecode import Clock, timecode_seconds

Gaps = Literal["fill", "keep"]
"""What happens where a recording left frames out: straight lines between its neighbours, or nothing."""

WEIGHTS = tuple(name[0].upper() + name[1:] for name in ARKIT)
"""The 52 weights as Live Link Face spells and orders them."""
HEAD = ("HeadYaw", "HeadPitch", "HeadRoll")
EYES = ("LeftEyeYaw", "LeftEyePitch", "LeftEyeRoll", "RightEyeYaw", "RightEyePitch", "RightEyeRoll")
LARGEST_WEIGHT = 2.0
"""ARKit's weights go to 1 and a little beyond; larger ones were recorded in another unit, such as percent."""


def read_arkit_csv(path: Path, fps: float | None = None, gaps: Gaps = "fill") -> ArkitTake:
    """Read face weights: a Live Link Face recording, or any table with the 52 names, in any order and spelling of case.

    Times come from the timecodes, or else a column of seconds, or else `fps`. Where they tell that frames were left
    out, or a row has no weights because the face was out of sight, the missing frames lie on a straight line between
    their neighbours, so that the take stays in step with its sound and video; the take names them.

    Parameters
    ----------
    fps : frames a second of a table that has no times; other tables know it.
    gaps : "keep" takes the rows as they are, one after the other.

    Raises
    ------
    RetargetError : if the file cannot be read, names of weights are missing, a row is malformed, a weight is out of
        range, the rate is unknown or not believed, or more frames are missing than there are.
    """
    return arkit_take(read_csv_table(path, "an ARKit CSV table"), fps, gaps)


def has_arkit_names(table: CsvTable) -> bool:
    """Whether any column holds an ARKit weight."""
    return not table.columns.keys().isdisjoint(map(letters, WEIGHTS))


def arkit_take(table: CsvTable, fps: float | None = None, gaps: Gaps = "fill") -> ArkitTake:
    """The take that a table holds; see `read_arkit_csv`."""
    places = _places(table)
    weighted = [places[name] for name in WEIGHTS]
    rows = [(line, cells) for line, cells in table.rows() if any(cells[place].strip() for place in weighted)]
    if not rows:
        raise RetargetError(f"{table.path} has no frames")
    values = numbers(table.path, ((line, [cells[place] for place in places.values()]) for line, cells in rows))
    values = values.reshape(len(rows), len(places))
    _check_values(table.path, [line for line, _ in rows], values)
    rate, frames, timecodes = _timing(table, rows, fps)
    missing = np.setdiff1d(np.arange(frames[-1] + 1), frames) if gaps == "fill" else np.empty(0, np.int64)
    if len(missing):
        values = _filled(frames, missing, values)
        timecodes = timecodes and _filled_timecodes(table.path, frames, missing, timecodes)
    columns = dict(zip(places, values.T, strict=True))
    return ArkitTake(
        name=table.path.stem,
        fps=rate,
        weights=values[:, : len(WEIGHTS)],
        head=np.stack([columns[name] for name in HEAD], axis=1) if HEAD[0] in columns else None,
        eyes=np.stack([columns[name] for name in EYES], axis=1) if EYES[0] in columns else None,
        timecodes=timecodes,
        filled=tuple(missing.tolist()),
    )


def write_arkit_csv(take: ArkitTake, path: Path) -> None:
    """Write a take as Live Link Face does, whole or not at all: 61 columns, ten decimals.

    Rotations that the take does not have are 0. A take without timecodes starts at 0.

    Raises
    ------
    RetargetError : if it has no frames or a number that is not finite, or the system refuses.
    """
    count = len(take)
    head = np.zeros((count, len(HEAD))) if take.head is None else take.head
    eyes = np.zeros((count, len(EYES))) if take.eyes is None else take.eyes
    values = np.concatenate([take.weights, head, eyes], axis=1)
    if not count or not np.isfinite(values).all():
        raise RetargetError(f"{path} cannot be written: the take has no frames, or a number that is not finite")
    columns = (*WEIGHTS, *HEAD, *EYES)
    pattern = f"%s,{len(columns)}" + ",%.10f" * len(columns)
    fps = checked_rate(path, take.fps)
    timecodes = take.timecodes or [Clock().text(frame / fps) for frame in range(count)]
    rows = zip(timecodes, values.tolist(), strict=True)
    text = [",".join(("Timecode", "BlendShapeCount", *columns)), *(pattern % (code, *row) for code, row in rows), ""]
    write_whole(path, "\n".join(text).encode())


def _places(table: CsvTable) -> dict[str, int]:
    """Column of each weight, then of the rotations that the table has; of the head's and the eyes' all or none."""
    if not has_arkit_names(table):
        raise RetargetError(f"{table.path} is no ARKit CSV: none of its columns is named like one of the 52 weights")
    rotations = [part for part in (HEAD, EYES) if any(letters(name) in table.columns for name in part)]
    wanted = [name for part in (WEIGHTS, *rotations) for name in part]
    absent = [name for name in wanted if letters(name) not in table.columns]
    if absent:
        more = f" and {len(absent) - MOST_FAULTS} more" if len(absent) > MOST_FAULTS else ""
        raise RetargetError(f"{table.path} has no column {', '.join(absent[:MOST_FAULTS])}{more}")
    return {name: table.columns[letters(name)] for name in wanted}


def _check_values(path: Path, lines: Sequence[int], values: FloatArray) -> None:
    bad = np.flatnonzero(~np.isfinite(values).all(axis=1))
    if len(bad):
        raise RetargetError(f"{path}: line {lines[bad[0]]} has a value that is missing or not finite")
    weights = values[:, : len(WEIGHTS)]
    row, column = map(int, np.unravel_index(np.argmax(np.abs(weights)), weights.shape))
    if abs(weights[row, column]) > LARGEST_WEIGHT:
        raise RetargetError(
            f"{path}: line {lines[row]} has {WEIGHTS[column]} = {weights[row, column]:g}, expected weights from 0 to 1"
        )


def _timing(table: CsvTable, rows: list[CsvRow], fps: float | None) -> tuple[float, IntArray, tuple[str, ...]]:
    """Rate, frame number of each row from 0, and the timecodes."""
    place = table.columns.get("timecode")
    if place is None:
        return (*rows_timing(table, rows, fps), ())
    timecodes = tuple(cells[place].strip() for _, cells in rows)
    seconds, _ = timecode_seconds(table.path, timecodes)
    return (*frames_of_times(table.path, seconds, fps), timecodes)


def _filled(frames: IntArray, missing: IntArray, values: FloatArray) -> FloatArray:
    """Values of every frame from the first to the last, those that are missing on straight lines."""
    after = np.searchsorted(frames, missing)
    before = after - 1
    share = (missing - frames[before]) / (frames[after] - frames[before])
    filled = np.empty((len(frames) + len(missing), values.shape[1]))
    filled[frames] = values
    filled[missing] = values[before] + share[:, None] * (values[after] - values[before])
    return filled


def _filled_timecodes(path: Path, frames: IntArray, missing: IntArray, timecodes: tuple[str, ...]) -> tuple[str, ...]:
    """The timecodes with what the clock shows in the frames that are missing."""
    seconds, clock = timecode_seconds(path, timecodes)
    every = dict(zip(frames.tolist(), timecodes, strict=True))
    shown = map(clock.text, np.interp(missing, frames, seconds).tolist())
    every.update(zip(missing.tolist(), shown, strict=True))
    return tuple(every[frame] for frame in range(len(every)))
