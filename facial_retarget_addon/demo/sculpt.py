"""The shape of a built-in face: chart places to positions, as one smooth analytic function.

A base sheet (profile curve times cross-sections) carries relief along its outward direction: smooth
bumps, and smooth unions of bulges where flesh meets in a crease (nose wings, lids over the eyeballs).
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.interpolate import CubicSpline

from ..core.arrays import FloatArray, cross, unit_vectors
from .chart import LEFT_EYE, MOUTH, RIGHT_EYE, brow_line
from .smooth import along, bell, blob, cushion, dome, roll, smooth_max, step

# chart y: profile Y and Z without nose and lips, half width, depth of the side, rise of the side
_PROFILE = np.array(
    [
        [1.80, 1.54, -0.36, 0.44, 0.40, 0.00],
        [1.55, 1.42, -0.10, 0.62, 0.60, 0.00],
        [1.30, 1.245, 0.175, 0.80, 0.78, 0.00],
        [1.05, 1.04, 0.385, 0.94, 0.89, 0.00],
        [0.83, 0.83, 0.52, 1.02, 0.94, 0.00],
        [0.57, 0.57, 0.59, 1.07, 0.97, 0.00],
        [0.32, 0.32, 0.61, 1.09, 0.97, 0.00],
        [0.05, 0.05, 0.585, 1.10, 0.96, 0.00],
        [-0.30, -0.30, 0.575, 1.12, 0.95, 0.00],
        [-0.70, -0.70, 0.62, 1.11, 0.97, 0.02],
        [-1.06, -1.06, 0.65, 1.05, 0.98, 0.06],
        [-1.35, -1.35, 0.63, 0.97, 0.98, 0.16],
        [-1.55, -1.55, 0.62, 0.91, 0.97, 0.28],
        [-1.70, -1.68, 0.575, 0.87, 0.93, 0.38],
        [-1.82, -1.755, 0.49, 0.83, 0.86, 0.44],
        [-2.00, -1.80, 0.32, 0.77, 0.73, 0.42],
        [-2.25, -1.87, 0.11, 0.71, 0.60, 0.33],
        [-2.55, -2.06, -0.03, 0.68, 0.52, 0.22],
        [-2.90, -2.38, -0.08, 0.67, 0.50, 0.15],
    ]
)
_SPLINE = CubicSpline(_PROFILE[::-1, 0], _PROFILE[::-1, 1:])
_AROUND = 1.10
"""Chart units of x per radian around the head."""

_EYE_RADIUS = 0.255
_LID = 0.028
"""Thickness of a lid."""
_EYE_DEPTH = 0.012
"""How far the front of an eyeball lies behind the base sheet."""


@dataclass(frozen=True)
class Shape:
    """What makes one face differ from another: gains on the relief, 1 for the actor, and its size."""

    scale: float = 1.0
    brow: float = 1.0
    socket: float = 1.0
    cheekbone: float = 1.0
    hollow: float = 1.0
    temple: float = 1.0
    nose: float = 1.0
    nose_width: float = 1.0
    muzzle: float = 1.0
    lips: float = 1.0
    chin: float = 1.0
    eye: float = 1.0
    profile: tuple[tuple[float, float, float, float], ...] = ()
    """Chart y, and there: added height, added depth, factor on the width; smooth in between."""


@dataclass(frozen=True)
class Sculpture:
    """The surface of one face, over the chart."""

    shape: Shape = field(default_factory=Shape)

    @property
    def scale(self) -> float:
        """Units per eye separation."""
        return self.shape.scale

    @property
    def jaw_joint(self) -> FloatArray:
        """(3,) on the axis along x that the jaw turns about: below its joints, which slide forward as it opens."""
        return self.scale * np.array([0.0, -0.70, -1.05])

    def eye_centre(self, side: float) -> FloatArray:
        """(3,) middle of an eyeball: side 1 for the left, -1 for the right."""
        lens = LEFT_EYE if side > 0 else RIGHT_EYE
        middle = self._sheet(np.array([[lens.x, lens.y]]))[0][0]
        inwards = np.array([side * 0.012, 0.0, _EYE_DEPTH + _EYE_RADIUS * self.shape.eye])
        centre: FloatArray = self.scale * (middle - inwards)
        return centre

    @property
    def eye_radius(self) -> float:
        """Radius of an eyeball."""
        return self.scale * _EYE_RADIUS * self.shape.eye

    def surface(self, places: FloatArray) -> FloatArray:
        """Positions (N, 3) of chart places (N, 2); +Y up, the face looks along +Z."""
        base, outward = self._sheet(places)
        relief = _relief(places, self.shape)
        for side, lens in ((1.0, LEFT_EYE), (-1.0, RIGHT_EYE)):
            # The lid lies on the eyeball, and where lid and brow meet there is a crease.
            centre = self.eye_centre(side) / self.scale
            radius = _EYE_RADIUS * self.shape.eye
            lid, chord = _ball(base - centre, outward, radius + _LID)
            lifted = smooth_max(relief, lid, 0.045) - relief
            relief += step(chord, 0.0, 0.8 * radius) * lifted
            relief -= 0.050 * roll(lens.distance(places), 0.024)
        positions = base + relief[:, None] * outward
        rims = self._sheet(np.array([[MOUTH.x, MOUTH.y + MOUTH.upper], [MOUTH.x, MOUTH.y - MOUTH.lower]]))[0]
        positions[:, 1] += (rims[0, 1] - rims[1, 1]) * _closed_lips(places)
        return self.scale * positions

    def sheet(self, places: FloatArray) -> FloatArray:
        """Positions (N, 3) of the base sheet: the face without its relief."""
        return self.scale * self._sheet(places)[0]

    def outward(self, places: FloatArray) -> FloatArray:
        """(N, 3) unit directions of the relief."""
        return self._sheet(places)[1]

    def tangents(self, places: FloatArray) -> FloatArray:
        """(N, 2, 3) change of the base sheet, relief left out, per chart unit along x and y."""
        steps = 1e-4 * np.eye(2)
        moved = [self._sheet(places + move)[0] - self._sheet(places - move)[0] for move in steps]
        tangents: FloatArray = self.scale * np.stack(moved, axis=1) / 2e-4
        return tangents

    def normals(self, places: FloatArray) -> FloatArray:
        """(N, 3) unit normals of the surface, by differences over a hundredth of an eye separation."""
        steps = 0.005 * np.eye(2)
        along_x, along_y = (self.surface(places + move) - self.surface(places - move) for move in steps)
        return unit_vectors(cross(along_x, along_y))

    def _sheet(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Positions and outward directions (N, 3) of the base sheet, in eye separations."""
        height, depth, width, side, rise = _SPLINE(places[:, 1]).T
        if self.shape.profile:
            y, *change = np.array(sorted(self.shape.profile)).T
            up, forward, wider = CubicSpline(y, np.stack(change, axis=1), bc_type="clamped")(
                np.clip(places[:, 1], y[0], y[-1])
            ).T
            height, depth, width = height + up, depth + forward, width * wider
        angle = places[:, 0] / _AROUND
        sine, cosine = np.sin(angle), np.cos(angle)
        base = np.stack([width * sine, height + rise * (1 - cosine), depth - side * (1 - cosine)], axis=1)
        outward = np.stack([np.sin(0.75 * angle), 0.0 * angle, np.cos(0.75 * angle)], axis=1)
        # Under the chin the way out leads down.
        under = step(places[:, 1], -1.60, -1.95) * (1.0 - 0.8 * step(places[:, 1], -2.2, -2.6))
        return base, unit_vectors(outward + under[:, None] * np.array([0.0, -1.6, -0.3]))


def _ball(from_centre: FloatArray, outward: FloatArray, radius: float) -> tuple[FloatArray, FloatArray]:
    """How far (N,) places lie under a ball's front, along `outward`, and half the chord there; 0 where it misses."""
    forward = np.einsum("ni,ni->n", from_centre, outward)
    inside = radius**2 - np.einsum("ni,ni->n", from_centre, from_centre) + forward**2
    chord = np.sqrt(np.maximum(inside, 0.0))
    return chord - forward, chord


def _closed_lips(places: FloatArray) -> FloatArray:
    """How far (N,) the lips move up and down to meet, in heights of the chart's mouth, which is a gap."""
    above, below = MOUTH.distances(places)
    across = np.clip(1.0 - ((places[:, 0] - MOUTH.x) / MOUTH.half_width) ** 2, 0.0, 1.0)
    down, up = (0.525 * step(d, 0.16, 0.0) * across for d in (above, below))
    return np.where(places[:, 1] > MOUTH.y, -down, up)


def _relief(places: FloatArray, shape: Shape) -> FloatArray:
    """Height (N,) of the skin over the base sheet, in eye separations, eyelids left out."""
    x, y = places.T
    ax = np.sqrt(x**2 + 4e-4)
    # bones
    h = shape.brow * 0.050 * along(ax, 0.14, 0.86, 0.16) * bell(y - brow_line(ax), 0.10)
    h -= 0.012 * blob(x, y, 0.0, 0.26, 0.08, 0.12)
    h += 0.030 * blob(ax, y, 0.42, 0.62, 0.25, 0.20)
    h -= shape.temple * 0.045 * blob(ax, y, 1.12, 0.30, 0.20, 0.28)
    h += shape.cheekbone * 0.070 * blob(ax, y, 0.78, -0.36, 0.28, 0.19, -0.35)
    h += 0.055 * blob(ax, y, 0.55, -0.55, 0.25, 0.25)
    h -= shape.hollow * 0.028 * blob(ax, y, 0.80, -0.98, 0.22, 0.30)
    h += 0.050 * blob(ax, y, 1.12, -1.30, 0.25, 0.25)
    # eye sockets
    h -= shape.socket * 0.160 * blob(ax, y, 0.51, 0.02, 0.235, 0.150)
    h -= (0.5 + 0.5 * shape.socket) * 0.165 * blob(ax, y, 0.260, 0.005, 0.115, 0.13)
    h -= 0.020 * blob(ax, y, 0.45, -0.20, 0.18, 0.05, -0.25)
    # mouth and chin
    h += shape.muzzle * 0.075 * blob(x, y, 0.0, -1.03, 0.36, 0.26)
    h -= 0.050 * blob(x, y, 0.0, -1.315, 0.22, 0.055)
    h += shape.chin * 0.075 * blob(x, y, 0.0, -1.56, 0.19, 0.14)
    h -= 0.018 * blob(ax, y, 0.47, -1.12, 0.10, 0.11)
    h -= 0.012 * bell(ax - (0.38 + 0.42 * (-0.65 - y)), 0.085) * along(-y, 0.66, 1.00, 0.16)
    h += _nose(x, ax, y, shape)
    return np.asarray(h + _lips(places, x, ax, y, shape))


def _nose(x: FloatArray, ax: FloatArray, y: FloatArray, shape: Shape) -> FloatArray:
    x, ax = x / shape.nose_width, ax / shape.nose_width
    ridge = _NOSE_HEIGHT(np.clip(y, -0.80, 0.30))
    width = _NOSE_WIDTH(np.clip(y, -0.80, 0.30))
    bridge = ridge * bell(x, width)
    tip = 0.345 * dome((x / 0.175) ** 2 + ((y + 0.525) / 0.145) ** 2, 1.2)
    wing = 0.190 * dome(((ax - 0.185) / 0.120) ** 2 + ((y + 0.585) / 0.112) ** 2, 1.5)
    septum = 0.15 * blob(x, y, 0.0, -0.63, 0.075, 0.10)
    nose = smooth_max(smooth_max(bridge, tip, 0.06), wing, 0.045)
    nose = smooth_max(nose, septum, 0.03)
    nostril = 0.060 * blob(ax, y, 0.118, -0.662, 0.050, 0.030, 0.35)
    crease = 0.022 * blob(ax, y, 0.32, -0.55, 0.05, 0.09)
    return np.asarray(shape.nose * (nose - crease) - nostril)


_NOSE_HEIGHT = CubicSpline(
    [-0.80, -0.72, -0.64, -0.56, -0.48, -0.35, -0.20, -0.05, 0.08, 0.20, 0.30],
    [0.0, 0.02, 0.13, 0.30, 0.33, 0.26, 0.185, 0.12, 0.07, 0.03, 0.0],
    bc_type="clamped",
)
_NOSE_WIDTH = CubicSpline(
    [-0.80, -0.6, -0.45, -0.2, 0.0, 0.15, 0.30], [0.14, 0.15, 0.145, 0.15, 0.125, 0.14, 0.20], bc_type="clamped"
)


def _lips(places: FloatArray, x: FloatArray, ax: FloatArray, y: FloatArray, shape: Shape) -> FloatArray:
    above, below = MOUTH.distances(places)
    rim = MOUTH.distance(places)
    across = np.clip(1.0 - (x / (MOUTH.half_width + 0.01)) ** 2, 0.0, 1.0)
    upper_height = 0.135 * across**0.7 - 0.016 * bell(x, 0.04) + 0.012
    lower_height = 0.165 * across**0.6 + 0.012
    upper = 0.085 * across**0.6 * cushion(np.maximum(above, 0.0) / upper_height)
    lower = 0.105 * across**0.6 * cushion(np.maximum(below, 0.0) / lower_height)
    h = shape.lips * np.where(y > MOUTH.y, upper, lower)
    h += 0.018 * bell(x, 0.16) * blob(x, y, 0.0, MOUTH.y + 0.075, 1.0, 0.03)
    philtrum = along(-y, 0.74, 0.94, 0.05)
    h += philtrum * (0.010 * bell(ax - 0.080, 0.036) - 0.009 * bell(x, 0.04))
    return np.asarray(h - 0.13 * (0.2 + 0.8 * across) * roll(rim, 0.085))
