"""Feature points that are probably not where they should be, told from their places alone."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .arrays import FloatArray
from .point_sets import POINT_INFOS, point_label

SAME = 1e-3
"""Points nearer to one another than this share of the face's size are in one place."""
PAIRS = 3
"""So many pairs tell which side is left."""


def doubts(names: Sequence[str], places: FloatArray) -> dict[str, str]:
    """What is wrong with points at places (P, 3), in any units: name -> a few words; sound points are left out.

    A point is doubtful where another one lies in the same place, and where it has changed sides with its partner.
    """
    return _doubled(names, places) | _swapped(names, places)


def _doubled(names: Sequence[str], places: FloatArray) -> dict[str, str]:
    if len(names) < 3:
        return {}
    gaps = np.linalg.norm(places[:, None] - places, axis=2)
    near = gaps < SAME * gaps.max()
    np.fill_diagonal(near, False)
    return {
        names[i]: f"in the same place as {point_label(names[int(near[i].argmax())])}"
        for i in np.flatnonzero(near.any(axis=1))
    }


def _swapped(names: Sequence[str], places: FloatArray) -> dict[str, str]:
    """Pairs whose left point lies to the right of the right one, going by the other pairs."""
    row = {name: i for i, name in enumerate(names)}
    lefts = [name for name in names if name in POINT_INFOS and POINT_INFOS[name].diagram[0] > 0]
    pairs = [(name, POINT_INFOS[name].partner) for name in lefts if POINT_INFOS[name].partner in row]
    if len(pairs) < PAIRS:
        return {}
    across = np.array([places[row[left]] - places[row[right]] for left, right in pairs])
    wrong = across @ np.median(across, axis=0) < 0
    return {
        name: f"on the wrong side of {point_label(other)}"
        for pair, bad in zip(pairs, wrong, strict=True)
        if bad
        for name, other in (pair, pair[::-1])
    }
