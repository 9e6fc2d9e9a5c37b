"""Which pixels of a texture a mesh covers, and where on the mesh they lie."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from scipy.ndimage import distance_transform_edt

from ..arrays import BoolArray, FloatArray, IntArray

_BLOCK = 1 << 21
"""Pixels that are looked at together."""
_EDGE = 1e-9
"""A pixel's centre counts as inside where its weights are above minus this."""
_TILES = 10, 100
"""How many UDIM tiles there are along u and v."""
_FOOTPRINT = 2**0.5
"""A bilinear look-up takes of pixels whose centres are less than this away, in pixels."""
_BEYOND = 1.0
"""How far out of its triangle a pixel may lie, in the triangle's heights, for the triangle's plane to say where."""


class Texels(NamedTuple):
    """The pixels that a mesh covers.

    pixel : (T,) row after row from the bottom left, ascending. face : (T,) triangle that covers each one's centre.
    weights : (T, 3) barycentric weights there.
    """

    pixel: IntArray
    face: IntArray
    weights: FloatArray


def rasterise(uvs: FloatArray, size: int, tile: tuple[int, int] = (0, 0)) -> Texels:
    """Pixels whose centres triangles cover; where several do, the last one has the pixel, as in Blender's bake.

    Parameters
    ----------
    uvs : (F, 3, 2) texture coordinates, v upwards.
    size : pixels along each side.
    tile : whole u and v of the UDIM tile to fill.
    """
    owner = np.full(size * size, -1, np.int64)
    held = np.zeros((size * size, 3))
    places = (uvs - np.asarray(tile)) * size - 0.5
    for rows, x, y in _candidates(places, size):
        a, b, c = (places[rows, k] for k in range(3))
        point = np.stack([x, y], axis=1).astype(np.float64)
        whole = _twice_area(a, b, c)
        with np.errstate(divide="ignore", invalid="ignore"):
            weights = np.stack([_twice_area(point, b, c), _twice_area(a, point, c)], axis=1) / whole[:, None]
        weights = np.column_stack([weights, 1 - weights.sum(axis=1)])
        inside = (weights > -_EDGE).all(axis=1)
        pixel = y[inside] * size + x[inside]
        # Of pixels named twice, NumPy keeps what was assigned last.
        owner[pixel], held[pixel] = rows[inside], weights[inside]
    covered = np.flatnonzero(owner >= 0)
    clean = np.clip(held[covered], 0.0, None)
    return Texels(covered, owner[covered], clean / clean.sum(axis=1, keepdims=True))


class Ring(NamedTuple):
    """The uncovered pixels that a shader mixes in along the borders of the texture.

    pixel : (R,) ascending. face : (R,) triangle closest to each one's centre.
    edge : (R, 3) weights of the closest place on it. beyond : (R, 3) weights of the centre itself, in the triangle's
    plane: one of them is negative. Those of `edge` where the triangle is too small to say.
    """

    pixel: IntArray
    face: IntArray
    edge: FloatArray
    beyond: FloatArray


def ring(uvs: FloatArray, size: int, tile: tuple[int, int], covered: IntArray) -> Ring:
    """Pixels of which a bilinear look-up inside triangles takes a part, other than the covered ones (T,).

    Those are among the ones whose centre is less than a pixel's diagonal from a triangle. Of triangles equally near the
    last has the pixel, as it has covered ones.

    Parameters
    ----------
    uvs, size, tile : as `rasterise`.
    """
    free = np.ones(size * size, bool)
    free[covered] = False
    places = (uvs - np.asarray(tile)) * size - 0.5
    area = _twice_area(*(places[:, k] for k in range(3)))
    found = [(np.empty(0, np.int64), np.empty(0, np.int64), np.empty(0), np.empty((0, 3)))]
    for rows, x, y in _candidates(np.concatenate([places - _FOOTPRINT, places + _FOOTPRINT], axis=1), size):
        near = free[y * size + x] & (area[rows] != 0)
        rows, point = rows[near], np.stack([x[near], y[near]], axis=1)
        edge = _closest_on_border(point, places[rows])
        distance = np.linalg.norm(np.einsum("tk,tki->ti", edge, places[rows]) - point, axis=1)
        near = distance < _FOOTPRINT
        found.append((point[near] @ [1, size], rows[near], distance[near], edge[near]))
    pixel, face, distance, edge = (np.concatenate(parts) for parts in zip(*found, strict=True))
    order = np.lexsort((-face, np.round(distance, 6), pixel))
    first = order[np.diff(pixel[order], prepend=-1) > 0]
    pixel, face, edge = pixel[first], face[first], edge[first]
    a, b, c = (places[face, k] for k in range(3))
    point = np.stack([pixel % size, pixel // size], axis=1)
    beyond = np.stack([_twice_area(point, b, c), _twice_area(a, point, c)], axis=1) / area[face, None]
    beyond = np.column_stack([beyond, 1 - beyond.sum(axis=1)])
    far = beyond.min(axis=1) < -_BEYOND
    return Ring(pixel, face, edge, np.where(far[:, None], edge, beyond))


def _closest_on_border(points: FloatArray, corners: FloatArray) -> FloatArray:
    """Weights (N, 3) of the places on the borders of triangles (N, 3, 2) that are closest to points (N, 2)."""
    best, weights = np.full(len(points), np.inf), np.zeros((len(points), 3))
    for k in range(3):
        start, side = corners[:, k], corners[:, (k + 1) % 3] - corners[:, k]
        length = np.einsum("ni,ni->n", side, side)
        share = np.einsum("ni,ni->n", points - start, side) / np.where(length > 0, length, 1.0)
        share = np.clip(share, 0.0, 1.0)
        distance = np.linalg.norm(start + share[:, None] * side - points, axis=1)
        better = distance < best
        best[better], weights[better] = distance[better], 0.0
        weights[better, k], weights[better, (k + 1) % 3] = 1 - share[better], share[better]
    return weights


def margin(covered: IntArray, size: int, width: int) -> tuple[IntArray, IntArray]:
    """Pixels (M,) within `width` of covered ones, and for each the row in `covered` of the nearest."""
    empty: BoolArray = np.ones((size, size), bool)
    empty.ravel()[covered] = False
    if width <= 0 or not len(covered):
        return np.empty(0, np.int64), np.empty(0, np.int64)
    distance, nearest = distance_transform_edt(empty, return_indices=True)
    around = np.flatnonzero((empty & (distance <= width)).ravel())
    at = nearest[0].ravel()[around].astype(np.int64) * size + nearest[1].ravel()[around]
    return around, np.searchsorted(covered, at)


def tiles(uvs: FloatArray) -> list[tuple[int, int]]:
    """The UDIM tiles (u, v) that triangles (F, 3, 2) lie in, by their middles, ascending.

    u of a tile goes from 0 to 9 and v from 0 to 99; triangles elsewhere have none. They repeat another tile's pixels,
    or are hidden.
    """
    found = np.unique(np.floor(uvs.mean(axis=1)).astype(np.int64), axis=0)
    return [(int(u), int(v)) for u, v in found if 0 <= u < _TILES[0] and 0 <= v < _TILES[1]]


def _candidates(places: FloatArray, size: int) -> Iterator[tuple[IntArray, IntArray, IntArray]]:
    """Triangles and the pixels (x, y) in their boxes, triangles ascending, in blocks."""
    low = np.clip(np.ceil(places.min(axis=1) - _EDGE), 0, size).astype(np.int64)
    high = np.clip(np.floor(places.max(axis=1) + _EDGE), -1, size - 1).astype(np.int64)
    extent = np.maximum(high - low + 1, 0)
    count = extent.prod(axis=1)
    end = np.cumsum(count)
    first = 0
    while first < len(count):
        last = max(int(np.searchsorted(end, end[first] - count[first] + _BLOCK)), first + 1)
        rows = np.repeat(np.arange(first, last), count[first:last])
        number = np.arange(len(rows)) - np.repeat(end[first:last] - count[first:last], count[first:last])
        number += end[first] - count[first]
        width = extent[rows, 0]
        yield rows, low[rows, 0] + number % width, low[rows, 1] + number // width
        first = last


def _twice_area(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    one, two = b - a, c - a
    area: FloatArray = one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]
    return area
