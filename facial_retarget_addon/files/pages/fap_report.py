"""What is said about a take of FAPs: which of them act, and which find nothing to move."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...core.arrays import BoolArray, FloatArray
from ...core.mpeg4.faps import FAPS


def fap_table(values: FloatArray, shown: BoolArray | None = None) -> list[dict[str, Any]]:
    """A row for each FAP of (F, 68) that is not 0 all along: its lowest and highest value.

    shown : (68,) those that a face shows, or None where there is no face.
    """
    rows = []
    for fap in _acting(values):
        column = values[:, fap - 1]
        row = {"fap": fap, "name": FAPS[fap - 1].name, "lowest": float(column.min()), "highest": float(column.max())}
        rows.append(row if shown is None else {**row, "shown": bool(shown[fap - 1])})
    return rows


def mute_warnings(values: FloatArray, playable: BoolArray) -> list[str]:
    """A sentence that names the FAPs of (F, 68) that act and that a face cannot show; none where it shows all."""
    mute = [f"{fap} {FAPS[fap - 1].name}" for fap in _acting(values) if not playable[fap - 1]]
    return [f"FAPs that the motion uses and the face has no points for: {', '.join(mute)}"] if mute else []


def _acting(values: FloatArray) -> list[int]:
    """Numbers of the FAPs that are not 0 all along."""
    return [int(column) + 1 for column in np.flatnonzero(np.any(values != 0, axis=0))]
