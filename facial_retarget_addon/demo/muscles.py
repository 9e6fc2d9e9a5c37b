"""The muscles of a built-in face, as fields on the chart.

A field says where skin slides on the chart, and how far it bulges, when one muscle contracts fully.
Equal chart places move alike on every built-in face.

References: K. Waters, A muscle model for animating three-dimensional facial expression, 1987.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray
from .chart import LEFT_EYE, MOUTH, RIGHT_EYE
from .smooth import bell, blob, dome, step


@dataclass(frozen=True)
class LinearMuscle:
    """A muscle that pulls skin towards its root on the bone, in a sector seen from there.

    Attributes
    ----------
    root, insertion : chart places of its two ends on the face's left.
    zone : half angle of the sector, in radians.
    reach : how far beyond the insertion the pull fades out, in chart units.
    pull : how far the skin at the insertion moves at full contraction, in chart units.
    lip : 1 spares the lower lip, -1 the upper, 0 neither.
    bulge : height of the flesh that gathers, and its middle and size on the chart.
    """

    root: tuple[float, float]
    insertion: tuple[float, float]
    zone: float
    reach: float
    pull: float
    lip: int = 0
    bulge: tuple[float, float, float, float, float] | None = None

    def field(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Slide on the chart (N, 2) and bulge (N,) at places (N, 2).

        Waters' linear muscle: the pull falls off with the angle from the muscle's axis, rises from the root to
        the insertion, and fades beyond it.
        """
        to_root = np.array(self.root) - places
        axis = np.subtract(self.root, self.insertion)
        length = float(np.hypot(*axis))
        distance = np.maximum(np.hypot(to_root[:, 0], to_root[:, 1]), 1e-9)
        angle = np.arccos(np.clip(to_root @ axis / (distance * length), -1.0, 1.0))
        strength = self.pull * np.cos(0.5 * np.pi * np.minimum(angle / self.zone, 1.0)) ** 2
        strength *= np.sin(0.5 * np.pi * np.minimum(distance / length, 1.0)) ** 2
        strength *= np.cos(0.5 * np.pi * np.clip((distance - length) / self.reach, 0.0, 1.0)) ** 2
        if self.lip:
            strength *= 0.5 * (1.0 + self.lip * MOUTH.side(places))
        bulge = np.zeros(len(places))
        if self.bulge:
            height, *where = self.bulge
            bulge = height * blob(places[:, 0], places[:, 1], *where)
        return strength[:, None] * to_root / distance[:, None], bulge


_PAIRED: dict[str, LinearMuscle] = {
    "frontalis_inner": LinearMuscle((0.12, 1.50), (0.18, 0.27), 0.36, 0.28, 0.13),
    "frontalis_outer": LinearMuscle((0.72, 1.50), (0.66, 0.30), 0.36, 0.26, 0.145),
    "corrugator": LinearMuscle((-0.02, 0.06), (0.26, 0.28), 0.75, 0.30, 0.085, bulge=(0.020, 0.17, 0.20, 0.09, 0.09)),
    "depressor_supercilii": LinearMuscle((0.42, -0.35), (0.46, 0.30), 0.62, 0.22, 0.075),
    "squint": LinearMuscle((0.56, 0.30), (0.66, -0.38), 0.75, 0.30, 0.075, bulge=(0.018, 0.58, -0.26, 0.22, 0.07)),
    "nasalis": LinearMuscle(
        (0.16, 0.12), (0.20, -0.62), 0.34, 0.20, 0.060, lip=1, bulge=(0.018, 0.15, -0.24, 0.07, 0.14)
    ),
    "levator": LinearMuscle((0.22, -0.05), (0.25, -0.85), 0.42, 0.30, 0.13, lip=1),
    "zygomatic": LinearMuscle((1.00, -0.45), (0.385, -1.07), 0.60, 0.60, 0.20, bulge=(0.055, 0.60, -0.55, 0.20, 0.17)),
    "risorius": LinearMuscle((1.05, -1.00), (0.385, -1.07), 0.50, 0.30, 0.13),
    "buccinator": LinearMuscle(
        (0.95, -1.00), (0.40, -1.07), 0.50, 0.24, 0.075, bulge=(-0.050, 0.49, -1.07, 0.10, 0.13)
    ),
    "depressor_anguli": LinearMuscle((0.46, -1.72), (0.385, -1.07), 0.60, 0.34, 0.115),
    "depressor_labii": LinearMuscle((0.22, -1.95), (0.12, -1.12), 0.42, 0.10, 0.12, lip=-1),
}
SIDES = {"l": 1.0, "r": -1.0}
_EYE = ("blink", "widen", "tighten", "look_up", "look_aside")
_JAW = ("jaw", "jaw_forward", "jaw_aside", "seal", "tongue_out")

_SOFT_MIDDLE = 0.22
"""How far from the middle line one half of the lips takes part in what the other does."""


def _about_mouth(places: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Places x (N,) and y (N,) from the middle of the mouth, distance (N,) from its rim, and which lip.

    The lip (N,) is 1 above and -1 below, as in `Lens.side`.
    """
    return places[:, 0] - MOUTH.x, places[:, 1] - MOUTH.y, MOUTH.distance(places), MOUTH.side(places)


def _upright(height: FloatArray) -> FloatArray:
    """Slides (N, 2) straight up by heights (N,)."""
    return np.stack([np.zeros(len(height)), height], axis=1)


def _pucker(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Waters' sphincter: skin moves to the middle of the mouth, in an ellipse around it; the lips come forward."""
    x, y, rim, _ = _about_mouth(places)
    weight = 0.42 * dome((x / 0.60) ** 2 + (y / 0.36) ** 2, 2.0)
    return weight[:, None] * np.stack([-x, -0.25 * y], axis=1), 0.11 * bell(x, 0.22) * bell(rim, 0.20)


def _funnel(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The corners come in, and the lips part and flare forward, as for a trumpet."""
    x, y, rim, side = _about_mouth(places)
    inwards = -0.30 * x * dome((x / 0.60) ** 2 + (y / 0.40) ** 2, 2.0)
    apart = side * np.where(side > 0, 0.065, 0.105) * bell(rim, 0.22) * dome((x / 0.31) ** 2, 1.5)
    return np.stack([inwards, apart], axis=1), 0.12 * bell(x, 0.26) * bell(rim, 0.17)


def _press(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The lips are pressed together and drawn in."""
    x, _, rim, side = _about_mouth(places)
    down = 0.030 * bell(rim, 0.13) * bell(x, 0.40) * side
    return _upright(-down), -0.045 * bell(rim, 0.12) * bell(x, 0.34)


def _puff(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Air fills the cheeks, and some of it the space before the teeth."""
    x, y = places.T
    cheeks = 0.150 * blob(np.abs(x), y, 0.60, -0.96, 0.25, 0.30)
    return np.zeros((len(places), 2)), cheeks + 0.045 * bell(x, 0.40) * (bell(y + 0.92, 0.10) + bell(y + 1.29, 0.10))


def _upper_up(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The upper lip is raised off the teeth."""
    x, _, rim, side = _about_mouth(places)
    up = 0.062 * 0.5 * (1.0 + side) * bell(rim, 0.24) * dome((x / 0.34) ** 2, 1.6)
    return _upright(up), 0.25 * up


def _lower_down(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The lower lip is lowered off the teeth."""
    x, _, rim, side = _about_mouth(places)
    down = 0.100 * 0.5 * (1.0 - side) * bell(rim, 0.26) * dome((x / 0.34) ** 2, 1.6)
    return _upright(-down), 0.25 * down


def _roll_upper(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    return _rolled(places, 1.0)


def _roll_lower(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    return _rolled(places, -1.0)


def _rolled(places: FloatArray, lip: float) -> tuple[FloatArray, FloatArray]:
    """One lip, 1 the upper and -1 the lower, rolls in over the teeth: its red goes inside, the skin around follows."""
    x, _, rim, side = _about_mouth(places)
    own = 0.5 * (1.0 + lip * side) * bell(x, 0.31)
    down = own * 0.095 * bell(rim - 0.12, 0.11)
    return _upright(-lip * down), -0.15 * own * bell(rim, 0.12)


def _shrug_upper(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The upper lip comes up and forward; the lower one stays on it."""
    x, _, rim, side = _about_mouth(places)
    upper = 0.5 * (1.0 + side)
    lift = bell(x, 0.30) * (0.035 * bell(rim, 0.10) + 0.030 * upper * (bell(rim, 0.22) - bell(rim, 0.10)))
    return _upright(lift), bell(x, 0.27) * bell(rim, 0.13) * (0.012 + 0.045 * upper)


def _shrug_lower(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The chin pushes the lower lip up and out; the upper one gives way."""
    x, y, rim, side = _about_mouth(places)
    lower = 0.5 * (1.0 - side)
    lift = bell(x, 0.30) * (0.055 * bell(rim, 0.12) + 0.050 * lower * (bell(rim, 0.34) - bell(rim, 0.12)))
    return _upright(lift), bell(x, 0.27) * bell(rim, 0.14) * (0.014 + 0.060 * lower) + 0.015 * blob(
        x, y, 0.0, -0.40, 0.18, 0.10
    )


def _mentalis(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The chin rises and takes the lower lip along."""
    x, y = places.T
    up = 0.085 * blob(x, y, 0.0, -1.42, 0.26, 0.24) * 0.5 * (1.0 - MOUTH.side(places))
    return _upright(up), 0.02 * blob(x, y, 0.0, -1.45, 0.18, 0.10)


def _mouth_aside(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The whole mouth goes to the left, and the lips thrust forward a little."""
    x, y, _, _ = _about_mouth(places)
    weight = 0.15 * dome((x / 0.72) ** 2 + (y / 0.44) ** 2, 1.4)
    return weight[:, None] * np.array([1.0, 0.0]), np.zeros(len(places))


_IN_HALVES = {"press": _press, "puff": _puff, "upper_up": _upper_up, "lower_down": _lower_down}
_WHOLE = {
    "pucker": _pucker,
    "funnel": _funnel,
    "roll_upper": _roll_upper,
    "roll_lower": _roll_lower,
    "shrug_upper": _shrug_upper,
    "shrug_lower": _shrug_lower,
    "mentalis": _mentalis,
    "mouth_aside": _mouth_aside,
}

ACTIONS = (*(f"{name}_{side}" for name in (*_PAIRED, *_EYE, *_IN_HALVES) for side in SIDES), *_JAW, *_WHOLE)
"""Names of the contractions: muscles of either side, lids and gaze, jaw, and what the lips do as a whole.

`look_up` and what goes `aside` may be negative: down, and to the right. `seal` keeps the lips together, whatever the
jaw does.
"""


def column(action: str) -> int:
    """Column of an action in a table of contractions."""
    return ACTIONS.index(action)


def contractions(*poses: Mapping[str, float]) -> FloatArray:
    """(F, A) contractions from F poses, 0 at rest and 1 full; a paired name without its side acts on both.

    Raises
    ------
    ValueError : for a name that is no action.
    """
    table = np.zeros((len(poses), len(ACTIONS)))
    for row, pose in enumerate(poses):
        for name, value in pose.items():
            for full in (name,) if name in ACTIONS else (f"{name}_l", f"{name}_r"):
                table[row, column(full)] = value
    return table


def fields(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """What each action does to chart places (N, 2): slides (A, N, 2) and bulges (A, N); none by eyes, jaw, tongue."""
    slides = np.zeros((len(ACTIONS), len(places), 2))
    bulges = np.zeros((len(ACTIONS), len(places)))
    # No muscle drags a lid off its eyeball.
    guard = np.minimum(*(step(lens.distance(places), 0.0, 0.16) for lens in (LEFT_EYE, RIGHT_EYE)))
    for name, muscle in _PAIRED.items():
        for side, sign in SIDES.items():
            mirror = np.array([sign, 1.0])
            slide, bulge = muscle.field(places * mirror)
            row = column(f"{name}_{side}")
            slides[row], bulges[row] = slide * mirror * guard[:, None], bulge * guard
    for name, action in _IN_HALVES.items():
        slide, bulge = action(places)
        for side, sign in SIDES.items():
            half = step(sign * places[:, 0], -_SOFT_MIDDLE, _SOFT_MIDDLE)
            row = column(f"{name}_{side}")
            slides[row], bulges[row] = slide * half[:, None], bulge * half
    for name, action in _WHOLE.items():
        slides[column(name)], bulges[column(name)] = action(places)
    return slides, bulges
