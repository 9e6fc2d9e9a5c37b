"""From pixels to rays and back, in double precision: a click lands where the artist sees it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .arrays import FloatArray


@dataclass(frozen=True, eq=False)
class View:
    """A view of the scene: perspective, orthographic or through a camera, shifted or not.

    Attributes
    ----------
    size : (2,) width and height, in pixels.
    view : (4, 4) world to view space: the eye at 0, looking along -z.
    window : (4, 4) view space to clip space, as OpenGL has it: -1 is the near plane.
    """

    size: FloatArray
    view: FloatArray
    window: FloatArray

    @cached_property
    def _to_world(self) -> FloatArray:
        inverse: FloatArray = np.linalg.inv(self.view)
        return inverse

    def ray(self, pixel: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Origin (3,) on the near plane and unit direction (3,) of the ray through a pixel (2,), in world space.

        Pixels count from the lower left corner.
        """
        across = 2.0 * np.asarray(pixel, np.float64) / self.size - 1.0
        near = np.linalg.solve(self.window, [*across, -1.0, 1.0])
        near = near[:3] / near[3]
        # The last row of an orthographic view is (0, 0, 0, 1).
        along = np.array([0.0, 0.0, -1.0]) if self.window[3, 3] else near
        turn = self._to_world[:3, :3]
        direction = turn @ along
        return turn @ near + self._to_world[:3, 3], direction / np.linalg.norm(direction)

    def pixels(self, positions: FloatArray) -> FloatArray:
        """(N, 2) where positions (N, 3) of the world are seen; NaN for those behind the eye."""
        clip = self._clip(positions)
        shown = clip[:, 3] > 0
        across = np.full((len(clip), 2), np.nan)
        across[shown] = clip[shown, :2] / clip[shown, 3:]
        pixels: FloatArray = 0.5 * (across + 1.0) * self.size
        return pixels

    def pixel_length(self, position: FloatArray) -> float:
        """Length in the world that one pixel shows at the depth of a position (3,)."""
        depth = self._clip(position[None])[0, 3]
        return float(2.0 * depth / (self.window[0, 0] * self.size[0]))

    def _clip(self, positions: FloatArray) -> FloatArray:
        ones = np.ones((len(positions), 1))
        clip: FloatArray = np.concatenate([positions, ones], axis=1) @ (self.window @ self.view).T
        return clip
