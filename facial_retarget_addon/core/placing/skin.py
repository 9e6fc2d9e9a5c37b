"""The skin of a head: which of its faces points may lie on, and the nearest good place for a point."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..closest_point import Nearest, SurfaceFinder, some_places
from ..mesh import TriMesh
from ..raycast import CasterFactory
from .openings import FrontView
from .samples import SurfaceSamples, surface_samples
from .symmetry import SAMPLES, Mirror, mirror_of_surface, symmetry_planes

PLANES = 3
"""Planes of symmetry that are believed, at most."""
WORSE = 2.0
"""A plane whose misfit is this many times the best one's is none."""
SURFACE_SAMPLES = 20_000
"""Places that stand for the skin while the average face is bent to it."""
EXACT_SAMPLES = 800
"""Places of the skin that make its planes exact."""
AGREEMENTS = (0.4, -0.2)
"""Smallest dot products of the surface's normal and that of the average face there: the first if it can be had."""
SLIP = 0.08
"""How much farther than the nearest place one with a better normal may be, in eye separations."""
COVERED = 0.3
"""Farther than this from all skin that can be seen, the skin lies under hair: what cannot be seen counts, too."""


class Skin:
    """The pieces of a mesh that hold its feature points."""

    def __init__(
        self, mesh: TriMesh, faces: IntArray, outside: BoolArray, balls: IntArray, make_caster: CasterFactory
    ) -> None:
        """Of these faces (S,); outside : (F,) those of the mesh seen from outside; balls : (B,) its eyeballs' faces."""
        self._mesh, self._outside, self._balls, self._make_caster = mesh, outside, balls, make_caster
        self._faces = faces

    @cached_property
    def finder(self) -> SurfaceFinder:
        """Of what can be seen from outside; of everything where nothing can."""
        seen = self._faces[self._outside[self._faces]]
        return SurfaceFinder(self._mesh, seen) if len(seen) else self.whole

    @cached_property
    def samples(self) -> SurfaceSamples:
        """Of what can be seen from outside; of everything where nothing can."""
        seen = self._faces[self._outside[self._faces]]
        faces = seen if len(seen) else self._faces
        return SurfaceSamples(TriMesh(self._mesh.vertices, self._mesh.faces[faces]), SURFACE_SAMPLES)

    @cached_property
    def whole(self) -> SurfaceFinder:
        """Of all of the skin, the inside of the mouth with it."""
        return SurfaceFinder(self._mesh, self._faces)

    @cached_property
    def view(self) -> FrontView:
        """The skin alone, as it is seen from the front."""
        return FrontView.of(self._mesh, self._faces, self._outside, self._balls, self._make_caster)

    @cached_property
    def surface(self) -> TriMesh:
        """The skin alone, on all vertices of the mesh."""
        return TriMesh(self._mesh.vertices, self._mesh.faces[self._faces])

    @cached_property
    def mirrors(self) -> list[Mirror]:
        """The planes about which the skin is nearly symmetric, best first."""
        places, normals = surface_samples(self.surface, SAMPLES)
        planes = symmetry_planes(places, normals, PLANES)
        return [plane for plane in planes if plane.misfit <= WORSE * planes[0].misfit]

    @cached_property
    def exact_mirrors(self) -> list[Mirror]:
        """The same planes, exact where the skin is symmetric."""
        places, normals = surface_samples(self.surface, EXACT_SAMPLES)
        return [mirror_of_surface(mirror, self.whole, places, normals) for mirror in self.mirrors]

    def closest(self, places: FloatArray, normals: FloatArray, unit: float) -> Nearest:
        """The best place of the skin for each point: near, on the outside, and looking the same way.

        Parameters
        ----------
        places, normals : (N, 3).
        unit : one eye separation.
        """
        near = closest_looking(self.finder, places, normals, unit)
        covered = near.distance > COVERED * unit
        if covered.any():
            near = _with(near, covered, closest_looking(self.whole, places[covered], normals[covered], unit))
        return near


def closest_looking(finder: SurfaceFinder, places: FloatArray, normals: FloatArray, unit: float) -> Nearest:
    """The closest places, or ones little farther away that look the way of the normals.

    Parameters
    ----------
    places, normals : (N, 3).
    unit : one eye separation.
    """
    near = finder.closest(places)
    farthest = near.distance + SLIP * unit
    left = np.arange(len(places))
    for agreement in AGREEMENTS:
        if not len(left):
            break
        better = finder.closest(places[left], normals[left], agreement, float(farthest[left].max(initial=0.0)))
        good = better.distance <= farthest[left]
        near = _with(near, left[good], some_places(better, np.flatnonzero(good)))
        left = left[~good]
    return near


def _with(places: Nearest, rows: BoolArray | IntArray, better: Nearest) -> Nearest:
    """The places with others in some rows."""
    whole = some_places(places, np.arange(len(places.face)))
    for mine, other in zip(whole, better, strict=True):
        mine[rows] = other
    return whole
