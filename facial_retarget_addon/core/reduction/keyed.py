"""Shape keys with a curve each, and how far they are from the frames they stand for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray

BLOCK = 32
"""Frames that are looked at together."""


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


def measured(shapes: FloatArray, curves: FloatArray, displacements: FloatArray, moving: IntArray) -> KeyedMotion:
    """Shape keys (K, V, 3) and curves (F, K) with their errors against displacements (F, V, 3).

    moving : (M,) vertices that the root mean square is taken over.
    """
    keyed = KeyedMotion(shapes, curves, np.zeros(len(curves)), np.zeros(len(curves)))
    for first in range(0, len(curves), BLOCK):
        rows = slice(first, first + BLOCK)
        away = keyed.displacements(rows)
        away -= displacements[rows]
        squares = np.einsum("fvi,fvi->fv", away, away)
        if len(moving):
            keyed.errors[rows] = np.sqrt(squares[:, moving].mean(axis=1))
        keyed.worst[rows] = np.sqrt(squares.max(axis=1, initial=0.0))
    return keyed
