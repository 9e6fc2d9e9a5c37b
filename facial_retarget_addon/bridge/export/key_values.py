"""What shape keys do frame after frame, whatever moves them: curves, drivers, the NLA, an evaluation time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from bpy.types import Context, Key, Object

from ...core.arrays import FloatArray, IntArray
from ...core.errors import RetargetError
from ..background import Steps
from ..curves import find_curves
from ..key_sets import key_names
from ..performance import check_visible, each_frame

MOST_SAMPLES = 8
"""Samples of a frame at most."""
WHOLE = 1e-3
"""Frames from a sample below which a keyframe lies on it."""

KeyValues = Mapping[Object, FloatArray]
"""An object -> (F, K) float32 values of its shape keys, those of `key_names`, as relative ones."""


def read_key_values(context: Context, things: Sequence[Object], times: Sequence[float]) -> Steps[KeyValues]:
    """The values of all shape keys of some objects as evaluated at scene frames; a muted key is 0.

    Raises
    ------
    RetargetError : if an object is hidden, or has absolute keys that are not interpolated on straight lines.
    """
    check_visible(things, context.view_layer)
    keyed = {thing: thing.data.shape_keys for thing in things if thing.data.shape_keys is not None}
    rows, values = {}, {}
    for thing, keys in keyed.items():
        _check_linear(thing, keys)
        places = {name: row for row, name in enumerate(keys.key_blocks.keys())}
        rows[thing] = np.array([places[name] for name in key_names(thing)], np.int64)
        values[thing] = np.zeros((len(times), len(rows[thing])), np.float32)

    def read(i: int, time: float) -> None:
        context.scene.frame_set(int(time // 1), subframe=time % 1)
        depsgraph = context.evaluated_depsgraph_get()
        for thing, keys in keyed.items():
            values[thing][i] = _values(keys.evaluated_get(depsgraph))[rows[thing]]

    yield from each_frame(context.scene, times, read)
    return values


def _values(keys: Key) -> FloatArray:
    """(K,) values of evaluated keys; absolute ones share 1 between the two that the evaluation time lies between."""
    blocks = keys.key_blocks
    values, mutes = np.empty(len(blocks), np.float32), np.empty(len(blocks), bool)
    if keys.use_relative:
        blocks.foreach_get("value", values)
        blocks.foreach_get("mute", mutes)
        return np.where(mutes, np.float32(0), values)
    blocks.foreach_get("frame", values)
    order = np.argsort(values)
    place = np.interp(keys.eval_time, values[order], np.arange(len(order)))
    values[order] = np.maximum(1 - np.abs(place - np.arange(len(order))), 0)
    return values


def _check_linear(thing: Object, keys: Key) -> None:
    bent = [] if keys.use_relative else [key for key in keys.key_blocks if key.interpolation != "KEY_LINEAR"]
    if bent:
        raise RetargetError(
            f"absolute shape key {bent[0].name!r} of object {thing.name!r} is interpolated as {bent[0].interpolation}, "
            "expected KEY_LINEAR: other ways cannot become relative keys"
        )


def turning_rows(values: FloatArray) -> IntArray:
    """Rows of values (F,) that a curve of straight lines needs: the first, the last, those beside a change."""
    changes = np.flatnonzero(np.diff(values))
    return np.unique([0, len(values) - 1, *changes, *(changes + 1)]).astype(np.int64)


def samples_per_frame(things: Sequence[Object]) -> int:
    """How many samples of a frame, at most `MOST_SAMPLES`, meet all keyframes of some objects; 0 if no number does."""
    curves = [bag.fcurves for thing in things for bag in map(find_curves, _animated(thing)) if bag is not None]
    times = [_keyframes(curve) for bag in curves for curve in bag]
    frames = np.unique(np.concatenate(times)) if times else np.zeros(1)
    for count in range(1, MOST_SAMPLES + 1):
        if np.abs(frames * count - np.round(frames * count)).max() < WHOLE * count:
            return count
    return 0


def _animated(thing: Object) -> list:
    keys = thing.data.shape_keys
    return [thing] if keys is None else [thing, keys]


def _keyframes(curve: object) -> FloatArray:
    flat = np.empty(2 * len(curve.keyframe_points))
    curve.keyframe_points.foreach_get("co", flat)
    return flat[::2]
