"""As few shape keys as a tolerance allows, each of them a region that an animator can use."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..arrays import FloatArray, IntArray, Progress, no_progress
from ..errors import RetargetError
from .keyed import Displacements, KeyedMotion, blocks, measured

_SHARE = 0.5
"""Part of the tolerance that leaving out components may use up; drawing keys together takes the rest."""
_ROUNDS, _STEPS = 40, 25
_SWEEPS, _STILL = 30, 1e-2
_NEAREST = 0.3
"""A key spreads freely so far from where it moves most, in reaches."""
_LEAST = 0.1
"""What spreading costs there, against 1 at the reach and beyond."""
_OVERSAMPLING = 8
_COLUMNS = 4096
"""Coordinates that are taken in float64 at once."""
_ROUNDING = 1e-4
"""Part of the tolerance that float32 may lose."""
_UNSEEN = 0.1
"""Part of the tolerance that may lie outside the components that the drawing together works with."""


def compact(
    displacements: Displacements,
    neutral: FloatArray,
    tolerance: float,
    reach: float,
    rng: np.random.Generator,
    progress: Progress = no_progress,
) -> KeyedMotion:
    """The fewest components of a motion that keep every frame within half the tolerance, drawn together to regions.

    The components are turned among themselves until each moves few vertices (nothing is lost by that); then shapes and
    curves are solved by turns, with a price on every vertex that a key moves, higher the farther it is from where
    the key moves most. The price rises until the tolerance is used up.

    Parameters
    ----------
    displacements : (F, V, 3) float32. neutral : (V, 3).
    tolerance : root mean square distance that the moving vertices of a frame may be off, in the displacements' units.
        Vertices that never move farther than this are still.
    reach : how far a region may spread, in the same units; an eye separation is usual.
    rng : where the first directions come from.

    Returns
    -------
    Keys whose curves reach 1 at their extreme. `errors` are all within the tolerance.

    Raises
    ------
    RetargetError : if there are no frames, or tolerance or reach are not above 0.

    References
    ----------
    Neumann et al. 2013, "Sparse Localized Deformation Components"; Kaiser 1958 for the turning.
    """
    if len(displacements.shape) != 3 or not len(displacements):
        raise RetargetError(
            f"displacements have shape {displacements.shape}, expected (F, V, 3) with at least one frame"
        )
    if tolerance <= 0 or reach <= 0:
        raise RetargetError(f"tolerance {tolerance} and reach {reach} arrived, expected numbers above 0")
    farthest = np.zeros(displacements.shape[1])
    for _, block in blocks(displacements):
        np.maximum(farthest, np.einsum("fvi,fvi->fv", block, block).max(axis=0), out=farthest)
    moving = np.flatnonzero(np.sqrt(farthest) > tolerance)
    shapes = np.zeros((0, displacements.shape[1], 3), np.float32)
    curves = np.zeros((len(displacements), 0), np.float32)
    if len(moving):
        progress(0.1, "finding the components")
        found = _components(_Moving(displacements, moving), _UNSEEN * tolerance * np.sqrt(len(moving)), rng)
        few = found.fewest(_SHARE * tolerance * np.sqrt(len(moving)))
        curves, flat = few.curves.copy(), few.shapes.copy()
        _turn_to_few_vertices(curves, flat)
        places = np.asarray(neutral, np.float32)[moving]
        curves, flat = _drawn_together(found, curves, flat, places, tolerance, reach, progress)
        shapes = np.zeros((len(flat), displacements.shape[1], 3), np.float32)
        shapes[:, moving] = flat.reshape(len(flat), -1, 3)
    progress(1.0, "done")
    return measured(shapes, curves, displacements, moving)


class _Moving:
    """The motion (F, 3M) of the vertices that move, by its products: itself it would be as large as the frames."""

    def __init__(self, displacements: Displacements, moving: IntArray) -> None:
        self._displacements, self._moving = displacements, moving
        self.shape = len(displacements), 3 * len(moving)

    def _blocks(self) -> Iterator[tuple[slice, FloatArray]]:
        for rows, block in blocks(self._displacements):
            yield rows, np.take(block, self._moving, axis=1).reshape(len(block), -1)

    def lacking(self, curves: FloatArray, shapes: FloatArray) -> FloatArray:
        """(F,) float64 squared length of what each frame lacks with curves (F, R) of shapes (R, 3M)."""
        squares = np.empty(len(curves))
        for rows, block in self._blocks():
            left = block - curves[rows] @ shapes
            squares[rows] = np.einsum("fi,fi->f", left, left, dtype=np.float64)
        return squares

    def times(self, matrix: FloatArray) -> FloatArray:
        """(F, n): the motion times a matrix (3M, n)."""
        return np.concatenate([block @ matrix for _, block in self._blocks()])

    def under(self, matrix: FloatArray) -> FloatArray:
        """(n, 3M): the transpose of a matrix (F, n) times the motion."""
        found = np.zeros((matrix.shape[1], self.shape[1]), np.float32)
        for rows, block in self._blocks():
            found += matrix[rows].T @ block
        return found


class _Components(NamedTuple):
    """A motion (F, 3M) as orthonormal curves (F, R) and components (R, 3M), the strongest first.

    rest : (F, R + 1) length of what each frame lacks with the first 0, 1, … of them.
    """

    curves: FloatArray
    shapes: FloatArray
    rest: FloatArray

    def fewest(self, most: float) -> _Components:
        """The first components, as few as leave no frame lacking more than `most`, or all."""
        enough = np.flatnonzero(self.rest.max(axis=0) <= most)
        count = max(int(enough[0]) if len(enough) else len(self.shapes), 1)
        return _Components(self.curves[:, :count], self.shapes[:count], self.rest[:, : count + 1])


def _components(motion: _Moving, most: float, rng: np.random.Generator) -> _Components:
    """Components of a motion (F, 3M), as few as leave no frame lacking more than `most`.

    Truncated singular value decomposition through a random subspace, twice as large until it is large enough
    (Halko, Martinsson and Tropp 2011).
    """
    rank = 16
    while True:
        rank = min(2 * rank, *motion.shape)
        directions = min(rank + _OVERSAMPLING, *motion.shape)
        basis: FloatArray = np.linalg.qr(motion.times(rng.standard_normal((motion.shape[1], directions), np.float32)))[
            0
        ]
        for _ in range(2):
            basis = np.linalg.qr(motion.times(motion.under(basis).T))[0]
        shapes = motion.under(basis)
        squares, turned = np.linalg.eigh(_gram(shapes))
        turned, strength = turned[:, : -rank - 1 : -1], np.sqrt(np.maximum(squares[: -rank - 1 : -1], 0.0))
        curves = basis @ turned.astype(np.float32)
        found = turned.T.astype(np.float32) @ shapes
        rest = _lengths_left(curves * strength, motion.lacking(curves, found))
        if rest[:, -1].max() <= most or rank == min(motion.shape):
            return _Components(curves, found, rest).fewest(most)


def _gram(rows: FloatArray) -> FloatArray:
    """(n, n) float64 products of float32 rows (n, m), without all of them in float64."""
    gram = np.zeros((len(rows), len(rows)))
    for first in range(0, rows.shape[1], _COLUMNS):
        part = rows[:, first : first + _COLUMNS].astype(np.float64)
        gram += part @ part.T
    return gram


def _lengths_left(lengths: FloatArray, lacking: FloatArray) -> FloatArray:
    """(F, R + 1) length of what each frame lacks with the first 0, 1, … of some components at right angles.

    Summed up from the last one: the difference of two lengths would lose what is far smaller than the motion.

    Parameters
    ----------
    lengths : (F, R) of what each component adds to each frame. lacking : (F,) squares of what they all lack.
    """
    squares = np.column_stack([lengths.astype(np.float64) ** 2, lacking])
    left: FloatArray = np.sqrt(squares[:, ::-1].cumsum(axis=1)[:, ::-1])
    return left


def _turn_to_few_vertices(curves: FloatArray, shapes: FloatArray) -> None:
    """Turn components among themselves (in place) until the fourth powers of how far vertices move add up to most."""
    vectors = shapes.reshape(len(shapes), -1, 3)
    for _ in range(_SWEEPS):
        largest = 0.0
        for p in range(len(shapes) - 1):
            for q in range(p + 1, len(shapes)):
                one, two = vectors[p], vectors[q]
                u = np.einsum("vi,vi->v", one, one) - np.einsum("vi,vi->v", two, two)
                w = 2 * np.einsum("vi,vi->v", one, two)
                angle = 0.25 * np.arctan2(2 * (u @ w), u @ u - w @ w)
                c, s = np.float32(np.cos(angle)), np.float32(np.sin(angle))
                largest = max(largest, abs(float(angle)))
                for rows in (shapes, curves.T):
                    rows[p], rows[q] = c * rows[p] + s * rows[q], c * rows[q] - s * rows[p]
        if largest < _STILL:
            return


def _drawn_together(
    motion: _Components,
    curves: FloatArray,
    shapes: FloatArray,
    places: FloatArray,
    tolerance: float,
    reach: float,
    progress: Progress,
) -> tuple[FloatArray, FloatArray]:
    """Curves and shapes whose vertices cost; the last ones that keep the tolerance."""
    curves, shapes = _at_their_extremes(curves, shapes)
    best = curves, shapes
    price, growth = 0.1 * tolerance * np.sqrt(len(motion.curves)), 1.5
    for number in range(_ROUNDS):
        progress(0.3 + 0.7 * number / _ROUNDS, "drawing the keys together")
        cost = price * _spreading(shapes, places, reach)
        curves, shapes = _at_their_extremes(*_resolved(motion, _shrunk(motion, curves, shapes, cost)))
        if _largest_error(motion, curves, shapes) <= (1 - _ROUNDING) * tolerance * np.sqrt(len(places)):
            best = curves, shapes
            price *= growth
        else:
            curves, shapes = best
            growth = np.sqrt(growth)
            price /= growth
    return best


def _largest_error(motion: _Components, curves: FloatArray, shapes: FloatArray) -> float:
    """What the worst frame lacks at most, with what lies outside the components.

    What differs within them and what lies beside them are added up: no small difference of large numbers arises.
    """
    strength = np.linalg.norm(motion.shapes, axis=1)
    units = motion.shapes / np.maximum(strength, np.float32(1e-30))[:, None]
    within = shapes @ units.T
    off = (motion.curves * strength - curves @ within).astype(np.float64)
    beside = np.einsum("fi,ij,fj->f", curves, _gram(shapes - within @ units), curves, optimize=True)
    lacking = np.sqrt(np.einsum("fi,fi->f", off, off) + np.maximum(beside, 0.0))
    return float((lacking + motion.rest[:, -1]).max())


def _spreading(shapes: FloatArray, places: FloatArray, reach: float) -> FloatArray:
    """(K, M) what it costs each key to move each vertex."""
    vectors = shapes.reshape(len(shapes), -1, 3)
    centre = places[np.einsum("kvi,kvi->kv", vectors, vectors).argmax(axis=1)]
    distance = np.linalg.norm(places[None] - centre[:, None], axis=2) / reach
    return np.clip((distance - _NEAREST) / (1 - _NEAREST), _LEAST, 1.0).astype(np.float32)


def _shrunk(motion: _Components, curves: FloatArray, shapes: FloatArray, cost: FloatArray) -> FloatArray:
    """Shapes (K, 3M) for given curves, with a cost (K, M) on how far keys move vertices: accelerated descent."""
    gram, wanted = curves.T @ curves, (curves.T @ motion.curves) @ motion.shapes
    steepest = float(np.linalg.eigvalsh(gram)[-1])
    limit = (cost / steepest)[..., None]
    ahead, now, pace = shapes, shapes, 1.0
    for _ in range(_STEPS):
        step = (ahead - (gram @ ahead - wanted) / np.float32(steepest)).reshape(len(shapes), -1, 3)
        length = np.sqrt(np.einsum("kvi,kvi->kv", step, step))[..., None]
        step *= np.maximum(1 - limit / np.maximum(length, np.float32(1e-30)), 0)
        before, now = now, step.reshape(len(shapes), -1)
        pace, last = (1 + np.sqrt(1 + 4 * pace * pace)) / 2, pace
        ahead = now + np.float32((last - 1) / pace) * (now - before)
    return now


def _resolved(motion: _Components, shapes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Curves (F, K) that meet the motion best with the shapes (K, 3M) that are left, and those."""
    kept = shapes[shapes.any(axis=1)]
    mixing = np.linalg.lstsq((kept @ kept.T).astype(np.float64), kept @ motion.shapes.T, rcond=1e-7)[0]
    return (motion.curves @ mixing.T).astype(np.float32), kept


def _at_their_extremes(curves: FloatArray, shapes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The same motion with curves whose largest value is 1."""
    rows: IntArray = np.abs(curves).argmax(axis=0)
    extreme = curves[rows, np.arange(len(rows))]
    used = extreme != 0
    return curves[:, used] / extreme[used], shapes[used] * extreme[used, None]
