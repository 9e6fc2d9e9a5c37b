"""How a shape squeezes the skin: where its wrinkles belong."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, unit_vectors
from ..mesh import TriMesh

_ROUNDS = 3
"""Times that each vertex takes half of its neighbours' mean: a mask has no facets."""


def compression(mesh: TriMesh, displacements: FloatArray) -> FloatArray:
    """How much shorter the skin gets at each vertex, along the direction in which it shortens most.

    Parameters
    ----------
    mesh : the neutral. displacements : (V, 3) of a shape.

    Returns
    -------
    (V,) from 0 (nowhere shorter) to 1 (nothing left of the length): one minus the smaller singular value of the
    deformation of the triangles around, area-weighted.
    """
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    along = unit_vectors(b - a)
    across = np.cross(mesh.face_normals, along)
    rest = np.stack(
        [np.stack([_dot(side, axis) for axis in (along, across)], axis=1) for side in (b - a, c - a)], axis=2
    )
    moved = mesh.vertices + displacements
    sides = np.stack([moved[mesh.faces[:, k]] - moved[mesh.faces[:, 0]] for k in (1, 2)], axis=2)
    whole = mesh.face_areas > 1e-12 * mesh.size**2
    gradient = np.zeros((len(mesh.faces), 3, 2))
    gradient[whole] = sides[whole] @ np.linalg.inv(rest[whole])
    metric = np.einsum("fki,fkj->fij", gradient, gradient)
    middle, half = 0.5 * (metric[:, 0, 0] + metric[:, 1, 1]), 0.5 * (metric[:, 0, 0] - metric[:, 1, 1])
    smaller = np.sqrt(np.maximum(middle - np.hypot(half, metric[:, 0, 1]), 0.0))
    shorter = np.where(whole, np.clip(1 - smaller, 0.0, 1.0), 0.0)
    weighted = np.bincount(mesh.faces.ravel(), np.repeat(shorter * mesh.face_areas / 3, 3), len(mesh.vertices))
    values = np.divide(weighted, mesh.vertex_areas, out=np.zeros(len(weighted)), where=mesh.vertex_areas > 0)
    around = mesh.neighbours_mean
    lonely = sp.diags((np.diff(around.indptr) == 0).astype(np.float64))
    for _ in range(_ROUNDS):
        values = 0.5 * values + 0.5 * (around @ values + lonely @ values)
    return values


def wrinkle_mask(compressed: FloatArray, nothing: float = 0.02, full: float = 0.15) -> FloatArray:
    """Masks (V,) from 0 to 1 of compressions (V,): 0 up to `nothing`, 1 from `full` on, smooth between."""
    share = np.clip((compressed - nothing) / (full - nothing), 0.0, 1.0)
    mask: FloatArray = share * share * (3 - 2 * share)
    return mask


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    product: FloatArray = np.einsum("fi,fi->f", a, b)
    return product
