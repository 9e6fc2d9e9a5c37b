"""Planes about which a surface is nearly symmetric."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..arrays import FloatArray, cross, unit_vectors
from ..closest_point import SurfaceFinder

DIRECTIONS = 160
"""Normals that are tried, spread over a half sphere, beside the axes of the mesh's units and of its mass."""
SAMPLES, TRIED = 3000, 400
"""Places of the surface that stand for it, and those of them that are mirrored."""
REFINED = 12
"""Planes that are refined, the best of those tried."""
ROUNDS = 12
"""Of refining a plane."""
KEPT = 0.8
"""Share of the places that count: hair, a turned neck and what one side alone has may differ."""
DIFFERENT = np.cos(np.radians(12.0))
"""Planes whose normals lie closer than this are one."""


Surroundings = Callable[[FloatArray], tuple[FloatArray, FloatArray, FloatArray]]
"""For places (N, 3): how far the surface is (N,), its place (N, 3) there and its normal (N, 3)."""


@dataclass(frozen=True, eq=False)
class Mirror:
    """Reflection about a plane: x -> x - 2 (n.x - d) n.

    Attributes
    ----------
    normal : (3,) unit. distance : from the origin along it.
    misfit : mean distance of mirrored places from the surface, in mesh units.
    """

    normal: FloatArray
    distance: float
    misfit: float = 0.0

    def apply(self, places: FloatArray) -> FloatArray:
        """Places (N, 3) mirrored."""
        mirrored: FloatArray = places - 2 * np.outer(places @ self.normal - self.distance, self.normal)
        return mirrored

    def turn(self, vectors: FloatArray) -> FloatArray:
        """Directions (N, 3) mirrored."""
        turned: FloatArray = vectors - 2 * np.outer(vectors @ self.normal, self.normal)
        return turned


def symmetry_planes(places: FloatArray, normals: FloatArray, most: int) -> list[Mirror]:
    """The planes about which a surface is most nearly symmetric, best first.

    Parameters
    ----------
    places, normals : (S, 3) samples of the surface.
    most : how many different planes to give at most.
    """
    tree = cKDTree(places)
    middle = places.mean(axis=0)
    axes = np.linalg.svd(places - middle, full_matrices=False)[2]
    tried = places[:: max(1, len(places) // TRIED)]
    planes = [Mirror(normal, float(normal @ middle)) for normal in np.concatenate([np.eye(3), axes, _half_sphere()])]
    misfits = [_misfit(tree.query(plane.apply(tried))[0]) for plane in planes]
    best = [planes[k] for k in np.argsort(misfits, kind="stable")[:REFINED]]

    def nearest(mirrored: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        away, sample = tree.query(mirrored)
        return away, places[sample], normals[sample]

    refined = sorted((_refined(plane, nearest, places, normals) for plane in best), key=lambda plane: plane.misfit)
    different: list[Mirror] = []
    for plane in refined:
        if all(abs(plane.normal @ other.normal) < DIFFERENT for other in different):
            different.append(plane)
    return different[:most]


def mirror_of_surface(mirror: Mirror, finder: SurfaceFinder, places: FloatArray, normals: FloatArray) -> Mirror:
    """A plane moved so that samples (S, 3) of a surface with normals (S, 3), mirrored, lie on the surface itself.

    On a symmetric surface the plane is exact, however the samples lie.
    """

    def nearest(mirrored: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        found = finder.closest(mirrored)
        return found.distance, found.point, finder.normals(found.face)

    return _refined(mirror, nearest, places, normals)


def _half_sphere() -> FloatArray:
    """(DIRECTIONS, 3) unit vectors on a spiral over a half sphere."""
    k = np.arange(DIRECTIONS)
    z = (k + 0.5) / DIRECTIONS
    turn = np.pi * (1 + np.sqrt(5.0)) * k
    across = np.sqrt(1 - z**2)
    return np.stack([across * np.cos(turn), across * np.sin(turn), z], axis=1)


def _misfit(distances: FloatArray) -> float:
    count = max(1, round(KEPT * len(distances)))
    return float(np.partition(distances, count - 1)[:count].mean())


def _refined(mirror: Mirror, nearest: Surroundings, places: FloatArray, normals: FloatArray) -> Mirror:
    """The plane about which most samples, mirrored, lie on the surface's tangent planes next to them.

    Gauss-Newton over the three freedoms of a plane; x' = x - 2 (n.x - d) n.
    """
    normal, distance = mirror.normal, mirror.distance
    middle = places.mean(axis=0)
    for _ in range(ROUNDS):
        now = Mirror(normal, distance)
        mirrored = now.apply(places)
        away, next_to, towards = nearest(mirrored)
        agree = np.einsum("sc,sc->s", now.turn(normals), towards) > 0.5
        kept = agree & (away <= np.quantile(away, KEPT))
        if kept.sum() < 10:
            break
        first = unit_vectors(cross(normal[None], np.eye(3)[[np.abs(normal).argmin()]]))[0]
        second = cross(normal[None], first[None])[0]
        x, towards = places[kept] - middle, towards[kept]
        gap = np.einsum("sc,sc->s", mirrored[kept] - next_to[kept], towards)
        # Turned about the samples' middle, where the plane lies d from.
        off = distance - float(middle @ normal)
        height, along = x @ normal - off, towards @ normal
        steps = [-2 * ((x @ t) * along + height * (towards @ t)) for t in (first, second)]
        change = np.linalg.lstsq(np.stack([*steps, 2 * along], axis=1), -gap, rcond=None)[0]
        normal = unit_vectors((normal + change[0] * first + change[1] * second)[None])[0]
        distance = float(middle @ normal) + off + float(change[2])
        if np.abs(change[:2]).max() < 1e-10:
            break
    found = Mirror(normal, distance)
    return Mirror(normal, distance, _misfit(nearest(found.apply(places))[0]))
