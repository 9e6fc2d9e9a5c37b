"""How a built-in face acts: Waters' muscles, a hinged jaw, lids that slide over the eyeballs, wrinkles.

Everything is a function of chart places, so any mesh of any built-in face acts alike, and a material
point moves the same way whichever mesh it is a vertex of. Contractions run from 0 (rest) to 1.

References: K. Waters, A muscle model for animating three-dimensional facial expression, 1987.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray
from .chart import LEFT_EYE, MOUTH, RIGHT_EYE, Lens
from .shapes import along, bell, blob, step
from .sculpt import Sculpture


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
    """

    root: tuple[float, float]
    insertion: tuple[float, float]
    zone: float
    reach: float
    pull: float
    lip: int = 0

    def field(self, places: FloatArray) -> FloatArray:
        """Chart displacement (N, 2) at full contraction; Waters 1987, equations for the linear muscle."""
        to_root = np.array(self.root) - places
        length = float(np.hypot(*np.subtract(self.root, self.insertion)))
        distance = np.maximum(np.hypot(*to_root.T), 1e-9)
        axis = np.subtract(self.root, self.insertion) / length
        angle = np.arccos(np.clip(to_root @ axis / distance, -1.0, 1.0))
        angular = np.cos(0.5 * np.pi * np.minimum(angle / self.zone, 1.0)) ** 2
        rising = np.sin(0.5 * np.pi * np.minimum(distance / length, 1.0)) ** 2
        falling = np.cos(0.5 * np.pi * np.clip((distance - length) / self.reach, 0.0, 1.0)) ** 2
        strength = self.pull * angular * rising * falling
        if self.lip:
            strength = strength * 0.5 * (1.0 + self.lip * MOUTH.side(places))
        return strength[:, None] * to_root / distance[:, None]


_PAIRED: dict[str, tuple[LinearMuscle, ...]] = {
    "frontalis_inner": (LinearMuscle((0.12, 1.50), (0.18, 0.27), 0.36, 0.28, 0.13),),
    "frontalis_outer": (LinearMuscle((0.72, 1.50), (0.68, 0.30), 0.36, 0.26, 0.12),),
    "corrugator": (LinearMuscle((-0.02, 0.06), (0.26, 0.28), 0.75, 0.30, 0.085),),
    "levator": (LinearMuscle((0.22, -0.05), (0.25, -0.85), 0.42, 0.30, 0.13, 1),),
    "zygomatic": (LinearMuscle((1.00, -0.45), (0.385, -1.07), 0.60, 0.46, 0.20),),
    "risorius": (LinearMuscle((1.05, -1.00), (0.385, -1.07), 0.50, 0.30, 0.13),),
    "depressor_anguli": (LinearMuscle((0.46, -1.72), (0.385, -1.07), 0.60, 0.34, 0.115),),
    "depressor_labii": (LinearMuscle((0.22, -1.95), (0.12, -1.12), 0.42, 0.10, 0.12, -1),),
    "squint": (LinearMuscle((0.56, 0.30), (0.66, -0.38), 0.75, 0.30, 0.075),),
}
LIDS = ("blink", "widen")
SINGLE = ("jaw", "pucker", "press", "mentalis")
SIDES = {"l": 1.0, "r": -1.0}

ACTIONS = (*(f"{name}_{side}" for name in (*_PAIRED, *LIDS) for side in SIDES), *SINGLE)
"""Names of the contractions, in the order of `contractions`."""

JAW_ANGLE = np.radians(21.0)


def contractions(*poses: Mapping[str, float]) -> FloatArray:
    """(F, A) contractions from poses; a paired name without side acts on both.

    Raises
    ------
    KeyError : for a name that is no action.
    """
    table = np.zeros((len(poses), len(ACTIONS)))
    column = {name: i for i, name in enumerate(ACTIONS)}
    for row, pose in enumerate(poses):
        for name, value in pose.items():
            for full in (name,) if name in column else (f"{name}_l", f"{name}_r"):
                table[row, column[full]] = value
    return table


class Acting:
    """Material points of a sculpture, ready to act.

    Parameters
    ----------
    sculpture : the face.
    places : (N, 2) chart places of the points.
    strength : action name without side -> factor on its contraction; an artist's own taste.
    """

    def __init__(self, sculpture: Sculpture, places: FloatArray, strength: Mapping[str, float] | None = None) -> None:
        self._sculpture = sculpture
        self._places = places
        self.neutral = sculpture.surface(places)
        tangents = sculpture.tangents(places)
        outward = sculpture.outward(places)
        self._gain = np.array(
            [(strength or {}).get(name.removesuffix("_l").removesuffix("_r"), 1.0) for name in ACTIONS]
        )
        fields, bulges = zip(*(_pull(name, places) for name in ACTIONS), strict=True)
        self._pulls = np.einsum("ank,nkc->anc", np.stack(fields), tangents)
        self._pulls += np.stack(bulges)[:, :, None] * outward * sculpture.scale
        self._wrinkles = _wrinkles(places)[:, :, None] * sculpture.normals(places) * sculpture.scale
        self._jaw = _jaw_weight(places)
        self._lids = [_Lids(sculpture, lens, side, places) for lens, side in ((LEFT_EYE, "l"), (RIGHT_EYE, "r"))]

    def frames(self, table: FloatArray) -> FloatArray:
        """Positions (F, N, 3) float32 under contractions (F, A)."""
        table = np.asarray(table, np.float64) * self._gain
        count = len(self.neutral)
        moved = np.tensordot(table, self._pulls, 1)
        moved += np.tensordot(_tension(table), self._wrinkles, 1)
        for lids in self._lids:
            lids.add(table, moved)
        moved += self.neutral
        self._open_jaw(table, moved)
        return moved.reshape(len(table), count, 3).astype(np.float32)

    def _open_jaw(self, table: FloatArray, positions: FloatArray) -> None:
        """Turn what hangs on the jaw about the axis through its joints, in place."""
        pivot = self._sculpture.jaw_joint
        hanging = np.flatnonzero(self._jaw)
        angle = JAW_ANGLE * table[:, ACTIONS.index("jaw"), None] * self._jaw[hanging]
        sine, cosine = np.sin(angle), np.cos(angle)
        y, z = (positions[:, hanging, k] - pivot[k] for k in (1, 2))
        positions[:, hanging, 1] = pivot[1] + cosine * y - sine * z
        positions[:, hanging, 2] = pivot[2] + sine * y + cosine * z


def _pull(action: str, places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Chart displacement (N, 2) and bulge along the normal (N,) of an action at full contraction."""
    x, y = places.T
    ax = np.abs(x)
    none = np.zeros(len(places))
    guard = np.minimum(*(step(lens.distance(places), 0.0, 0.16) for lens in (LEFT_EYE, RIGHT_EYE)))
    name, _, side = action.rpartition("_")
    if side in SIDES and name in _PAIRED:
        mirror = np.array([SIDES[side], 1.0])
        field = sum(muscle.field(places * mirror) for muscle in _PAIRED[name]) * mirror
        here = x * SIDES[side]
        bulge = none
        if name == "zygomatic":
            bulge = 0.055 * blob(here, y, 0.60, -0.55, 0.20, 0.17)
        elif name == "corrugator":
            bulge = 0.020 * blob(here, y, 0.17, 0.20, 0.09, 0.09)
        elif name == "squint":
            bulge = 0.018 * blob(here, y, 0.58, -0.26, 0.22, 0.07)
        return field * guard[:, None], bulge * guard
    upper, lower = (0.5 * (1.0 + s * MOUTH.side(places)) for s in (1.0, -1.0))
    rim = MOUTH.distance(places)
    if action == "pucker":
        # Waters' sphincter: towards the middle of the mouth, in an ellipse around it; lips come forward.
        towards = np.stack([-x, 0.25 * (MOUTH.y - y)], axis=1)
        weight = 0.42 * np.exp(-(((x / 0.60) ** 2 + ((y - MOUTH.y) / 0.36) ** 2) ** 2))
        return weight[:, None] * towards, 0.11 * np.exp(-((x / 0.22) ** 2) - (rim / 0.20) ** 2)
    if action == "press":
        weight = 0.030 * np.exp(-((rim / 0.13) ** 2)) * bell(x, 0.40)
        field = np.stack([none, weight * (lower - upper)], axis=1)
        return field, -0.045 * np.exp(-((rim / 0.12) ** 2)) * bell(x, 0.34)
    if action == "mentalis":
        weight = 0.085 * blob(x, y, 0.0, -1.42, 0.26, 0.24) * lower
        return np.stack([none, weight], axis=1), 0.02 * blob(x, y, 0.0, -1.45, 0.18, 0.10)
    return np.zeros((len(places), 2)), none + 0.0 * ax


# ---- jaw -----------------------------------------------------------------------------------------
def _jaw_weight(places: FloatArray) -> FloatArray:
    """How much of the jaw's turn a place takes part in, (N,) from 0 to 1."""
    x, y = places.T
    across = np.minimum(np.abs(x - MOUTH.x) / MOUTH.half_width, 1.0)
    beyond = np.maximum(np.abs(x) - MOUTH.half_width, 0.0)
    # The lips open to an oval: near the corners the lower one stays behind and the upper one follows.
    corner = 0.42
    lip = np.where(y > MOUTH.y, corner * across**4, 1.0 - (1.0 - corner) * across**3)
    cheek = step(y, -0.60, -1.50)
    near = np.exp(-((beyond / 0.30) ** 2) - (np.maximum(MOUTH.distance(places), 0.0) / 0.17) ** 2)
    side = 0.5 * (1.0 - MOUTH.side(places))
    far = cheek + 0.8 * np.exp(-((beyond / 0.45) ** 2)) * (side - cheek)
    weight = far + near * (lip - far)
    return weight * (1.0 - step(y, -1.85, -2.5)) * (1.0 - step(np.abs(x), 1.15, 1.72))


# ---- lids ----------------------------------------------------------------------------------------
_MEET = 0.14
"""Where shut lids meet, from the lower rim (0) to the upper (1)."""


class _Lids:
    """The lids of one eye, turning about the axis across the eyeball."""

    def __init__(self, sculpture: Sculpture, lens: Lens, side: str, places: FloatArray) -> None:
        self._columns = [ACTIONS.index(f"{name}_{side}") for name in ("blink", "widen", "squint")]
        centre = sculpture.eye_centre(SIDES[side])
        u = (places[:, 0] - lens.x) / lens.half_width
        above = places[:, 1] > lens.y
        high_rim, low_rim = (lens.arc(u, upper) for upper in (True, False))
        gap = np.where(above, places[:, 1] - high_rim[:, 1], low_rim[:, 1] - places[:, 1])
        share = (1.0 - step(gap, 0.0, np.where(above, 0.20, 0.17))) * (np.abs(u) < 1)
        self._rows = np.flatnonzero(share)
        rows, self._share, self._above = self._rows, share[self._rows], above[self._rows]
        # The rims at each place's own x: the angle between them is what the lids have to close.
        high, low = (sculpture.surface(rim[rows]) - centre for rim in (high_rim, low_rim))
        opening = _elevation(high) - _elevation(low)
        self._turn = self._share * opening
        self._position = sculpture.surface(places[rows]) - centre
        shut = _turned(low, _MEET * opening) - _turned(high, (_MEET - 1.0) * opening)
        self._rest = np.where(self._above, self._share, 0.0)[:, None] * shut

    def add(self, table: FloatArray, moved: FloatArray) -> None:
        """Add the lids' displacements under contractions (F, A) to (F, N, 3)."""
        blink, widen, squint = (table[:, k, None] for k in self._columns)
        down = (_MEET - 1.0) * blink + 0.30 * widen * (1.0 - blink)
        up = _MEET * blink + 0.26 * squint * (1.0 - blink) - 0.08 * widen * (1.0 - blink)
        moved[:, self._rows] += _turned(self._position, np.where(self._above, down, up) * self._turn) - self._position
        # What the turn leaves open, because the two rims are not equally far from the axis.
        moved[:, self._rows] += blink[..., None] * self._rest


def _elevation(from_centre: FloatArray) -> FloatArray:
    return np.asarray(np.arctan2(from_centre[:, 1], from_centre[:, 2]))


def _turned(from_axis: FloatArray, angle: FloatArray) -> FloatArray:
    """Positions (N, 3), relative to an axis along x, turned upwards by angles (..., N)."""
    sine, cosine = np.sin(angle), np.cos(angle)
    x, y, z = from_axis.T
    return np.stack([np.broadcast_to(x, angle.shape), cosine * y + sine * z, cosine * z - sine * y], axis=-1)


# ---- wrinkles ------------------------------------------------------------------------------------
_WRINKLED: Sequence[tuple[str, ...]] = (
    ("frontalis_inner_l", "frontalis_outer_l"),
    ("frontalis_inner_r", "frontalis_outer_r"),
    ("corrugator_l", "corrugator_r"),
    ("squint_l", "zygomatic_l"),
    ("squint_r", "zygomatic_r"),
    ("zygomatic_l", "levator_l"),
    ("zygomatic_r", "levator_r"),
    ("levator_l", "levator_r"),
)
"""Which contractions raise each wrinkle field of `_wrinkles`."""


def _tension(table: FloatArray) -> FloatArray:
    """How far each wrinkle field is raised (F, W): skin folds late, and not without end."""
    column = {name: i for i, name in enumerate(ACTIONS)}
    sums = np.stack([table[:, [column[name] for name in names]].sum(axis=1) for names in _WRINKLED], axis=1)
    return np.clip(sums, 0.0, None) ** 2 / (0.5 + np.clip(sums, 0.0, None))


def _wrinkles(places: FloatArray) -> FloatArray:
    """Heights (W, N) of the wrinkle fields, in chart units; wavelengths are 3 to 4 % of the face's width."""
    x, y = places.T
    fields = []
    for side in SIDES.values():
        here = side * x
        window = step(here, -0.2, 0.2) * (1.0 - step(here, 0.66, 0.98)) * along(y, 0.42, 0.88, 0.09)
        window = window * (1.0 - 0.4 * np.sin(4.0 * here + 9.0 * y) ** 2) * (1.0 - 0.5 * step(y, 0.5, 0.95))
        fields.append(0.0085 * window * _folds(y + 0.010 * np.cos(2 * np.pi * here / 1.3) + 0.05 * here**2, 0.088))
    window = bell(x, 0.085) * along(y, 0.16, 0.40, 0.08)
    fields.append(0.010 * window * _folds(x, 0.088))
    for side in SIDES.values():
        here = side * x
        dx, dy = here - 0.70, y + 0.01
        radius, angle = np.hypot(dx, dy), np.arctan2(dy, dx)
        window = along(radius, 0.15, 0.34, 0.06) * (1.0 - step(np.abs(angle + 0.05), 0.55, 0.95))
        fields.append(0.0065 * window * _folds(angle, 0.33))
    for side in SIDES.values():
        here = side * x
        line = 0.33 + 0.42 * (-0.60 - y) + 0.10 * (y + 0.60) ** 2
        across = (here - line) / 0.065
        fields.append(0.022 * along(-y, 0.60, 1.05, 0.10) * step(here, 0.15, 0.25) * across * np.exp(0.5 - across**2))
    window = bell(x, 0.17) * along(y, -0.16, 0.08, 0.06)
    fields.append(0.005 * window * _folds(y + 0.5 * x**2, 0.07))
    return np.stack(fields)


def _folds(t: FloatArray, wavelength: float) -> FloatArray:
    """Ridges with narrower furrows, band-limited to twice the base frequency."""
    phase = 2 * np.pi * t / wavelength
    return np.cos(phase) - 0.25 * np.cos(2 * phase)
