"""TRC marker tables, as motion capture systems export them: a header of five lines, then tabs between the numbers."""

from __future__ import annotations

from pathlib import Path

from ...core.errors import RetargetError
from ...core.markers.take import MarkerTake
from .marker_take import marker_take
from .number_rows import Row, numbers, of_width, whole_number
from .rates import check_times, checked_rate
from .text import read_motion_lines

HEADER_LINES = 5
"""What the file is, names of settings, their values, names of the markers, X1 Y1 Z1 and so on."""


def read_trc(path: Path) -> MarkerTake:
    """Read a TRC file. A blank coordinate means that the marker was not seen.

    Raises
    ------
    RetargetError : if the file cannot be read or is malformed, other markers or frames follow than the header says,
        or its rate is not believed or contradicts its times.
    """
    lines = read_motion_lines(path, "a TRC marker table")
    if not lines[0].lower().startswith("pathfiletype"):
        raise RetargetError(f"{path} is no TRC file: it starts with {lines[0]!r:.40}, expected 'PathFileType'")
    if len(lines) < HEADER_LINES:
        raise RetargetError(f"{path} ends in its header, expected {HEADER_LINES} lines of it")
    keys, values, titles = ([word.strip() for word in line.split("\t")] for line in lines[1:4])
    settings = dict(zip(map(str.lower, keys), values, strict=False))
    fps = checked_rate(path, settings.get("datarate", "no"))
    names = [title for title in titles[2:] if title]
    rows = [(number, line) for number, line in enumerate(lines[HEADER_LINES:], HEADER_LINES + 1) if line.strip()]
    for key, what, count in (("nummarkers", "markers", len(names)), ("numframes", "frames", len(rows))):
        if whole_number(settings.get(key, "")) != count:
            raise RetargetError(f"{path} says {settings.get(key, 'no')!r:.30} {what}, but {count} follow")
    width = 2 + 3 * len(names)
    table = numbers(path, of_width(path, map(_row, rows), width)).reshape(-1, width)
    take = marker_take(path, fps, names, table[:, 2:].reshape(len(table), -1, 3), settings.get("units", ""))
    check_times(path, fps, table[:, 1])
    return take


def _row(line: tuple[int, str]) -> Row:
    """The words of a line, without the tab that some systems write at its end."""
    number, text = line
    words = text.split("\t")
    return number, words[:-1] if len(words) % 3 == 0 and not words[-1].strip() else words
