"""The skin of a head: which of its faces points may lie on, and the nearest good place for a point."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..closest_point import Nearest, SurfaceFinder, some_places
from ..mesh import TriMesh
from ..raycast import CasterFactory
from .openings import FrontView

AGREEMENTS = (0.4, -0.2)
"""Smallest dot products of the surface's normal and that of the average face there: the first if it can be had."""
SLIP = 0.08
"""How much farther than the nearest place one with a better normal may be, in eye separations."""
COVERED = 0.3
"""Farther than this from all skin that can be seen, the skin lies under hair: what cannot be seen counts, too."""


class Skin:
    """The components of a mesh that hold its feature points."""

    def __init__(self, mesh: TriMesh, components: IntArray, outside: BoolArray, make_caster: CasterFactory) -> None:
        """Of the components with these labels of `mesh.components`; outside : (F,) faces seen from outside."""
        self._mesh, self._outside, self._make_caster = mesh, outside, make_caster
        self._faces = np.flatnonzero(np.isin(mesh.components[mesh.faces[:, 0]], components))

    @cached_property
    def finder(self) -> SurfaceFinder:
        """Of what can be seen from outside; of everything where nothing can."""
        seen = self._faces[self._outside[self._faces]]
        return SurfaceFinder(self._mesh, seen) if len(seen) else self._hidden

    @cached_property
    def _hidden(self) -> SurfaceFinder:
        return SurfaceFinder(self._mesh, self._faces)

    @cached_property
    def view(self) -> FrontView:
        """The skin alone, as it is seen from the front."""
        return FrontView.of(self._mesh, self._faces, self._outside, self._make_caster)

    def closest(self, places: FloatArray, normals: FloatArray, unit: float) -> Nearest:
        """The best place of the skin for each point: near, on the outside, and looking the same way.

        Parameters
        ----------
        places, normals : (N, 3).
        unit : one eye separation.
        """
        near = self.finder.closest(places)
        covered = near.distance > COVERED * unit
        if covered.any():
            near = _with(near, covered, self._hidden.closest(places[covered]))
        farthest = near.distance + SLIP * unit
        for agreement in AGREEMENTS[::-1]:
            better = self.finder.closest(places, normals, agreement, float(farthest.max(initial=0.0)))
            good = ~covered & (better.distance <= farthest)
            near = _with(near, good, some_places(better, np.flatnonzero(good)))
        return near


def _with(places: Nearest, rows: BoolArray, better: Nearest) -> Nearest:
    """The places with others in some rows (N,)."""
    whole = some_places(places, np.arange(len(rows)))
    for mine, other in zip(whole, better, strict=True):
        mine[rows] = other
    return whole
