"""Paths that the artist names."""

from __future__ import annotations

from pathlib import Path

import bpy

from ..core.errors import RetargetError


def chosen_path(path: str, what: str, use: str, where: str) -> Path:
    """A path of the panel, absolute; // means beside the .blend.

    Parameters
    ----------
    what : "file" or "folder". use : what it is for. where : the panel that names it.

    Raises
    ------
    RetargetError : if none is named, or it lies beside a .blend that is not saved yet.
    """
    if not path:
        raise RetargetError(f"no {what} is chosen for the {use}, expected one under {where}")
    if path.startswith("//") and not bpy.data.filepath:
        raise RetargetError(f"{what} {path!r} lies beside the .blend, which is not saved yet; save it, or name another")
    return Path(bpy.path.abspath(path)).absolute()


def optional_path(path: str, what: str, use: str, where: str) -> Path | None:
    """As `chosen_path`, None where none is named."""
    return chosen_path(path, what, use, where) if path else None
