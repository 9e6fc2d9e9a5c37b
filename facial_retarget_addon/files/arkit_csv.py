"""ARKit face weights as CSV: what Live Link Face records, and plain tables of the 52 weights."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Literal

import numpy as np

from ..core.arrays import FloatArray, IntArray
from ..core.errors import RetargetError
from ..core.mpeg4.arkit import ARKIT
from ..core.mpeg4.arkit_take import ArkitTake
from .csv_table import CsvRow, CsvTable, letters, read_csv_table
from .csv_times import rows_timing
from .documents import MOST_FAULTS
from .number_rows import numbers
from .rates import checked_rate, frames_of_times
from .timecode import Clock, timecode_seconds
from .whole import write_whole

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
    their neighbours, with an empty timecode, so that the take stays in step with its sound and video.

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
    if not has_arkit_names(table):
        raise RetargetError(f"{table.path} is no ARKit CSV: none of its columns is named like one of the 52 weights")
    columns = table.columns
    extra = tuple(part for part in (HEAD, EYES) if any(letters(name) in columns for name in part))
    wanted = [name for part in (WEIGHTS, *extra) for name in part]
    missing = [name for name in wanted if letters(name) not in columns]
    if missing:
        named = ", ".join(missing[:MOST_FAULTS])
        more = f" and {len(missing) - MOST_FAULTS} more" if len(missing) > MOST_FAULTS else ""
        raise RetargetError(f"{table.path} has no column {named}{more}")
    places = [columns[letters(name)] for name in wanted]
    weighted = places[: len(WEIGHTS)]
    rows = [(line, cells) for line, cells in table.rows() if any(cells[place].strip() for place in weighted)]
    if not rows:
        raise RetargetError(f"{table.path} has no frames")
    values = numbers(table.path, ((line, [cells[place] for place in places]) for line, cells in rows))
    values = values.reshape(len(rows), len(places))
    _check_values(table.path, [line for line, _ in rows], values)
    rate, frames, timecodes = _timing(table, rows, fps)
    if gaps == "fill":
        values, timecodes = _filled(frames, values, timecodes)
    rotations = dict(zip(wanted[len(WEIGHTS) :], values[:, len(WEIGHTS) :].T, strict=True))
    return ArkitTake(
        name=table.path.stem,
        fps=rate,
        weights=values[:, : len(WEIGHTS)],
        head=np.stack([rotations[name] for name in HEAD], axis=1) if HEAD in extra else None,
        eyes=np.stack([rotations[name] for name in EYES], axis=1) if EYES in extra else None,
        timecodes=timecodes,
    )


def write_arkit_csv(take: ArkitTake, path: Path) -> None:
    """Write a take as Live Link Face does, whole or not at all: 61 columns, ten decimals.

    Rotations that the take does not have are 0. Frames without a timecode get one from their neighbours', and a take
    without any starts at 0.

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
    rows = zip(_complete_timecodes(path, take), values.tolist(), strict=True)
    text = [",".join(("Timecode", "BlendShapeCount", *columns)), *(pattern % (code, *row) for code, row in rows), ""]
    write_whole(path, "\n".join(text).encode())


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
    return (*frames_of_times(table.path, seconds), timecodes)


def _filled(frames: IntArray, values: FloatArray, timecodes: tuple[str, ...]) -> tuple[FloatArray, tuple[str, ...]]:
    """Every frame from the first to the last, those that are missing on straight lines and without a timecode."""
    every = np.arange(frames[-1] + 1)
    after = np.searchsorted(frames, every).clip(1, None) if len(frames) > 1 else np.zeros(1, np.int64)
    before = np.maximum(after - 1, 0)
    share = (every - frames[before]) / np.maximum(frames[after] - frames[before], 1)
    filled = values[before] + share[:, None] * (values[after] - values[before])
    filled[frames] = values
    known = dict(zip(frames.tolist(), timecodes, strict=bool(timecodes)))
    return filled, tuple(known.get(frame, "") for frame in every.tolist()) if timecodes else ()


def _complete_timecodes(path: Path, take: ArkitTake) -> list[str]:
    """A timecode for each frame: the take's own, and between them what the clock shows."""
    known = [frame for frame, timecode in enumerate(take.timecodes) if timecode]
    if not known:
        return [Clock().text(frame / checked_rate(path, take.fps)) for frame in range(len(take))]
    seconds, clock = timecode_seconds(path, [take.timecodes[frame] for frame in known])
    between = np.interp(np.arange(len(take)), known, seconds)
    return [timecode or clock.text(second) for timecode, second in zip(take.timecodes, between.tolist(), strict=True)]
