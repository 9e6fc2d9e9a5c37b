"""JSON and TOML documents: read them, and check their tables field by field."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

from ..core.errors import RetargetError

T = TypeVar("T")

MOST_FAULTS = 12
"""Faults of one file that a message spells out."""

_MOST_WHOLE = 2**53
"""Whole numbers up to this one are numbers too."""
_KINDS = {
    str: "a text",
    int: "a whole number",
    float: "a number",
    bool: "true or false",
    dict: "a table",
    list: "a list",
}


def read_bytes(path: Path) -> bytes:
    """A file's content; RetargetError if the system refuses."""
    try:
        return path.read_bytes()
    except OSError as error:
        raise RetargetError(f"{path} cannot be read: {error.strerror or error}") from error


def read_toml(path: Path) -> dict[str, Any]:
    """A TOML document; RetargetError says where it is malformed."""
    document: dict[str, Any] = _parse(path, tomllib.loads, "TOML")
    return document


def read_json(path: Path) -> Any:
    """A JSON document without NaN and without a name twice in one table; RetargetError says where it is malformed."""
    return _parse(path, lambda text: json.loads(text, object_pairs_hook=_unique, parse_constant=_no_constant), "JSON")


def json_bytes(value: Any) -> bytes:
    """Plain data as an indented JSON document in UTF-8."""
    return (json.dumps(value, indent=1, ensure_ascii=False, allow_nan=False) + "\n").encode("utf-8", "backslashreplace")


def fault_sentence(path: Path, wrong: list[str]) -> str:
    """What is wrong in a file, in one sentence; the first faults of a long list stand for all."""
    more = f"; and {len(wrong) - MOST_FAULTS} more" if len(wrong) > MOST_FAULTS else ""
    return f"{path}: {'; '.join(wrong[:MOST_FAULTS])}{more}"


def _parse(path: Path, parse: Callable[[str], Any], language: str) -> Any:
    try:
        return parse(read_bytes(path).decode("utf-8-sig"))
    except (ValueError, RecursionError) as error:
        raise RetargetError(f"{path} is no {language} document: {error}") from error


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    table: dict[str, Any] = {}
    for name, value in pairs:
        if name in table:
            raise ValueError(f"{name!r} appears twice, expected unique names")
        table[name] = value
    return table


def _no_constant(name: str) -> float:
    raise ValueError(f"{name} is no number")


class Table:
    """A table of a document. Faults are collected, so that a reader can name all of them at once."""

    def __init__(self, values: object, where: str, wrong: list[str]) -> None:
        """Look at `values`, called `where` in messages; append what is wrong to `wrong`."""
        self.where = where
        self.wrong = wrong
        self._asked: list[str] = []
        self._values: dict[str, Any] = values if isinstance(values, dict) else {}
        if not isinstance(values, dict):
            wrong.append(f"{where} is {values!r:.60}, expected a table")

    def get(self, key: str, kind: type[T]) -> T:
        """The value of a key that must be there; an empty one of its kind where it is missing or wrong."""
        self._asked.append(key)
        if key not in self._values:
            self.wrong.append(f"{self._name(key)} is missing, expected {_KINDS[kind]}")
            return kind()
        value = self._values[key]
        if type(value) is int and kind is float and abs(value) <= _MOST_WHOLE:
            return cast(T, float(value))
        if type(value) is kind:
            return value
        self.wrong.append(f"{self._name(key)} = {value!r:.60}, expected {_KINDS[kind]}")
        return kind()

    def optional(self, key: str, kind: type[T]) -> T | None:
        """The value of a key, or None where it is missing."""
        self._asked.append(key)
        return self.get(key, kind) if key in self._values else None

    def expect(self, key: str, expected: object) -> None:
        """A key that must have one value, such as the version of the format."""
        self._asked.append(key)
        value = self._values.get(key)
        if type(value) is not type(expected) or value != expected:
            arrived = f"= {value!r:.60}" if key in self._values else "is missing"
            self.wrong.append(f"{self._name(key)} {arrived}, expected {expected!r}")

    def names(self) -> list[str]:
        """All its keys, for a table whose keys the user chooses."""
        return list(self._values)

    def table(self, key: str) -> Table:
        """A table inside, empty where it is missing."""
        return Table(self.get(key, dict), f"{self.where} [{key}]".strip(), self.wrong)

    def no_more(self) -> None:
        """Every key that was not asked for is a fault."""
        known = list(dict.fromkeys(self._asked))
        for key in self._values:
            if key not in known:
                self.wrong.append(f"{self._name(key)} is unknown, expected one of {', '.join(known)}")

    def _name(self, key: str) -> str:
        return f"{self.where} {key}".strip()
