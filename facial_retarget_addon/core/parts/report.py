"""What the parts of a head do, as plain data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..arrays import BoolArray
from ..mesh import TriMesh
from .find import Part
from .kinds import AROUND_EYE, BEARD, BROW, EYEBALL, MOUSTACHE

FOLLOWS = {
    AROUND_EYE: "rides on the skin of the lids",
    BROW: "rides on the skin",
    MOUSTACHE: "rides on the skin",
    BEARD: "rides on the skin",
    EYEBALL: "turns as the source's does",
}
"""Kind of part -> what it does, when it moves."""


def part_rows(
    parts: Sequence[Part], follows: BoolArray, own: BoolArray, does: Mapping[str, str]
) -> list[dict[str, Any]]:
    """What each kind of part does and how it was known; parts that are alike in all this are one row.

    Parameters
    ----------
    follows : (V,) vertices that follow.
    own : (V,) vertices that have motion of their own.
    does : kind of part -> what it does when it follows.
    """
    rows: dict[tuple[str, str, str], list[int]] = {}
    for part in parts:
        what = "stays"
        if own[part.vertices].any():
            what = "has motion of its own"
        elif follows[part.vertices].any():
            what = does[part.kind]
        rows.setdefault((part.kind, what, part.reason), []).append(len(part.vertices))
    return [
        {"kind": kind, "parts": len(sizes), "vertices": sum(sizes), "does": what, "reason": reason}
        for (kind, what, reason), sizes in rows.items()
    ]


def still_components(
    mesh: TriMesh, moves: BoolArray, rows: Sequence[Mapping[str, Any]]
) -> tuple[list[dict[str, int]], list[str]]:
    """Components of which no vertex moves, (V,), and the warning that names them, if there are any.

    rows : what is known of the parts, see `part_rows`.
    """
    count = mesh.components.max() + 1
    still = np.bincount(mesh.components, moves, count) == 0
    size = np.bincount(mesh.components, minlength=count)
    first = np.unique(mesh.components, return_index=True)[1]
    found = [{"vertices": int(size[k]), "first_vertex": int(first[k])} for k in np.flatnonzero(still)]
    total = sum(part["vertices"] for part in found)
    kinds = ", ".join(dict.fromkeys(row["kind"] for row in rows if row["does"] == "stays"))
    known = f", {kinds}" if kinds else ""
    warning = f"parts of the target that hold no feature point and stay put: {len(found)} ({total} vertices){known}"
    return found, [warning] if found else []
