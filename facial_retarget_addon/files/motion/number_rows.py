"""Many numbers out of the words of a text file."""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np

from ...core.arrays import FloatArray
from ...core.errors import RetargetError

Row = tuple[int, Sequence[str]]
"""The number of a line, from 1, and its words."""
LARGEST = 1e15
"""Larger numbers are mistakes, and nothing that is computed from smaller ones overflows."""


def numbers(path: Path, rows: Iterable[Row]) -> FloatArray:
    """The words of all rows as numbers from -LARGEST to LARGEST, one after the other; a blank word is NaN.

    Memory grows with what has been read, never with what a header claims.

    Raises
    ------
    RetargetError : if a word is no number or too large a one; names its line.
    """
    found = array("d")
    lines, ends = array("q"), array("q")
    for line, words in rows:
        try:
            found.extend([*map(float, words)])
        except ValueError:
            found.extend([_number(path, line, word) for word in words])
        lines.append(line)
        ends.append(len(found))
    values = np.array(found, np.float64)
    large = np.flatnonzero(np.abs(values) > LARGEST)
    if len(large):
        line = lines[int(np.searchsorted(ends, large[0], "right"))]
        raise RetargetError(f"{path}: line {line} has {values[large[0]]:g}, expected at most {LARGEST:g}")
    return values


def of_width(path: Path, rows: Iterable[Row], width: int) -> Iterator[Row]:
    """The same rows; RetargetError names the line that has not `width` words."""
    for line, words in rows:
        if len(words) != width:
            raise RetargetError(f"{path}: line {line} has {len(words)} values, expected {width}")
        yield line, words


def whole_number(word: str) -> int | None:
    """The whole number that a word is, or None."""
    digits = word[1:] if word[:1] in ("-", "+") else word
    return int(word) if len(digits) < 16 and digits.isascii() and digits.isdigit() else None


def _number(path: Path, line: int, word: str) -> float:
    try:
        return float(word.strip() or "nan")
    except ValueError as error:
        raise RetargetError(f"{path}: line {line} has {word!r:.60}, expected a number") from error
