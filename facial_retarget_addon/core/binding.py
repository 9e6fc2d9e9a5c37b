"""The artist's vertices riding on another mesh: triangle, weights, and an offset in the local frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from .arrays import BoolArray, FloatArray, IntArray, cross, unit_vectors
from .closest_point import SurfaceFinder
from .mesh import TriMesh
from .points import place_matrix

_AGREEMENT = 0.0
"""A vertex is bound to a place whose normal is at most a right angle away from its own."""
_FEW_COLUMNS, _LONG_ROW = 3, 8
"""Columns up to which, and entries of the mean row from which, `multiply` goes column by column."""


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


def bind(mesh: TriMesh, riders: BoolArray, carrier: TriMesh, reach: float) -> Binding:
    """Bind a mesh's vertices to the closest places of a carrier whose normals agree.

    Parameters
    ----------
    mesh : the mesh that rides.
    riders : (V,) which of its vertices may.
    carrier : the mesh to ride on.
    reach : distance from the carrier, beyond its border, at which a vertex no longer follows it.
    """
    count = len(mesh.vertices)
    asked = np.flatnonzero(riders)
    places = SurfaceFinder(carrier).closest(
        mesh.vertices[asked], mesh.vertex_normals[asked], _AGREEMENT, limit=1.5 * reach
    )
    found = places.face >= 0
    bound = asked[found]
    corners = np.zeros((count, 3), np.int64)
    weights, offset, inside = np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(count)
    corners[bound], weights[bound] = carrier.faces[places.face[found]], places.weights[found]
    frame = _frames(carrier.vertices[None], corners[bound])[0]
    gap = mesh.vertices[bound] - places.point[found]
    offset[bound] = np.einsum("vij,vj->vi", frame, gap)
    sideways = np.linalg.norm(gap - frame[:, 2] * offset[bound, 2:], axis=1)
    beyond = np.maximum(sideways, np.maximum(places.distance[found] - 0.5 * reach, 0))
    step = np.clip(1 - beyond / reach, 0, 1)
    inside[bound] = step * step * (3 - 2 * step)
    matrix = place_matrix(corners, weights, len(carrier.vertices)).astype(np.float32)
    return Binding(matrix, corners, offset.astype(np.float32), inside, carrier.vertices.astype(np.float32))


def multiply(matrix: sp.csr_matrix, values: FloatArray) -> FloatArray:
    """Matrix (M, N) times values (N, K).

    SciPy reads a matrix once for all columns, and for so few columns as a frame has, that takes twice as long as each
    column by itself, unless its rows are short. The sums are the same.
    """
    if values.shape[1] > _FEW_COLUMNS or matrix.nnz < _LONG_ROW * matrix.shape[0]:
        product: FloatArray = matrix @ values
        return product
    by_column = np.empty((matrix.shape[0], values.shape[1]), np.result_type(matrix.dtype, values.dtype))
    for k, column in enumerate(np.ascontiguousarray(values.T)):
        by_column[:, k] = matrix @ column
    return by_column


def apply_matrix(matrix: sp.csr_matrix, values: FloatArray) -> FloatArray:
    """Matrix (M, N) times every frame of values (F, N, 3): (F, M, 3)."""
    count, size, _ = values.shape
    product = multiply(matrix, np.ascontiguousarray(values.transpose(1, 0, 2)).reshape(size, 3 * count))
    result: FloatArray = np.ascontiguousarray(product.reshape(-1, count, 3).transpose(1, 0, 2))
    return result


def _frames(positions: FloatArray, corners: IntArray) -> FloatArray:
    """Frames (F, V, 3, 3) of the triangles: rows along the first edge, across it, and along the normal."""
    a, b, c = (positions[:, corners[:, k]] for k in range(3))
    along = unit_vectors(b - a)
    normal = unit_vectors(cross(b - a, c - a))
    return np.stack([along, cross(normal, along), normal], axis=-2)
