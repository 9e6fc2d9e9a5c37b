"""The rule by which a fine vertex finds its place on a face along its normal."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray, IntArray
from ..mesh import TriMesh
from ..raycast import RayCaster
from .vertex_neighbours import neighbour_median

AGREEMENT = 0.2
"""A hit counts where the surface normal's dot product with the ray's normal is above this."""
REACH = 2.5
"""A hit counts within this many local edges."""
OUTLIER = 1.5
"""A hit whose offset differs from its neighbours' median by more than this many local edges does not count."""


class Pierced(NamedTuple):
    """Signed offset (N,), 0 without a hit; face (N,), -1 without; barycentric weights (N, 3)."""

    offset: FloatArray
    face: IntArray
    weights: FloatArray


def pierce(mesh: TriMesh, caster: RayCaster, origins: FloatArray, normals: FloatArray, edges: FloatArray) -> Pierced:
    """Nearest admissible hit along the normal, either way.

    Real faces have other sheets near (lips, lids, the back of the head): a hit counts only where the surface faces
    the same way and is near.

    Parameters
    ----------
    origins : (N, 3). normals : (N, 3) unit. edges : (N,) length of the edges around each origin.

    References
    ----------
    Na and Jung 2004, section 3 (without a limit); the limits are from our own measurements.
    """
    best = np.full(len(origins), np.inf)
    face = np.full(len(origins), -1, np.int64)
    weights = np.zeros((len(origins), 3))
    for sign in (1.0, -1.0):
        hits = caster.nearest(origins, sign * normals, REACH * edges)
        agree = np.einsum("ij,ij->i", mesh.face_normals[hits.face], normals) > AGREEMENT
        better = hits.found & agree & (hits.distance < np.abs(best))
        best[better] = sign * hits.distance[better]
        face[better], weights[better] = hits.face[better], hits.weights[better]
    return Pierced(np.where(face >= 0, best, 0.0), face, weights)


def outliers(neighbours: sp.csr_matrix, offsets: FloatArray, hit: BoolArray, edges: FloatArray) -> BoolArray:
    """(N,) true for hits that lie far from where their neighbours' hits lie: another sheet was hit."""
    median = neighbour_median(neighbours, offsets, hit)
    far: BoolArray = hit & (np.abs(offsets - median) > OUTLIER * edges)
    return far
