"""Painted masks on disk: NPZ with `weights` (V,), from 0 to 1."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import numpy as np

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from .npz import read_arrays, write_arrays
from .whole import write_whole


def read_mask(path: Path, vertex_count: int) -> FloatArray:
    """Read a mask of a mesh: (V,) weights.

    Raises
    ------
    RetargetError : if the file cannot be read, has no `weights`, another number of them than the mesh has vertices, or
        some that do not lie between 0 and 1.
    """
    weights = read_arrays(path, "weights").get("weights")
    if weights is None:
        raise RetargetError(f"{path} has no array 'weights', expected one number for each vertex")
    if weights.shape != (vertex_count,) or weights.dtype.kind not in "fiu":
        raise RetargetError(
            f"{path} has weights of shape {weights.shape} and type {weights.dtype}, expected ({vertex_count},) numbers"
        )
    if not ((weights >= 0) & (weights <= 1)).all():
        raise RetargetError(f"{path} has weights that do not lie between 0 and 1")
    return np.array(weights, np.float64)


def write_mask(weights: FloatArray, path: Path) -> None:
    """Write a mask (V,), whole or not at all; RetargetError if the system refuses."""
    content = BytesIO()
    write_arrays(content, {"weights": np.asarray(weights, np.float32)})
    write_whole(path, content.getvalue())
