"""Where the texels of a light mesh lie on it, and on a fine mesh."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray, unit_vectors
from ..closest_point import SurfaceFinder
from ..mesh import TriMesh
from ..points import place_matrix
from ..raycast import RayCaster
from .surface import TexturedSurface
from .texels import Ring, Texels

_AGREEMENT = 0.2
"""A place of the fine mesh counts where its normal's dot product with the light mesh's is above this."""
_REACH = 0.05
"""How far from the light mesh the fine one is looked for, in sizes of the light mesh."""
_NEAR = 0.005
"""The same for a place that no ray has found."""
_JUMP = 3.0
"""Past a border of the texture, a place of the fine mesh that is this many times farther from the border's than the
light mesh's is another part of the face."""


class TexelPlaces(NamedTuple):
    """Texels with their places on the light mesh (T, 3), and face (T,) and weights (T, 3) on the fine one.

    The face is -1 where there is none.
    """

    texels: Texels
    place: FloatArray
    face: IntArray
    weights: FloatArray


def place_texels(
    surface: TexturedSurface, fine: TriMesh, texels: Texels, around: Ring | None, caster: RayCaster
) -> TexelPlaces:
    """Texels, and those around them if there are any, on both meshes in the neutral.

    Parameters
    ----------
    caster : over the fine mesh.
    """
    placed = _placed(surface, fine, texels, caster)
    return placed if around is None else _merged(placed, _ring_placed(surface, fine, around, caster))


def _placed(surface: TexturedSurface, fine: TriMesh, texels: Texels, caster: RayCaster) -> TexelPlaces:
    """Texels on both meshes."""
    mesh = surface.mesh
    light = place_matrix(mesh.faces[texels.face], texels.weights, len(mesh.vertices))
    places = light @ mesh.vertices
    outwards = unit_vectors(light @ surface.normals(mesh.vertices))
    return TexelPlaces(texels, places, *_places(places, outwards, fine, mesh.size, caster))


def _ring_placed(surface: TexturedSurface, fine: TriMesh, around: Ring, caster: RayCaster) -> TexelPlaces:
    """Texels past the borders of the texture: as if their triangle went on, or its edge where that finds nothing near.

    A shader that looks a border up on either side of it then sees the surface go on there. Those without a place on the
    fine mesh are left out.
    """
    edge, beyond = (
        _placed(surface, fine, Texels(around.pixel, around.face, weights), caster)
        for weights in (around.edge, around.beyond)
    )
    there = [np.einsum("tk,tki->ti", one.weights, fine.vertices[fine.faces[one.face]]) for one in (edge, beyond)]
    step = np.linalg.norm(beyond.place - edge.place, axis=1)
    near = np.linalg.norm(there[1] - there[0], axis=1) <= _JUMP * step
    kept = (beyond.face >= 0) & (edge.face >= 0) & near
    placed = TexelPlaces(
        Texels(around.pixel, around.face, np.where(kept[:, None], around.beyond, around.edge)),
        np.where(kept[:, None], beyond.place, edge.place),
        np.where(kept, beyond.face, edge.face),
        np.where(kept[:, None], beyond.weights, edge.weights),
    )
    found: BoolArray = placed.face >= 0
    return TexelPlaces(
        Texels(around.pixel[found], around.face[found], placed.texels.weights[found]),
        placed.place[found],
        placed.face[found],
        placed.weights[found],
    )


def _merged(one: TexelPlaces, other: TexelPlaces) -> TexelPlaces:
    """Texels of both, by their pixels."""
    order = np.argsort(np.concatenate([one.texels.pixel, other.texels.pixel]))
    return TexelPlaces(
        Texels(
            np.concatenate([one.texels.pixel, other.texels.pixel])[order],
            np.concatenate([one.texels.face, other.texels.face])[order],
            np.concatenate([one.texels.weights, other.texels.weights])[order],
        ),
        np.concatenate([one.place, other.place])[order],
        np.concatenate([one.face, other.face])[order],
        np.concatenate([one.weights, other.weights])[order],
    )


def _places(
    places: FloatArray, normals: FloatArray, fine: TriMesh, size: float, caster: RayCaster
) -> tuple[IntArray, FloatArray]:
    """Face (T,) and weights (T, 3) on the fine mesh for places (T, 3) with unit normals (T, 3); face -1 for none."""
    reach = _REACH * size
    best = np.full(len(places), np.inf)
    face, weights = np.full(len(places), -1, np.int64), np.zeros((len(places), 3))
    for sign in (1.0, -1.0):
        hits = caster.nearest(places, sign * normals, reach)
        agree = np.einsum("ti,ti->t", fine.face_normals[hits.face], normals) > _AGREEMENT
        better = hits.found & agree & (hits.distance < best)
        best[better], face[better], weights[better] = hits.distance[better], hits.face[better], hits.weights[better]
    lost: BoolArray = face < 0
    if lost.any():
        found = SurfaceFinder(fine).closest(places[lost], normals[lost], _AGREEMENT, _NEAR * size)
        face[lost], weights[lost] = found.face, found.weights
    return face, weights
