"""Tangents as MikkTSpace has them, which Blender and the game engines shade normal maps with."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from ..arrays import FloatArray, IntArray, unit_vectors


class TangentSpace:
    """Which corners of a textured mesh share a tangent; their tangents follow for any positions.

    Corners share one where they share vertex and texture coordinates, their triangles are neighbours around the vertex
    over edges that are whole in the texture, and both lie the same way round in it.

    Parameters
    ----------
    faces : (F, 3) vertices. uvs : (F, 3, 2) texture coordinates of the corners.

    Attributes
    ----------
    group : (F, 3) rows of the tangents. count : tangents. vertex : (G,) vertex of each one.
    sign : (F,) 1, or -1 where the texture is mirrored.

    References
    ----------
    Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", and the rules of his MikkTSpace.
    """

    def __init__(self, faces: IntArray, uvs: FloatArray) -> None:
        self._faces = faces
        one, two = uvs[:, 1] - uvs[:, 0], uvs[:, 2] - uvs[:, 0]
        area = one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]
        self.sign = np.where(area > 0, 1.0, -1.0).astype(np.float32)
        # Tangents along u: d(position) / du, up to a positive factor.
        turned = (self.sign * (area != 0))[:, None]
        self._along = turned * np.stack([two[:, 1], -one[:, 1]], axis=1)
        self.group = _groups(faces, uvs, self.sign)
        self.count = int(self.group.max(initial=-1)) + 1
        self.vertex = np.zeros(self.count, np.int64)
        self.vertex[self.group.ravel()] = faces.ravel()

    def tangents(self, vertices: FloatArray, normals: FloatArray) -> FloatArray:
        """Unit tangents (G, 3) at positions (V, 3) with unit normals (V, 3); zero where the texture has no area."""
        corners = vertices[self._faces]
        sides = corners[:, 1:] - corners[:, :1]
        along = unit_vectors(np.einsum("fk,fki->fi", self._along, sides))
        normal = normals[self._faces]
        flat = unit_vectors(_across(along[:, None], normal))
        ahead = unit_vectors(_across(corners[:, [1, 2, 0]] - corners, normal))
        back = unit_vectors(_across(corners[:, [2, 0, 1]] - corners, normal))
        angle = np.arccos(np.clip(np.einsum("fki,fki->fk", ahead, back), -1.0, 1.0))
        weighted = (angle[..., None] * flat).reshape(-1, 3)
        index = self.group.ravel()
        return unit_vectors(np.stack([np.bincount(index, weighted[:, k], self.count) for k in range(3)], axis=1))


def _across(vectors: FloatArray, normals: FloatArray) -> FloatArray:
    """The part of vectors (..., 3) that lies across unit normals (..., 3)."""
    flat: FloatArray = vectors - np.einsum("...i,...i->...", vectors, normals)[..., None] * normals
    return flat


def _groups(faces: IntArray, uvs: FloatArray, sign: FloatArray) -> IntArray:
    """(F, 3) number of the group of each corner."""
    places = np.column_stack([faces.ravel(), uvs.reshape(-1, 2).astype(np.float32)])
    welded = np.unique(places, axis=0, return_inverse=True)[1].ravel()
    corner = np.arange(faces.size).reshape(-1, 3)
    first, second = corner.ravel(), np.roll(corner, -1, axis=1).ravel()
    swap = welded[first] > welded[second]
    low, high = np.where(swap, second, first), np.where(swap, first, second)
    owner = np.repeat(sign > 0, 3)
    order = np.lexsort((owner, welded[high], welded[low]))
    low, high, owner = low[order], high[order], owner[order]
    same = (welded[low[1:]] == welded[low[:-1]]) & (welded[high[1:]] == welded[high[:-1]]) & (owner[1:] == owner[:-1])
    rows = np.flatnonzero(same)
    links = np.concatenate([low[rows], high[rows]]), np.concatenate([low[rows + 1], high[rows + 1]])
    graph = coo_matrix((np.ones(len(links[0])), links), shape=(faces.size,) * 2)
    groups: IntArray = connected_components(graph, directed=False)[1].astype(np.int64).reshape(-1, 3)
    return groups
