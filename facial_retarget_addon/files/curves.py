"""Curves of shape keys on disk: a table (.csv) that spreadsheets and other programs read, or a document (.json)."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from .whole import Aside, check_place, written_whole

FORMAT = "facial-retarget/curves"
VERSION = 1


@dataclass(frozen=True, eq=False)
class Curves:
    """Values of shape keys, frame by frame.

    Attributes
    ----------
    names : (K,) of the keys, unique.
    frames : (F,) numbers of the frames, growing; parts of frames are fine.
    values : (F, K) float32.
    fps : frame numbers a second.
    """

    names: tuple[str, ...]
    frames: Sequence[float]
    values: FloatArray
    fps: float


def check_curves_place(path: Path) -> None:
    """RetargetError if `add_curves` would refuse the path."""
    _writer(path)
    check_place(path)


def add_curves(aside: Aside, curves: Curves, path: Path) -> None:
    """Write curves among outputs that appear together.

    Parameters
    ----------
    path : .csv: a line of names, then for each frame its number, its seconds since the first one, and a column of
        values for each key. .json: the same as a document, see `FORMAT`. Both read back exactly as float32.

    Raises
    ------
    RetargetError : for another suffix, a value that is not finite, or if the system refuses.
    """
    bad = np.argwhere(~np.isfinite(curves.values))
    if len(bad):
        row, column = bad[0]
        raise RetargetError(
            f"{path} cannot be written: shape key {curves.names[column]!r} has the value {curves.values[row, column]} "
            f"at frame {curves.frames[row]}, expected a finite one"
        )
    text = _writer(path)(curves)
    with open(aside.place(path), "xb") as file:
        file.write(text.encode("utf-8", "backslashreplace"))


def write_curves(curves: Curves, path: Path) -> None:
    """Write curves, whole or not at all; as `add_curves`."""
    with written_whole() as aside:
        add_curves(aside, curves, path)


def _csv(curves: Curves) -> str:
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(("frame", "time", *curves.names))
    for number, values in zip(curves.frames, _texts(curves.values), strict=True):
        seconds = (number - curves.frames[0]) / curves.fps
        table.writerow((_plain(number), f"{seconds:.9g}", *values))
    return text.getvalue()


def _json(curves: Curves) -> str:
    head = {
        "format": FORMAT,
        "version": VERSION,
        "fps": curves.fps,
        "frames": [_plain(number) for number in curves.frames],
    }
    lines = [
        f"{json.dumps(name, ensure_ascii=False)}: [{', '.join(values)}]"
        for name, values in zip(curves.names, _texts(curves.values.T), strict=True)
    ]
    return json.dumps(head)[:-1] + ',\n"curves": {\n' + ",\n".join(lines) + "\n}}\n"


def _texts(values: FloatArray) -> list[list[str]]:
    """Numbers in the fewest digits that read back exactly."""
    texts: list[list[str]] = np.asarray(values, np.float32).astype(str).tolist()
    return texts


def _plain(number: float) -> float | int:
    """Whole numbers as such."""
    return int(number) if number == int(number) else float(number)


_WRITERS: dict[str, Callable[[Curves], str]] = {".csv": _csv, ".json": _json}


def _writer(path: Path) -> Callable[[Curves], str]:
    writer = _WRITERS.get(path.suffix.lower())
    if writer is None:
        raise RetargetError(
            f"curves {path} would be a {path.suffix or 'file without a suffix'}, expected .csv or .json"
        )
    return writer
