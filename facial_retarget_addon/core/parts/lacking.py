"""Parts that the source moves and the target does not have."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..arrays import FloatArray, IntArray
from ..problem import Face
from .kinds import AROUND_EYE, BOTH, BROW, LOWER, TONGUE, UPPER, eyeball_name
from .known_head import KnownHead, know_head

STANDS_IN = {
    "upper row of teeth": (UPPER, BOTH),
    "lower row of teeth": (LOWER, BOTH),
    "tongue": (TONGUE, BOTH),
    "part around the eyes (lashes)": (AROUND_EYE,),
    "brow of hair": (BROW,),
}
"""What a source may have -> the kinds of parts of a target that do what it does. The first kind is the source's."""
MOVES = 0.01
"""A part moves when a vertex leaves its place by this much, in eye separations."""
_BLOCK = 16


def lacking_parts(source: Face, target: Face, frames: FloatArray) -> list[str]:
    """One clause for each part that the source moves in frames (F, Vs, 3) and that was not found on the target."""
    ours, theirs = know_head(source), know_head(target)
    if not ours.shown:
        return []
    has = dict(_found(theirs, stands_in=True))
    return [
        f"no {name} was found on the target: what the source's does has no counterpart"
        for name, vertices in _found(ours)
        if name not in has and _moves(ours, vertices, frames)
    ]


def _found(head: KnownHead, stands_in: bool = False) -> Iterator[tuple[str, IntArray]]:
    """What a head has, and its vertices (n,).

    stands_in : whether parts count that hold it among others.
    """
    for side, eye in head.eyeballs.items():
        if len(eye.vertices):
            yield eyeball_name(side), eye.vertices
    for name, kinds in STANDS_IN.items():
        vertices = head.vertices(kinds if stands_in else kinds[:1])
        if len(vertices):
            yield name, vertices


def _moves(head: KnownHead, vertices: IntArray, frames: FloatArray) -> bool:
    rest, least = head.mesh.vertices[vertices], MOVES * head.unit
    blocks = (frames[start : start + _BLOCK, vertices] for start in range(0, len(frames), _BLOCK))
    return any(np.abs(block - rest).max(initial=0.0) > least for block in blocks)
