"""The artist's vertices riding on another mesh: triangle, weights, and an offset in the local frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from .arrays import FloatArray, IntArray, cross, unit_vectors
from .closest_point import SurfaceFinder
from .mesh import TriMesh
from .points import place_matrix

_AGREEMENT = 0.0
"""A vertex is bound to a place whose normal is at most a right angle away from its own, if there is one."""


@dataclass(frozen=True, eq=False)
class Binding:
    """Places of V vertices on a carrier mesh of N vertices.

    Attributes
    ----------
    matrix : (V, N) csr, float32: carrier values to values at the places.
    corners : (V, 3) carrier vertices of each place's triangle.
    offset : (V, 3) float32, from the place to the vertex in the triangle's frame, in the carrier's units.
    inside : (V,) from 1 on the carrier to 0 at `reach` from it: how far a vertex follows the carrier.
    neutral : (N, 3) float32 carrier.
    """

    matrix: sp.csr_matrix
    corners: IntArray
    offset: FloatArray
    inside: FloatArray
    neutral: FloatArray

    def displacements(self, carrier: FloatArray) -> FloatArray:
        """Displacements (F, V, 3) float32 of the vertices for displacements (F, N, 3) of the carrier."""
        moved = apply_matrix(self.matrix, carrier)
        rest = _frames(self.neutral[None], self.corners)
        change = _frames(self.neutral + carrier, self.corners) - rest
        moved += np.einsum("fvij,vi->fvj", change, self.offset)
        return moved


def bind(vertices: FloatArray, normals: FloatArray, carrier: TriMesh, reach: float) -> Binding:
    """Bind vertices to the closest places of a carrier whose normals agree.

    Parameters
    ----------
    vertices, normals : (V, 3) positions and unit normals.
    carrier : the mesh to ride on.
    reach : distance from the carrier, beyond its border, at which a vertex no longer follows it.
    """
    finder = SurfaceFinder(carrier)
    near = finder.closest(vertices, normals, _AGREEMENT)
    lost = np.flatnonzero(near.face < 0)
    if len(lost):
        for mine, other in zip(near, finder.closest(vertices[lost]), strict=True):
            mine[lost] = other
    corners = carrier.faces[near.face]
    frame = _frames(carrier.vertices[None], corners)[0]
    gap = vertices - near.point
    offset = np.einsum("vij,vj->vi", frame, gap)
    sideways = np.linalg.norm(gap - frame[:, 2] * offset[:, 2:], axis=1)
    beyond = np.maximum(sideways, np.maximum(near.distance - 0.5 * reach, 0))
    beyond[lost] = np.inf
    step = np.clip(1 - beyond / reach, 0, 1)
    matrix = place_matrix(corners, near.weights, len(carrier.vertices)).astype(np.float32)
    inside = step * step * (3 - 2 * step)
    return Binding(matrix, corners, offset.astype(np.float32), inside, carrier.vertices.astype(np.float32))


def apply_matrix(matrix: sp.csr_matrix, values: FloatArray) -> FloatArray:
    """Matrix (M, N) times every frame of values (F, N, 3): (F, M, 3)."""
    count, size, _ = values.shape
    product = matrix @ np.ascontiguousarray(values.transpose(1, 0, 2)).reshape(size, 3 * count)
    result: FloatArray = np.ascontiguousarray(product.reshape(-1, count, 3).transpose(1, 0, 2))
    return result


def _frames(positions: FloatArray, corners: IntArray) -> FloatArray:
    """Frames (F, V, 3, 3) of the triangles: rows along the first edge, across it, and along the normal."""
    a, b, c = (positions[:, corners[:, k]] for k in range(3))
    along = unit_vectors(b - a)
    normal = unit_vectors(cross(b - a, c - a))
    return np.stack([along, cross(normal, along), normal], axis=-2)
