"""Lines and triangles over a surface as batches for the GPU: built once, drawn in every view."""

from __future__ import annotations

from collections.abc import Sequence

import gpu
import numpy as np
from gpu.types import GPUBatch
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix

from ..core.arrays import FloatArray
from .shaders import drawing, lens, line_shader

_SIDES = np.array([[0, -1], [0, 1], [1, 1], [1, -1]], np.float32)
_TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]], np.int32)


def line_batch(pieces: FloatArray) -> GPUBatch:
    """Straight pieces (L, 2, 3)."""
    ends = np.asarray(pieces, np.float32)
    count = len(ends)
    corners = {
        "start": np.repeat(ends[:, 0], 4, axis=0),
        "end": np.repeat(ends[:, 1], 4, axis=0),
        "side": np.tile(_SIDES, (count, 1)),
    }
    triangles = (4 * np.arange(count)[:, None, None] + _TRIANGLES).reshape(-1, 3).astype(np.int32)
    return batch_for_shader(line_shader(), "TRIS", corners, indices=triangles)


def triangle_batch(corners: FloatArray) -> GPUBatch:
    """Triangles (T, 3, 3), as their sides: what folds over stands on edge, where its area is not seen."""
    return line_batch(np.asarray(corners)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2, 3))


def draw_lines(
    batch: GPUBatch,
    view: Matrix,
    projection: Matrix,
    width: float,
    colour: Sequence[float],
    strength: float = 1.0,
    through: bool = False,
) -> None:
    """Draw lines of this width in pixels, with dark sides.

    Parameters
    ----------
    view, projection : (4, 4) of the view.
    colour : linear.
    strength : 1 for what covers, 0 for nothing.
    through : what a surface hides shows through it.
    """
    shader = line_shader()
    shader.bind()
    shader.uniform_float("matrix", projection @ view)
    shader.uniform_float("lens", lens(projection))
    shader.uniform_float("viewport", gpu.state.viewport_get()[2:])
    shader.uniform_float("width", width)
    shader.uniform_float("strength", strength)
    shader.uniform_float("colour", colour)
    with drawing("NONE" if through else "LESS_EQUAL"):
        batch.draw(shader)
