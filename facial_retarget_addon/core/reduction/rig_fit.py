"""Curves of shape keys that are there, so that they meet frames best."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray, IntArray, Progress, no_progress
from ..errors import RetargetError
from .keyed import Displacements, KeyedMotion, blocks, measured

_STEPS, _SETTLED = 2000, 1e-5
_RIDGE = 1e-6
"""Price of a key's value, against its shape: of keys that do the same, each takes a part."""


def fit_to_keys(
    displacements: Displacements,
    shapes: FloatArray,
    low: FloatArray,
    high: FloatArray,
    smoothness: float = 0.0,
    sparsity: float = 0.0,
    progress: Progress = no_progress,
) -> KeyedMotion:
    """Values of existing shape keys, within their ranges, that meet frames best.

    Bounded least squares over all frames at once, with a price on how much each curve bends from frame to frame, and
    one on the size of each value (the lasso): keys that add next to nothing stay at zero.

    Parameters
    ----------
    displacements : (F, V, 3) float32. shapes : (K, V, 3) displacements at value 1.
    low, high : (K,) range of each key.
    smoothness : price of a curve's second differences, against what the key moves: 0 for none, 1 for a lot.
    sparsity : price of a value, against what a key moves on the average: small keys are the first to go.

    Returns
    -------
    The keys with their curves; `errors` over all vertices that a frame or a key moves.

    Raises
    ------
    RetargetError : if shapes and frames have other vertices, a range is empty, or there is no key that moves anything.
    """
    if len(displacements.shape) != 3 or shapes.ndim != 3 or displacements.shape[1:] != shapes.shape[1:]:
        raise RetargetError(
            f"frames of shape {displacements.shape} and shape keys of shape {shapes.shape} arrived, "
            "expected (F, V, 3) and (K, V, 3) of the same vertices"
        )
    if not shapes.any():
        raise RetargetError(f"none of {len(shapes)} shape keys moves a vertex, expected keys to fit the frames with")
    if (low > high).any():
        key = int(np.argmax(low > high))
        raise RetargetError(f"shape key {key} ranges from {low[key]} to {high[key]}, expected a range")
    flat = shapes.reshape(len(shapes), -1).astype(np.float64)
    gram = flat @ flat.T
    size = gram.trace() / len(gram)
    wanted = np.empty((len(displacements), len(shapes)))
    for rows, block in blocks(displacements):
        wanted[rows] = block.reshape(len(block), -1) @ flat.T
    progress(0.2, "fitting the curves")
    priced = gram + _RIDGE * size * np.eye(len(gram))
    curves = _bounded(priced, wanted, smoothness * size, sparsity * size, low, high, progress)
    progress(1.0, "done")
    return measured(shapes.astype(np.float32), curves.astype(np.float32), displacements, _moving(shapes, displacements))


def residual_keys(displacements: Displacements, keyed: KeyedMotion, ranges: Sequence[slice]) -> KeyedMotion:
    """One more shape key per range of frames, for what the others leave: its first component, with its curve.

    Parameters
    ----------
    displacements : (F, V, 3) that `keyed` stands for. ranges : frames of each key; a key is 0 outside.
    """
    shapes, curves = [keyed.shapes], [keyed.curves]
    for rows in ranges:
        rest = np.concatenate(
            [(moved - keyed.displacements(few)).reshape(len(moved), -1) for few, moved in blocks(displacements, rows)]
        )
        strength, turned = np.linalg.eigh((rest @ rest.T).astype(np.float64))
        curve = turned[:, -1]
        shape = curve @ rest
        extreme = curve[np.abs(curve).argmax()] if strength[-1] > 0 else 1.0
        whole = np.zeros((len(keyed.curves), 1), np.float32)
        whole[rows, 0] = curve / extreme
        shapes.append((shape * extreme).reshape(1, -1, 3).astype(np.float32))
        curves.append(whole)
    every, values = np.concatenate(shapes), np.concatenate(curves, axis=1)
    return measured(every, values, displacements, _moving(every, displacements))


def _moving(shapes: FloatArray, displacements: Displacements) -> IntArray:
    """(M,) vertices that a shape (K, V, 3) or a frame (F, V, 3) moves."""
    moved = shapes.any(axis=(0, 2))
    for _, block in blocks(displacements):
        moved |= block.any(axis=(0, 2))
    return np.flatnonzero(moved)


def _bounded(
    gram: FloatArray,
    wanted: FloatArray,
    bending: float,
    spending: float,
    low: FloatArray,
    high: FloatArray,
    progress: Progress,
) -> FloatArray:
    """(F, K) values in the box that minimise half the squared error plus half of `bending` times the squared second
    differences plus `spending` times the sizes of the values.

    Accelerated proximal descent (Beck and Teboulle 2009, FISTA), started anew where it overshoots, until no value
    changes by more than 1e-5.
    """
    scale = 1 / np.sqrt(np.maximum(gram.diagonal(), 1e-12 * gram.diagonal().max()))
    scaled, aim = gram * scale[:, None] * scale, wanted * scale
    price = bending * scale**2
    steepest = float(np.linalg.eigvalsh(scaled)[-1]) + 16 * float(price.max())
    floor, roof, toll = low / scale, high / scale, spending * scale / steepest
    now = np.clip(np.zeros_like(aim), floor, roof)
    ahead, pace = now, 1.0
    for number in range(_STEPS):
        if number % 50 == 0:
            progress(0.2 + 0.7 * number / _STEPS, "fitting the curves")
        slope = ahead @ scaled - aim + price * _bent_twice(ahead)
        aside = ahead - slope / steepest
        before, now = now, np.clip(np.sign(aside) * np.maximum(np.abs(aside) - toll, 0.0), floor, roof)
        if ((ahead - now) * (now - before)).sum() > 0:
            pace = 1.0
        pace, last = (1 + np.sqrt(1 + 4 * pace * pace)) / 2, pace
        ahead = now + (last - 1) / pace * (now - before)
        if np.abs((now - before) * scale).max(initial=0.0) < _SETTLED:
            break
    values: FloatArray = now * scale
    return values


def _bent_twice(curves: FloatArray) -> FloatArray:
    """Half the slope of the curves' (F, K) squared second differences."""
    bent = np.zeros_like(curves)
    if len(curves) > 2:
        second = curves[2:] - 2 * curves[1:-1] + curves[:-2]
        bent[2:] += second
        bent[1:-1] -= 2 * second
        bent[:-2] += second
    return bent
