"""Places spread over a surface that stand for it where speed counts more than the last digit."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from ..arrays import BoolArray, FloatArray
from ..mesh import TriMesh

NEIGHBOURS = 8
"""Samples next to a place among which one that looks the same way is looked for."""


def surface_samples(mesh: TriMesh, count: int) -> tuple[FloatArray, FloatArray]:
    """Places (count, 3) spread evenly over a surface by area, and the normals (count, 3) there: the same every time."""
    ends = np.cumsum(mesh.face_areas)
    rng = np.random.default_rng(0)
    face = np.searchsorted(ends, ends[-1] * (np.arange(count) + 0.5) / count)
    weights = rng.dirichlet([1.0, 1.0, 1.0], count)
    return np.einsum("nk,nkc->nc", weights, mesh.vertices[mesh.faces[face]]), mesh.face_normals[face]


class Ahead(NamedTuple):
    """Where the surface lies along a normal: offset (N,), distance of the sample (N,), whether one was met (N,)."""

    offset: FloatArray
    distance: FloatArray
    met: BoolArray


class Beside(NamedTuple):
    """The sample next to each place: its place (N, 3), its normal (N, 3), and how far its tangent plane is (N,)."""

    place: FloatArray
    normal: FloatArray
    distance: FloatArray


class SurfaceSamples:
    """Samples of a surface, and the tangent planes in them."""

    def __init__(self, mesh: TriMesh, count: int) -> None:
        self._places, self._normals = surface_samples(mesh, count)
        self._tree = cKDTree(self._places)
        self._spacing = 2 * float(np.sqrt(mesh.area / count))

    def ahead(self, places: FloatArray, normals: FloatArray, agreement: float, reach: float) -> Ahead:
        """How far the surface lies from places (N, 3) along unit normals (N, 3).

        The tangent plane of the nearest sample counts whose normal agrees.

        Parameters
        ----------
        agreement : smallest dot product of the normals, greater than zero.
        reach : samples farther away do not count.
        """
        distance, near = self._tree.query(places, k=NEIGHBOURS, distance_upper_bound=reach)
        found = np.minimum(near, len(self._places) - 1)
        facing = np.einsum("nkc,nc->nk", self._normals[found], normals)
        good = np.isfinite(distance) & (facing >= agreement)
        first = good.argmax(axis=1)
        rows = np.arange(len(places))
        met = good[rows, first]
        sample, cosine = found[rows, first], np.maximum(facing[rows, first], agreement)
        offset = np.einsum("nc,nc->n", self._places[sample] - places, self._normals[sample]) / cosine
        return Ahead(np.where(met, offset, 0.0), np.where(met, distance[rows, first], np.inf), met)

    def beside(self, places: FloatArray, normals: FloatArray, agreement: float) -> Beside:
        """The nearest sample whose normal agrees with a place's (N, 3); the nearest of all where none nearby does."""
        near = self._tree.query(places, k=NEIGHBOURS)[1]
        facing = np.einsum("nkc,nc->nk", self._normals[near], normals)
        sample = near[np.arange(len(places)), (facing >= agreement).argmax(axis=1)]
        gap = places - self._places[sample]
        away = np.abs(np.einsum("nc,nc->n", gap, self._normals[sample]))
        # Beside the border of the surface its tangent planes go on, but it does not.
        distance = np.maximum(away, np.linalg.norm(gap, axis=1) - self._spacing)
        return Beside(self._places[sample], self._normals[sample], distance)
