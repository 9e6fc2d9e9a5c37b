"""Named parts of a head on disk: JSON, for each name a vertex of each of its components, or groups of an OBJ file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ..core.arrays import IntArray
from ..core.errors import RetargetError
from ..core.mesh import TriMesh
from ..core.parts.kinds import NAMED_KINDS, NamedParts
from .documents import Table, fault_sentence, json_bytes, read_json
from .obj import read_obj_groups
from .whole import write_whole

FORMAT = "facial-retarget/parts"
VERSION = 1


def read_parts(path: Path, mesh: TriMesh, neutral: Path | None = None) -> NamedParts:
    """Read what an artist calls the parts of a mesh: `vertices`, or `groups` (o, g, usemtl) of the mesh's OBJ file.

    Parameters
    ----------
    neutral : the file that holds the mesh.

    Raises
    ------
    RetargetError : if the file cannot be read or is no such document, if a name is none of `NAMED_KINDS`, or if a part
        has no vertices, vertices that the mesh does not have, or groups that its file does not; names all faults.
    """
    wrong: list[str] = []
    root = Table(read_json(path), "", wrong)
    root.expect("format", FORMAT)
    root.expect("version", VERSION)
    parts = root.get("parts", dict)
    root.no_more()
    count = len(mesh.vertices)
    groups: dict[str, IntArray] | None = None
    named: dict[str, IntArray] = {}
    for name, values in parts.items():
        if name not in NAMED_KINDS:
            wrong.append(f"a part is named {name!r}, expected one of {', '.join(NAMED_KINDS)}")
        part = Table(values, f"part {name!r}", wrong)
        faults = len(wrong)
        by_group = isinstance(values, dict) and "groups" in values
        held = part.get("groups" if by_group else "vertices", list)
        if len(wrong) > faults:
            continue
        part.no_more()
        if by_group:
            if groups is None:
                groups = _groups(neutral, wrong)
            named[name] = _grouped(f"part {name!r}", held, groups, wrong)
        elif not held or any(type(v) is not int or not 0 <= v < count for v in held):
            wrong.append(f"part {name!r} is at {held!r:.60}, expected vertices from 0 to {count - 1}")
        else:
            named[name] = np.array(held, np.int64)
    if wrong:
        raise RetargetError(fault_sentence(path, wrong))
    return named


def _groups(neutral: Path | None, wrong: list[str]) -> dict[str, IntArray]:
    """The groups of an OBJ file; another file has none."""
    if neutral is None or neutral.suffix.lower() != ".obj":
        wrong.append(f"groups are those of an .obj file, but the neutral is {neutral and neutral.name}")
        return {}
    return read_obj_groups(neutral)


def _grouped(part: str, names: list[Any], groups: dict[str, IntArray], wrong: list[str]) -> IntArray:
    """(n,) vertices of all these groups."""
    missing = [name for name in names if not isinstance(name, str) or not len(groups.get(name, ()))]
    if missing or not names:
        there = ", ".join(groups)
        wrong.append(f"{part} has groups {missing or names!r:.60}, expected some of those with faces: {there:.200}")
        return np.empty(0, np.int64)
    return np.concatenate([groups[name] for name in names])


def write_parts(named: NamedParts, mesh: TriMesh, path: Path) -> None:
    """Write named parts, the first vertex of each of their components, whole or not at all.

    Raises
    ------
    RetargetError : if the system refuses.
    """
    first = np.unique(mesh.components, return_index=True)[1]
    parts = {
        name: {"vertices": first[np.unique(mesh.components[vertices])].tolist()} for name, vertices in named.items()
    }
    write_whole(path, json_bytes({"format": FORMAT, "version": VERSION, "parts": parts}))
