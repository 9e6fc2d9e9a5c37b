"""MPEG-4 `.fap` text: a header, then for each frame the mask of its FAPs and their values (ISO/IEC 14496-2)."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ...core.arrays import BoolArray, IntArray
from ...core.errors import RetargetError
from ...core.mpeg4.faps import FAPS
from ...core.mpeg4.stream import FapStream
from ..whole import Aside, written_whole
from .number_rows import LARGEST, Row, numbers, whole_number
from .rates import checked_rate
from .text import read_motion_lines

VERSION = "2.1"
VISEME_MOST = (14, 14, 63, 1)
"""Largest number in each place of FAP 1; the smallest is 0."""
EXPRESSION_MOST = (6, 63, 6, 63, 1, 1)
"""The same of FAP 2."""
_VERSION = re.compile(r"\d+(\.\d*)?")
_MASK = re.compile(r"[01]{68,69}")
_SINGLE_VISEME = (0, 0, 63, 0)
_SINGLE_EXPRESSION = (0, 63, 0, 0, 0, 0)
"""What the places after the first one hold where a tool writes FAP 1 or 2 as one number: all of that one."""


def read_fap(path: Path) -> FapStream:
    """Read a FAP stream.

    A mask may have 69 digits (the last one is passed over) and needs no blanks. FAP 1 has four numbers and FAP 2
    six; where each is written as one number, as by some tools, the count of the numbers on the line tells it.

    Raises
    ------
    RetargetError : if the file cannot be read, its header, a mask or a frame is malformed, a rate or a value is out
        of range, or other frames follow than the header says, such as in a file that was cut off.
    """
    lines = _statements(read_motion_lines(path, "a FAP stream"))
    name, fps, count = _header(path, lines)
    masks, frames = lines[1::2], [(line, text.split()) for line, text in lines[2::2]]
    if not len(masks) == len(frames) == count:
        raise RetargetError(f"{path} says {count} frames, but {len(frames)} whole ones follow")
    used = _masks(path, masks)
    low_level = used.copy()
    low_level[:, :2] = False
    widths = np.array([_high_level_widths(path, row, mask) for row, mask in zip(frames, used, strict=True)])
    starts = 1 + widths.sum(axis=1)
    _check_numbering(path, frames)
    values = np.zeros((count, len(FAPS)))
    given = [(line, words[start:]) for (line, words), start in zip(frames, starts.tolist(), strict=True)]
    values[low_level] = numbers(path, given)
    bad = np.flatnonzero(np.isnan(values).any(axis=1))
    if len(bad):
        raise RetargetError(f"{path}: line {frames[bad[0]][0]} has a value that is no number")
    first = np.ones(count, np.int64)
    return FapStream(
        name,
        fps,
        values,
        used,
        viseme=_selections(path, frames, first, widths[:, 0], VISEME_MOST, _SINGLE_VISEME),
        expression=_selections(path, frames, first + widths[:, 0], widths[:, 1], EXPRESSION_MOST, _SINGLE_EXPRESSION),
    )


def write_fap(stream: FapStream, path: Path) -> None:
    """Write a FAP stream, whole or not at all; values are rounded to whole numbers, frames are numbered from 0.

    Raises
    ------
    RetargetError : if it has no frames or a value that is not finite, or the system refuses.
    """
    with written_whole() as aside:
        add_fap(aside, stream, path)


def add_fap(aside: Aside, stream: FapStream, path: Path) -> None:
    """Write a FAP stream among outputs that appear together; the rest as in `write_fap`."""
    if not len(stream):
        raise RetargetError(f"{path} cannot be written: the FAP stream has no frames")
    wrong = np.flatnonzero(~(np.abs(stream.values) <= LARGEST).all(axis=1))
    if len(wrong):
        raise RetargetError(
            f"{path} cannot be written: frame {wrong[0]} has a value that is not finite or beyond {LARGEST:g}"
        )
    fps = checked_rate(path, stream.fps)
    header = [VERSION, *stream.name.splitlines(), f"{fps:.0f}" if fps.is_integer() else repr(fps), str(len(stream))]
    lines = [" ".join(header), *_frame_lines(stream), ""]
    aside.place(path).write_bytes("\n".join(lines).encode("utf-8", "replace"))


def _statements(lines: list[str]) -> list[tuple[int, str]]:
    """The numbers and texts of the lines that say something."""
    stripped = ((number, line.strip()) for number, line in enumerate(lines, 1))
    return [(number, line) for number, line in stripped if line and not line.startswith("#")]


def _header(path: Path, lines: list[tuple[int, str]]) -> tuple[str, float, int]:
    """Name, rate and count of frames, taken from the right end: the name may hold blanks, or be missing."""
    first = lines[0][1] if lines else ""
    version, *rest = first.split(maxsplit=1) or [""]
    match [*"".join(rest).rsplit(maxsplit=2)]:
        case [*name, fps, frames] if _VERSION.fullmatch(version) and (count := whole_number(frames) or 0) > 0:
            return "".join(name), checked_rate(path, fps), count
    raise RetargetError(
        f"{path} is no FAP stream: it starts with {first!r:.60}, expected a version, a name, frames a second and the "
        "number of frames"
    )


def _masks(path: Path, lines: list[tuple[int, str]]) -> BoolArray:
    """(F, 68) which FAPs each frame states."""
    digits = ["".join(text.split()) for _, text in lines]
    for (line, text), mask in zip(lines, digits, strict=True):
        if not _MASK.fullmatch(mask):
            raise RetargetError(f"{path}: line {line} is {text!r:.60}, expected a mask of 68 digits 0 or 1")
    letters = np.frombuffer("".join(mask[: len(FAPS)] for mask in digits).encode(), np.uint8)
    return letters.reshape(-1, len(FAPS)) == ord("1")


def _high_level_widths(path: Path, row: Row, mask: BoolArray) -> tuple[int, int]:
    """How many words FAP 1 and FAP 2 have in a frame."""
    line, words = row
    viseme, expression, others = bool(mask[0]), bool(mask[1]), int(mask[2:].sum())
    for widths in ((4 * viseme, 6 * expression), (1 * viseme, 1 * expression)):
        if len(words) == 1 + sum(widths) + others:
            return widths
    raise RetargetError(
        f"{path}: line {line} has {len(words) - 1} values after the frame's number, but the mask before it wants "
        f"{4 * viseme + 6 * expression + others}"
    )


def _check_numbering(path: Path, frames: list[tuple[int, list[str]]]) -> None:
    """Frames are numbered one by one, from 0 or any other number."""
    first = whole_number(frames[0][1][0])
    for index, (line, words) in enumerate(frames):
        if first is None or whole_number(words[0]) != first + index:
            raise RetargetError(
                f"{path}: line {line} starts with {words[0]!r:.30}, expected "
                + ("a frame's number" if first is None else f"the frame's number {first + index}")
            )


def _selections(
    path: Path,
    frames: list[tuple[int, list[str]]],
    starts: IntArray,
    widths: IntArray,
    most: tuple[int, ...],
    single: tuple[int, ...],
) -> IntArray:
    """(F, len(most)) the numbers of FAP 1 or FAP 2, which stand at `starts`; 0 where a frame does not use it."""
    chosen = np.zeros((len(frames), len(most)), np.int64)
    for index in np.flatnonzero(widths):
        line, words = frames[index]
        given = [whole_number(word) for word in words[starts[index] : starts[index] + widths[index]]]
        for number, largest in zip(given, most, strict=False):
            if number is None or not 0 <= number <= largest:
                raise RetargetError(f"{path}: line {line} has {given} for FAP 1 or 2, expected up to {list(most)}")
        chosen[index] = given if len(given) == len(most) else [*given, *single[1:]]
    return chosen


def _frame_lines(stream: FapStream) -> Iterator[str]:
    rounded = np.rint(stream.values).astype(np.int64)
    for index, mask in enumerate(stream.used):
        words = [
            *(stream.viseme[index] if mask[0] else ()),
            *(stream.expression[index] if mask[1] else ()),
            *rounded[index, 2:][mask[2:]],
        ]
        yield " ".join(map(str, mask.astype(int).tolist()))
        yield " ".join(map(str, [index, *words]))
