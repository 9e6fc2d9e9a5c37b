"""Shape keys with a curve each, and how far they are from the frames they stand for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..arrays import FloatArray, IntArray

BLOCK = 16
"""Frames that are looked at together."""


class Displacements(Protocol):
    """(F, V, 3) float32 displacements that are asked for a few frames at once: an array, or what works them out."""

    @property
    def shape(self) -> tuple[int, ...]:
        """(F, V, 3)."""

    def __len__(self) -> int: ...

    def __getitem__(self, rows: slice, /) -> FloatArray: ...


class FromNeutral:
    """Displacements of frames (F, V, 3) from a neutral (V, 3). Long takes are large: no copy of them is made."""

    def __init__(self, frames: FloatArray, neutral: FloatArray) -> None:
        self._frames, self._neutral = frames, neutral.astype(np.float32)

    @property
    def shape(self) -> tuple[int, ...]:
        """(F, V, 3)."""
        return self._frames.shape

    def __len__(self) -> int:
        return len(self._frames)

    def __getitem__(self, rows: slice) -> FloatArray:
        """(f, V, 3) float32."""
        moved: FloatArray = np.asarray(self._frames[rows], np.float32) - self._neutral
        return moved


def blocks(displacements: Displacements, rows: slice = slice(None)) -> Iterator[tuple[slice, FloatArray]]:
    """Frames of a range, a few at once: which ones, and their displacements (f, V, 3)."""
    first, last, _ = rows.indices(len(displacements))
    for start in range(first, last, BLOCK):
        block = slice(start, min(start + BLOCK, last))
        yield block, displacements[block]


@dataclass(frozen=True, eq=False)
class KeyedMotion:
    """A motion as shape keys.

    Attributes
    ----------
    shapes : (K, V, 3) float32 displacements at value 1.
    curves : (F, K) float32 values.
    errors : (F,) root mean square distance of each frame's moving vertices from where they should be.
    worst : (F,) the largest such distance.
    """

    shapes: FloatArray
    curves: FloatArray
    errors: FloatArray
    worst: FloatArray

    def displacements(self, rows: slice = slice(None)) -> FloatArray:
        """(F, V, 3) float32 displacements of frames."""
        moved: FloatArray = np.tensordot(self.curves[rows], self.shapes, axes=1)
        return moved


def measured(shapes: FloatArray, curves: FloatArray, displacements: Displacements, moving: IntArray) -> KeyedMotion:
    """Shape keys (K, V, 3) and curves (F, K) with their errors against displacements (F, V, 3).

    moving : (M,) vertices that the root mean square is taken over.
    """
    keyed = KeyedMotion(shapes, curves, np.zeros(len(curves)), np.zeros(len(curves)))
    for rows, wanted in blocks(displacements):
        away = keyed.displacements(rows)
        away -= wanted
        squares = np.einsum("fvi,fvi->fv", away, away)
        if len(moving):
            keyed.errors[rows] = np.sqrt(squares[:, moving].mean(axis=1))
        keyed.worst[rows] = np.sqrt(squares.max(axis=1, initial=0.0))
    return keyed
