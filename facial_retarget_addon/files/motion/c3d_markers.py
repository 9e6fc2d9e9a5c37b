"""C3D, the binary format of optical motion capture, read through the c3d package."""

from __future__ import annotations

import warnings
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from ...core.arrays import FloatArray
from ...core.errors import RetargetError
from ...core.markers.take import MarkerTake
from .marker_take import marker_take
from .rates import checked_rate
from .text import read_motion_bytes

BLOCK = 512
"""Bytes; every part of a C3D file fills whole blocks."""
MOST_COUNTED = 65535
"""Frames that a file can count without the parameters of longer takes."""
_MAGIC = 80
"""The second byte of every C3D file."""


def read_c3d(path: Path) -> MarkerTake:
    """Read the markers of a C3D file: not seen where the residual is below 0, numbered where they have no label.

    Raises
    ------
    RetargetError : if the file cannot be read or is malformed, ends before its frames do, or its rate is not believed.
    """
    import c3d

    content = read_motion_bytes(path, "a C3D file", lambda head: head[1:2] == bytes([_MAGIC]))
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            reader = c3d.Reader(BytesIO(content))
            rate = checked_rate(path, str(reader.point_rate))
            labels = _labels(reader)
            units = _units(reader)
            points = _points(path, reader, len(content))
    except RetargetError:
        raise
    except Exception as error:  # the package asserts, and lets whatever its parsing meets come through
        reason = " ".join(str(error).split()) or type(error).__name__
        raise RetargetError(f"{path} is a malformed C3D file: {reason:.120}") from error
    names = [label or f"marker {number}" for number, label in enumerate(labels, 1)]
    return marker_take(path, rate, names, points, units)


def _points(path: Path, reader: Any, size: int) -> FloatArray:
    """(F, M, 3) positions, NaN where a marker was not seen, out of a file of `size` bytes."""
    markers, frames = int(reader.point_used), _frame_count(reader)
    length = frames * (4 * markers + reader.header.analog_count) * (4 if reader.point_scale < 0 else 2)
    start = BLOCK * (reader.header.data_block - 1)
    if not 0 <= length <= size - start:
        raise RetargetError(f"{path} says {frames} frames of {markers} markers, but ends before them")
    if frames == MOST_COUNTED and size - start - length >= BLOCK:
        raise RetargetError(
            f"{path} has more frames than the {MOST_COUNTED} that its header can say, expected shorter takes"
        )
    points = np.full((frames if markers else 0, markers, 3), np.nan)
    for positions, (_, given, _) in zip(points, reader.read_frames(copy=False), strict=False):
        seen = given[:, 3] >= 0
        positions[seen] = given[seen, :3]
    return points


def _frame_count(reader: Any) -> int:
    first = reader.get("TRIAL:ACTUAL_START_FIELD")
    high = 0 if first is None else int(first.uint16_array[1])
    return int(reader.frame_count) - high  # c3d 0.6.0 takes the high word of the first frame times 65535


def _labels(reader: Any) -> list[str]:
    """The labels of the markers, which go on in LABELS2 and so on after the first 255; "" where there is none."""
    count = int(reader.point_used)
    labels: list[str] = []
    for suffix in ("", *range(2, 2 + count // 255)):
        given = reader.get(f"POINT:LABELS{suffix}")
        if given is not None:
            labels += [label.strip(" \0") for label in given.string_array]
    return (labels + [""] * count)[:count]


def _units(reader: Any) -> str:
    given = reader.get("POINT:UNITS")
    return "" if given is None else str(given.string_value).strip(" \0")
