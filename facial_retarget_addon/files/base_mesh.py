"""A base mesh of the artist's own on disk: JSON, triangles over the names of feature points."""

from __future__ import annotations

from pathlib import Path

from ..core.errors import RetargetError
from .documents import Table, fault_sentence, json_bytes, read_json
from .whole import write_whole

FORMAT = "facial-retarget/base-mesh"
VERSION = 1

BaseTriangles = tuple[tuple[str, str, str], ...]


def read_base_mesh(path: Path) -> BaseTriangles:
    """Read a base mesh: triangles of point names, counter-clockwise seen from outside.

    Raises
    ------
    RetargetError : if the file cannot be read or is no such document, or if an entry is not three different names.
    """
    wrong: list[str] = []
    root = Table(read_json(path), "", wrong)
    root.expect("format", FORMAT)
    root.expect("version", VERSION)
    triangles = root.get("triangles", list)
    root.no_more()
    for number, triangle in enumerate(triangles, start=1):
        names = triangle if isinstance(triangle, list) else []
        if len(names) != 3 or any(type(name) is not str for name in names) or len(set(names)) != 3:
            wrong.append(f"triangle {number} is {triangle!r:.60}, expected three different point names")
    if not triangles and not wrong:
        wrong.append("there are no triangles, expected some")
    if wrong:
        raise RetargetError(fault_sentence(path, wrong))
    return tuple((a, b, c) for a, b, c in triangles)


def write_base_mesh(base: BaseTriangles, path: Path) -> None:
    """Write a base mesh, whole or not at all; RetargetError if the system refuses."""
    write_whole(path, json_bytes({"format": FORMAT, "version": VERSION, "triangles": base}))
