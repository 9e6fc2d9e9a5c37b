"""The chart that every built-in face is drawn on.

A chart place (x, y) is a material point: the same place is the same bit of skin on every built-in
face, so correspondences are exact whatever the meshes are. One unit is about one eye separation, x
runs to the face's left, y up, the pupils' line is y = 0. The eyes and the mouth are lenses cut out of
the chart: two arcs of circles that meet in the corners.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray


@dataclass(frozen=True)
class Lens:
    """An opening: upper and lower arc between two corners on one height.

    Attributes
    ----------
    x, y : middle between the corners.
    half_width : from there to a corner.
    upper, lower : heights of the arcs above and below the corners' line, greater than zero.
    """

    x: float
    y: float
    half_width: float
    upper: float
    lower: float

    def arc(self, u: FloatArray, upper: bool) -> FloatArray:
        """Places (N, 2) of an arc at u (N,), -1 at the right corner (-x) to 1 at the left."""
        sagitta = self.upper if upper else self.lower
        radius, centre = _circle(self.half_width, sagitta)
        x = self.half_width * np.clip(u, -1.0, 1.0)
        height = np.sqrt(np.maximum(radius**2 - x**2, 0.0)) + centre
        return np.stack([self.x + x, self.y + (height if upper else -height)], axis=-1)

    def distances(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Signed distances (N,), (N,) of places (N, 2) from the discs whose arcs are the upper and lower rim."""
        dx, dy = places[:, 0] - self.x, places[:, 1] - self.y
        found = []
        for side, sagitta in ((1.0, self.upper), (-1.0, self.lower)):
            radius, centre = _circle(self.half_width, sagitta)
            found.append(np.hypot(dx, side * dy - centre) - radius)
        return found[0], found[1]

    def distance(self, places: FloatArray) -> FloatArray:
        """Distance (N,) of places (N, 2) from the opening, zero on its rim and negative inside."""
        beyond = np.maximum(np.abs(places[:, 0] - self.x) - self.half_width, 0.0)
        nearest = np.maximum(*self.distances(places))
        return np.where(beyond > 0, np.hypot(beyond, np.maximum(nearest, 0.0)), nearest)

    def grown(self, width: float) -> Lens:
        """The opening with `width` added all around."""
        return Lens(self.x, self.y, self.half_width + width, self.upper + width, self.lower + width)

    def side(self, places: FloatArray) -> FloatArray:
        """Which lid or lip a place (N, 2) belongs to: (N,) 1 above, -1 below, turning smoothly beyond the corners."""
        dx, dy = places[:, 0] - self.x, places[:, 1] - self.y
        beyond = np.maximum(np.abs(dx) - self.half_width, 0.0)
        side: FloatArray = dy / np.sqrt(dy**2 + beyond**2 + 1e-12)
        return side


def _circle(half_width: float, sagitta: float) -> tuple[float, float]:
    """Radius of the circle through both corners and the arc's top, and the height of its centre."""
    radius = (half_width**2 + sagitta**2) / (2 * sagitta)
    return radius, sagitta - radius


LEFT_EYE = Lens(0.525, -0.005, 0.235, 0.092, 0.058)
RIGHT_EYE = Lens(-0.525, -0.005, 0.235, 0.092, 0.058)
MOUTH = Lens(0.0, -1.075, 0.385, 0.022, 0.022)
OPENINGS = (LEFT_EYE, RIGHT_EYE, MOUTH)

LOW = np.array([-1.72, -2.55])
HIGH = np.array([1.72, 1.50])
"""Corners of the rectangle that the chart's outline is drawn from."""


def rounded(places: FloatArray) -> FloatArray:
    """Places (N, 2) of that rectangle drawn into an outline with round corners."""
    middle, half = 0.5 * (LOW + HIGH), 0.5 * (HIGH - LOW)
    u, v = ((places - middle) / half).T
    corner = (u * v) ** 2
    drawn: FloatArray = middle + half * np.stack([u * (1.0 - 0.17 * corner), v * (1.0 - 0.14 * corner)], axis=1)
    return drawn


def brow_line(x: FloatArray) -> FloatArray:
    """Chart y (N,) of the brows at |x| (N,)."""
    line: FloatArray = 0.225 + 0.085 * np.sin(2.9 * np.clip(x - 0.12, 0.0, 1.0))
    return line
