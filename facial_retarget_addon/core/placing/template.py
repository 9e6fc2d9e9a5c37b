"""The average face that points are predicted from, and how faces differ from it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np

from ..arrays import FloatArray, IntArray
from ..mpeg4.fdps import FDPS
from .face_table import LEFT_AND_MIDDLE

SPREADS = ((0.12, 0.9), (0.06, 0.35), (0.05, 0.12))
"""How faces differ from the average: amplitudes, and how far a difference reaches, both in eye separations."""
ALIKE = 0.9
"""How much the difference of one half is that of the other: 1 for faces that are all symmetric."""
_FLIP = np.array([-1.0, 1.0, 1.0])


@dataclass(frozen=True, eq=False)
class Template:
    """An average face: places and normals by name, in eye separations from the middle between the eyes.

    Attributes
    ----------
    names : (N,) MPEG-4 numbers and free names.
    places : (N, 3) axes left, up, forward.
    normals : (N, 3) unit.
    """

    names: tuple[str, ...]
    places: FloatArray
    normals: FloatArray

    @classmethod
    def from_rows(cls, rows: Mapping[str, Sequence[float]]) -> Template:
        """Of a table name -> x, y, z of the place and of the normal."""
        table = np.array(list(rows.values()), np.float64)
        return cls(tuple(rows), table[:, :3], table[:, 3:] / np.linalg.norm(table[:, 3:], axis=1, keepdims=True))

    def rows(self, names: Sequence[str]) -> IntArray:
        """(P,) rows of names that the template has."""
        return np.array([self._row[name] for name in names], np.int64)

    def has(self, name: str) -> bool:
        """Whether the template has a point of this name."""
        return name in self._row

    @cached_property
    def _row(self) -> dict[str, int]:
        return {name: k for k, name in enumerate(self.names)}

    @cached_property
    def covariance(self) -> FloatArray:
        """(3N, 3N) of the differences of faces from the average: place by place, x, y, z within each."""
        return likeness(self.places, self.places)


def likeness(first: FloatArray, second: FloatArray, alike: float = ALIKE) -> FloatArray:
    """(3N, 3M) covariance of how faces differ from the average at places (N, 3) and (M, 3) of the template.

    Sums of Gaussians; the two halves of a face differ alike, so that a point of one half tells of its partner, unless
    `alike` is 0.
    """
    same, across = _gaussians(first, second), _gaussians(first, second * _FLIP)
    both = same[:, None, :, None] * np.eye(3)[:, None, :] + alike * across[:, None, :, None] * np.diag(_FLIP)[:, None]
    whole: FloatArray = both.reshape(3 * len(first), 3 * len(second))
    return whole


def _gaussians(first: FloatArray, second: FloatArray) -> FloatArray:
    squared = ((first[:, None] - second) ** 2).sum(axis=2)
    total: FloatArray = np.sum([size**2 * np.exp(-squared / (2 * reach**2)) for size, reach in SPREADS], axis=0)
    return total


def partner(name: str) -> str:
    """The point of the other half: the standard's, or the same free name with l for r; itself on the middle line."""
    if name in FDPS:
        return FDPS[name].partner
    pieces = name.split("_")
    swapped = [{"l": "r", "r": "l"}.get(piece, piece) for piece in pieces]
    return "_".join(swapped)


@cache
def face_template() -> Template:
    """The average face of `face_table`, both halves."""
    right = {
        partner(name): (-x, y, z, -nx, ny, nz)
        for name, (x, y, z, nx, ny, nz) in LEFT_AND_MIDDLE.items()
        if partner(name) != name
    }
    return Template.from_rows(LEFT_AND_MIDDLE | right)
