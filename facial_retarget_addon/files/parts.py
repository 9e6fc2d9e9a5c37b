"""Named parts of a head on disk: JSON, for each name a vertex of each of its components."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import RetargetError
from ..core.mesh import TriMesh
from ..core.parts.kinds import NAMED_KINDS, NamedParts
from .documents import Table, fault_sentence, json_bytes, read_json
from .whole import write_whole

FORMAT = "facial-retarget/parts"
VERSION = 1


def read_parts(path: Path, mesh: TriMesh) -> NamedParts:
    """Read what an artist calls the parts of a mesh.

    Raises
    ------
    RetargetError : if the file cannot be read or is no such document, if a name is none of `NAMED_KINDS`, or if a part
        has no vertices, or vertices that the mesh does not have; names all faults.
    """
    wrong: list[str] = []
    root = Table(read_json(path), "", wrong)
    root.expect("format", FORMAT)
    root.expect("version", VERSION)
    parts = root.get("parts", dict)
    root.no_more()
    count = len(mesh.vertices)
    vertices: dict[str, list[Any]] = {}
    for name, values in parts.items():
        if name not in NAMED_KINDS:
            wrong.append(f"a part is named {name!r}, expected one of {', '.join(NAMED_KINDS)}")
        part = Table(values, f"part {name!r}", wrong)
        faults = len(wrong)
        vertices[name] = part.get("vertices", list)
        if len(wrong) > faults:
            continue
        part.no_more()
        if not vertices[name] or any(type(v) is not int or not 0 <= v < count for v in vertices[name]):
            wrong.append(f"part {name!r} is at {vertices[name]!r:.60}, expected vertices from 0 to {count - 1}")
    if wrong:
        raise RetargetError(fault_sentence(path, wrong))
    return {name: np.array(held, np.int64) for name, held in vertices.items()}


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
