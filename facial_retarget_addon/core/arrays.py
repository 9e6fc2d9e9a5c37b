"""Names for the arrays that pass between the rooms, and for progress."""

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.floating[Any]]
IntArray = npt.NDArray[np.int64]
BoolArray = npt.NDArray[np.bool_]

Progress = Callable[[float, str], None]
"""Called with the share done (0 to 1) and what is being done; raises Cancelled to stop."""


def no_progress(share: float, what: str) -> None:
    """A Progress that says nothing."""


def progress_part(progress: Progress, first: float, last: float) -> Progress:
    """Progress of a part of the work that lies between two shares of the whole."""

    def part(share: float, what: str) -> None:
        progress(first + share * (last - first), what)

    return part


def unit_vectors(vectors: FloatArray) -> FloatArray:
    """Vectors (..., 3) divided by their lengths; a zero vector stays zero."""
    lengths = np.sqrt(np.einsum("...i,...i->...", vectors, vectors))[..., None]
    return np.divide(vectors, lengths, out=np.zeros_like(vectors), where=lengths > 0)


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Cross products of (..., 3) arrays; np.cross without its overhead."""
    out = np.empty(np.broadcast_shapes(a.shape, b.shape), np.result_type(a, b))
    out[..., 0] = a[..., 1] * b[..., 2] - a[..., 2] * b[..., 1]
    out[..., 1] = a[..., 2] * b[..., 0] - a[..., 0] * b[..., 2]
    out[..., 2] = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return out
