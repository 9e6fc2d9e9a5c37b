"""Marks as batches for the GPU: built once, drawn in every view."""

from __future__ import annotations

from collections.abc import Sequence

import gpu
import numpy as np
from gpu.types import GPUBatch
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix

from ..core.arrays import FloatArray
from .shaders import REACH, drawing, lens, linear, mark_shader

PLACED, PROPOSED, SELECTED, DOUBTFUL, NEXT = range(5)
"""Shapes of marks: a disc, a ring, a light disc in a ring, a warning triangle, a ring with ticks."""

COLOURS = (
    linear(0.25, 0.72, 1.0),
    linear(0.80, 0.93, 1.0),
    linear(1.0, 0.55, 0.10),
    linear(1.0, 0.84, 0.0),
    linear(1.0, 0.55, 0.10),
)
"""Of each shape. Skin is a shade of red and brown: blue and white stand out on light and dark skin alike."""

HIDDEN_STRENGTH = 0.13
"""How strongly marks behind a surface show."""

_CORNERS = REACH * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], np.float32)
_TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]], np.int32)


def mark_batch(places: FloatArray, shapes: Sequence[int]) -> GPUBatch:
    """Marks of the shapes (P,) at places (P, 3); the selected and the next one lie over the others."""
    count = len(places)
    order = np.argsort(np.isin(shapes, (SELECTED, NEXT)), kind="stable")
    looks = np.array([(*COLOURS[shape], shape) for shape in shapes], np.float32).reshape(-1, 4)
    corners = {
        "pos": np.repeat(np.asarray(places, np.float32), 4, axis=0),
        "corner": np.tile(_CORNERS, (count, 1)),
        "look": np.repeat(looks, 4, axis=0),
        "row": np.repeat(np.arange(count, dtype=np.float32), 4),
    }
    triangles = (4 * order[:, None, None] + _TRIANGLES).reshape(-1, 3).astype(np.int32)
    return batch_for_shader(mark_shader(), "TRIS", corners, indices=triangles)


def draw_marks(batch: GPUBatch, view: Matrix, projection: Matrix, size: float, hot: int, flat: bool) -> None:
    """Draw marks whose discs have a radius of `size` pixels.

    Parameters
    ----------
    view, projection : (4, 4) of the view.
    hot : the row of the mark under the mouse, which is a little larger; -1 for none.
    flat : not in depth; otherwise what lies behind a surface is dimmed.
    """
    shader = mark_shader()
    shader.bind()
    shader.uniform_float("matrix", projection @ view)
    shader.uniform_float("lens", lens(projection))
    shader.uniform_float("viewport", gpu.state.viewport_get()[2:])
    shader.uniform_float("size", size)
    shader.uniform_float("hot", float(hot))
    passes = (("NONE", 1.0),) if flat else (("GREATER", HIDDEN_STRENGTH), ("LESS_EQUAL", 1.0))
    for depth_test, strength in passes:
        with drawing(depth_test):
            shader.uniform_float("strength", strength)
            batch.draw(shader)
