"""What shape keys stand at, frame after frame."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from bpy.types import Context, Object

from ...core.arrays import FloatArray
from ..background import Steps
from ..performance import check_visible, each_frame


def key_value_steps(context: Context, keys: Sequence[tuple[Object, str]], frames: Sequence[float]) -> Steps[FloatArray]:
    """(F, K) float32 values of shape keys, each an object and a name, as evaluated: drivers and the NLA count.

    Parameters
    ----------
    frames : scene frames; parts of frames are fine.

    Raises
    ------
    RetargetError : if an object is hidden: Blender does not evaluate it then.
    """
    things = list(dict.fromkeys(thing for thing, _ in keys))
    check_visible(things, context.view_layer)
    blocks = {thing: thing.data.shape_keys.key_blocks for thing in things}
    rows = {thing: {name: row for row, name in enumerate(held.keys())} for thing, held in blocks.items()}
    held = {thing: np.empty(len(rows[thing]), np.float32) for thing in things}
    values = np.empty((len(frames), len(keys)), np.float32)

    def read(i: int, frame: float) -> None:
        context.scene.frame_set(int(frame // 1), subframe=frame % 1)
        depsgraph = context.evaluated_depsgraph_get()
        for thing, found in held.items():
            thing.data.shape_keys.evaluated_get(depsgraph).key_blocks.foreach_get("value", found)
        values[i] = [held[thing][rows[thing][name]] for thing, name in keys]

    yield from each_frame(context.scene, frames, read)
    return values
