"""From the world to the pixels of a view."""

from __future__ import annotations

from typing import Any

import numpy as np
from bpy.types import Context

from ..core.arrays import BoolArray, FloatArray


def screen_places(context: Context, places: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Pixels (P, 2), from the lower left of the region, of places (P, 3) in the world; (P,) whether before the eye."""
    matrix = np.array(context.region_data.perspective_matrix)
    clip = places @ matrix[:, :3].T + matrix[:, 3]
    ahead: BoolArray = clip[:, 3] > 1e-6
    shares = 0.5 + 0.5 * clip[:, :2] / np.where(ahead, clip[:, 3], 1.0)[:, None]
    return shares * (context.region.width, context.region.height), ahead


def toward_viewer(view: Any, places: FloatArray) -> FloatArray:
    """(P, 3) from places (P, 3) in the world to the eye of a region's view; of no particular length."""
    eye = np.array(view.view_matrix.inverted())
    if view.is_perspective:
        return eye[:3, 3] - places
    return np.broadcast_to(eye[:3, 2], places.shape)


def pixels_across(context: Context, middle: FloatArray, size: float) -> float:
    """How many pixels a thing of this size takes, at `middle` (3,) in the world; 0 behind the eye."""
    matrix, window = np.array(context.region_data.perspective_matrix), np.array(context.region_data.window_matrix)
    depth = float(matrix[3, :3] @ middle + matrix[3, 3])
    return 0.5 * context.region.height * float(window[1, 1]) * size / depth if depth > 1e-6 else 0.0
