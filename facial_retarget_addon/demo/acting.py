"""Contractions to positions: muscles, then lids and wrinkles, then the jaw that carries them all."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..core.arrays import FloatArray
from .chart import LEFT_EYE, MOUTH, RIGHT_EYE
from .lids import Lids
from .muscles import ACTIONS, column, fields
from .sculpt import Sculpture
from .smooth import bell, step
from .wrinkles import tension, wrinkle_fields

JAW_ANGLE = np.radians(12.2)
"""How far the jaw turns at full contraction."""
JAW_SHIFTS = {"jaw_forward": ((0.0, -0.015, 0.125), 0.25), "jaw_aside": ((0.17, 0.0, 0.0), 0.3)}
"""How far the jaw shifts, in eye separations, and which share of that moves one lip against the other."""


class Acting:
    """Material points of a sculpture, ready to act.

    Parameters
    ----------
    sculpture : the face.
    places : (N, 2) chart places of the points.
    manner : action name without side -> factor on its contraction; an artist's own taste.

    Attributes
    ----------
    neutral : (N, 3) float32 positions at rest, in the sculpture's units.
    """

    def __init__(self, sculpture: Sculpture, places: FloatArray, manner: Mapping[str, float]) -> None:
        self.neutral = sculpture.surface(places).astype(np.float32)
        self._gain = np.array([manner.get(name.removesuffix("_l").removesuffix("_r"), 1.0) for name in ACTIONS])
        slides, bulges = fields(places)
        pulls = np.einsum("ank,nkc->anc", slides, sculpture.tangents(places))
        pulls += sculpture.scale * bulges[..., None] * sculpture.outward(places)
        folds = sculpture.scale * wrinkle_fields(places)[..., None] * sculpture.normals(places)
        self._pulls, self._folds = pulls.astype(np.float32), folds.astype(np.float32)
        self._lids = [Lids(sculpture, lens, side, places) for lens, side in ((LEFT_EYE, "l"), (RIGHT_EYE, "r"))]
        weight, sealed = _jaw_weight(places), _jaw_weight(places, sealed=True)
        for name, (shift, share) in JAW_SHIFTS.items():
            carried = (sealed + share * (weight - sealed)) * (1.0 - step(np.abs(places[:, 0]), 0.60, 1.35))
            self._pulls[column(name)] = sculpture.scale * carried[:, None] * np.array(shift)
        self._hanging = np.flatnonzero(np.maximum(weight, sealed))
        self._jaw = weight[self._hanging].astype(np.float32)
        self._sealed = sealed[self._hanging].astype(np.float32)
        self._from_joint = (self.neutral[self._hanging] - sculpture.jaw_joint).astype(np.float32)

    def felt(self, table: FloatArray) -> FloatArray:
        """Contractions (F, A) in the artist's own manner."""
        return np.asarray(table, np.float64) * self._gain

    def displacements(self, table: FloatArray, wrinkles: float = 1.0) -> FloatArray:
        """Displacements (F, N, 3) float32 under contractions (F, A); zero, exactly, where nothing contracts.

        Parameters
        ----------
        table : as `contractions` makes it.
        wrinkles : factor on the height of the wrinkles.
        """
        table = self.felt(table)
        moved = np.tensordot(table.astype(np.float32), self._pulls, 1)
        moved += np.tensordot(wrinkles * tension(table).astype(np.float32), self._folds, 1)
        for lids in self._lids:
            lids.add(table, moved)
        self._turn_jaw(table, moved)
        return moved

    def _turn_jaw(self, table: FloatArray, moved: FloatArray) -> None:
        """Turn what hangs on the jaw about the axis through its joints; displacements, in place."""
        jaw, seal = (table[:, column(name), None].astype(np.float32) for name in ("jaw", "seal"))
        angle = JAW_ANGLE * jaw * (self._jaw + seal * (self._sealed - self._jaw))
        from_joint = moved[:, self._hanging] + self._from_joint
        moved[:, self._hanging] += turned_down(from_joint, angle) - from_joint


def turned_down(from_axis: FloatArray, angle: FloatArray) -> FloatArray:
    """Positions (F, N, 3), relative to an axis along x, turned by angles (F, N) so that what lies before it sinks."""
    sine, versine = np.sin(angle), 2 * np.sin(0.5 * angle) ** 2
    turned = from_axis.copy()
    y, z = from_axis[..., 1], from_axis[..., 2]
    turned[..., 1] -= versine * y + sine * z
    turned[..., 2] += sine * y - versine * z
    return turned


def _jaw_weight(places: FloatArray, sealed: bool = False) -> FloatArray:
    """How much of the jaw's turn a place takes part in, (N,) from 0 to 1; with sealed lips, both by the same."""
    x, y = places.T
    across = np.minimum(np.abs(x - MOUTH.x) / MOUTH.half_width, 1.0)
    beyond = np.maximum(np.abs(x - MOUTH.x) - MOUTH.half_width, 0.0)
    # The lips open to an oval: near the corners the lower one stays behind and the upper one follows.
    corner = 0.42
    lip = np.where(y > MOUTH.y, corner * across**4, 1.0 - (1.0 - corner) * across**3)
    if sealed:
        lip = corner + 0.12 * (1.0 - across**2) ** 2
    reach = 0.28 if sealed else 0.17
    near = bell(beyond, 0.30) * bell(np.maximum(MOUTH.distance(places), 0.0), reach)
    cheek = step(y, -0.60, -1.50)
    lower = 0.5 * (1.0 - MOUTH.side(places))
    far = cheek + 0.8 * bell(beyond, 0.45) * (lower - cheek)
    weight = far + near * (lip - far)
    return np.asarray(weight * (1.0 - step(y, -1.70, -2.55)) * (1.0 - step(np.abs(x), 0.85, 1.65)))
