"""Normals as the colours of a picture."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray


def as_picture(vectors: FloatArray, directx: bool = False) -> FloatArray:
    """Unit normals (H, W, 3), row 0 at the bottom, as a picture (H, W, 3) of values from 0 to 1, row 0 on top.

    directx : green points down the texture, as DirectX has it; up otherwise, as OpenGL and Blender have it.
    """
    picture = 0.5 * vectors[::-1] + np.float32(0.5)
    if directx:
        picture[..., 1] = 1 - picture[..., 1]
    return picture


def as_pairs(pairs: FloatArray, directx: bool = False) -> FloatArray:
    """X and y of two unit vectors (H, W, 4), row 0 at the bottom, as a picture (H, W, 4) as `as_picture` has them."""
    picture = 0.5 * pairs[::-1] + np.float32(0.5)
    if directx:
        picture[..., 1::2] = 1 - picture[..., 1::2]
    return picture
