"""What all kinds of job files hold: paths, a method and its settings, and values written as TOML."""

from __future__ import annotations

import json
from pathlib import Path

from ..core.errors import RetargetError
from ..core.methods import METHODS
from ..core.methods.settings import SETTINGS, Settings, read_settings
from .documents import Table


def read_path(table: Table, key: str, folder: Path) -> Path:
    """A path that must be there, relative to the job's folder."""
    faults = len(table.wrong)
    text = table.get(key, str)
    if len(table.wrong) == faults and (not text.strip() or "\0" in text):
        table.wrong.append(f"{table.where} {key} = {text!r}, expected a path".strip())
        return folder
    return folder / text


def read_optional_path(table: Table, key: str, folder: Path) -> Path | None:
    """A path, or None where it is missing."""
    return read_path(table, key, folder) if table.optional(key, str) is not None else None


def read_texts(table: Table, key: str) -> tuple[str, ...] | None:
    """A list of texts, or None where it is missing."""
    values = table.optional(key, list)
    if values is None:
        return None
    if any(type(value) is not str for value in values):
        table.wrong.append(f"{table.where} {key} = {values!r:.60}, expected a list of texts".strip())
        return ()
    return tuple(values)


def check_method(method: str, wrong: list[str]) -> None:
    """Add to `wrong` if there is no such method."""
    if method not in METHODS:
        wrong.append(f"method = {method!r}, expected one of {', '.join(METHODS)}")


def read_method_settings(method: str, root: Table) -> Settings:
    """The job's [settings], those of the method."""
    values = root.optional("settings", dict) or {}
    if method in METHODS:
        try:
            return read_settings(method, values)
        except RetargetError as error:
            root.wrong.append(str(error))
    return next(iter(SETTINGS.values()))()


def relative(path: Path, folder: Path) -> str:
    """A path as a job in a folder writes it: relative to it where it lies inside."""
    return (path.relative_to(folder) if path.is_relative_to(folder) else path).as_posix()


def toml(value: str | float | tuple[str, ...] | tuple[float, ...]) -> str:
    """A value as TOML; RetargetError for what is no Unicode text."""
    if isinstance(value, tuple):
        return f"[{', '.join(toml(part) for part in value)}]"
    if isinstance(value, str):
        if not value.isascii() and value.encode("utf-8", "ignore").decode() != value:
            raise RetargetError(f"{value!r} cannot stand in a job file: it is no Unicode text")
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return repr(value).lower() if isinstance(value, bool) else repr(value)
