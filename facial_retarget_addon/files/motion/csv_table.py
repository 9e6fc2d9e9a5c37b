"""CSV tables: settings before the header, the names of the columns, and the rows."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from ...core.errors import RetargetError
from .text import read_motion_lines

_SETTINGS = {
    "fps": "fps",
    "rate": "fps",
    "datarate": "fps",
    "framerate": "fps",
    "unit": "units",
    "units": "units",
}
_LONGEST_SETTING = 200
"""Characters; a longer line is a header."""
_SETTING = re.compile(r"[#\s\"]*([A-Za-z][A-Za-z _]*?)[\"\s]*[,;:=\t][\"\s]*([^,;\t\"]+)[,;\t\"\s]*")

CsvRow = tuple[int, list[str]]
"""The number of a row's line, from 1, and its cells."""


@dataclass(frozen=True)
class CsvTable:
    """A table whose rows are read one by one.

    Attributes
    ----------
    path : of the file.
    settings : "fps" and "units" where lines before the header, comments or not, state them.
    names : of the columns, as in the file.
    """

    path: Path
    settings: dict[str, str]
    names: tuple[str, ...]
    _lines: Sequence[str] = field(repr=False)
    _first: int
    _delimiter: str

    @cached_property
    def columns(self) -> dict[str, int]:
        """Place of each column by the letters of its name; of two alike the first."""
        return {letters(name): place for place, name in reversed([*enumerate(self.names)])}

    def rows(self) -> Iterator[CsvRow]:
        """The rows that are not empty.

        Raises
        ------
        RetargetError : if a row has another number of cells than the header.
        """
        reader = csv.reader(self._lines, delimiter=self._delimiter)
        try:
            for cells in reader:
                if len(cells) == len(self.names):
                    decimal = [cell.replace(",", ".") for cell in cells] if self._delimiter == ";" else cells
                    yield self._first + reader.line_num, decimal
                elif any(cell.strip() for cell in cells):
                    raise RetargetError(
                        f"{self.path}: line {self._first + reader.line_num} has {len(cells)} cells, expected "
                        f"{len(self.names)} as in the header"
                    )
        except csv.Error as error:
            raise RetargetError(f"{self.path}: line {self._first + reader.line_num} is malformed: {error}") from error


def letters(name: str) -> str:
    """A column's name without blanks, signs and case."""
    return re.sub(r"[\W_]", "", name).lower()


def read_csv_table(path: Path, kind: str) -> CsvTable:
    """Read a table with commas, semicolons (numbers may then have decimal commas) or tabs between its cells.

    Raises
    ------
    RetargetError : if the file cannot be read, or has no header; `kind` says what was expected.
    """
    lines = read_motion_lines(path, kind)
    settings: dict[str, str] = {}
    for number, line in enumerate(lines, 1):
        found = _SETTING.fullmatch(line) if len(line) <= _LONGEST_SETTING else None
        key = _SETTINGS.get(re.sub("[ _]", "", found[1]).lower()) if found else None
        if found and key:
            settings[key] = found[2].strip()
        elif line.strip() and not line.lstrip().startswith("#"):
            delimiter = max(",;\t", key=line.count)
            try:
                names = next(csv.reader([line], delimiter=delimiter))
            except csv.Error as error:
                raise RetargetError(f"{path}: the header in line {number} is malformed: {error}") from error
            return CsvTable(path, settings, tuple(name.strip() for name in names), lines[number:], number, delimiter)
    raise RetargetError(f"{path} has no header, expected {kind}")
