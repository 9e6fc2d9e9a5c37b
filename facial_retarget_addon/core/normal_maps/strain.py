"""How a shape squeezes and stretches the skin: where its wrinkles belong."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, unit_vectors
from ..mesh import TriMesh

_ROUNDS = 3
"""Times that each vertex takes half of its neighbours' mean."""


def strain(mesh: TriMesh, displacements: FloatArray) -> FloatArray:
    """How much the length of the skin changes at each vertex, along the direction in which it changes most.

    Skin that gets shorter folds, and skin that gets longer loses the folds that it had.

    Parameters
    ----------
    mesh : the neutral. displacements : (V, 3) of a shape.

    Returns
    -------
    (V,) from 0 (as long as before) to 1: one minus the shorter length over the longer one, which are the smaller
    singular value of the deformation and 1, or 1 and the larger one; mean of the triangles around, area-weighted.
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
    turn = np.hypot(half, metric[:, 0, 1])
    smaller, larger = np.sqrt(np.maximum(middle - turn, 0.0)), np.sqrt(np.maximum(middle + turn, 1.0))
    changed = np.where(whole, np.clip(np.maximum(1 - smaller, 1 - 1 / larger), 0.0, 1.0), 0.0)
    weighted = np.bincount(mesh.faces.ravel(), np.repeat(changed * mesh.face_areas / 3, 3), len(mesh.vertices))
    values = np.divide(weighted, mesh.vertex_areas, out=np.zeros(len(weighted)), where=mesh.vertex_areas > 0)
    return smoothed(mesh, values)


def smoothed(mesh: TriMesh, values: FloatArray) -> FloatArray:
    """Values (V,), each vertex's mixed a few times with its neighbours' mean: a mask has no facets."""
    around = mesh.neighbours_mean
    lonely = sp.diags((np.diff(around.indptr) == 0).astype(np.float64))
    for _ in range(_ROUNDS):
        values = 0.5 * values + 0.5 * (around @ values + lonely @ values)
    return values


def ramp(values: FloatArray, nothing: float, full: float) -> FloatArray:
    """Masks (V,) from 0 to 1 of values (V,): 0 up to `nothing`, 1 from `full` on, smooth between."""
    share = np.clip((values - nothing) / (full - nothing), 0.0, 1.0)
    mask: FloatArray = share * share * (3 - 2 * share)
    return mask


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    product: FloatArray = np.einsum("fi,fi->f", a, b)
    return product
