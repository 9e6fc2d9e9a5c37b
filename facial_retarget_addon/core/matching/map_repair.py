"""Which places of a map from surface to surface can be believed."""

from __future__ import annotations

import numpy as np

from ..arrays import BoolArray, FloatArray
from ..mesh import TriMesh
from .surface_fill import HarmonicFill

_STRETCH = 2.0
_ROUNDS = 4


def torn_vertices(mesh: TriMesh, lengths: FloatArray, places: FloatArray) -> BoolArray:
    """(V,) true at the ends of edges that places (V, 3) stretch too far, and at the corners of faces that they flip.

    Parameters
    ----------
    mesh : the mesh, bent near to its places.
    lengths : (E,) what the edges should measure.
    """
    ends = mesh.edges
    stretched = np.linalg.norm(places[ends[:, 0]] - places[ends[:, 1]], axis=1) > _STRETCH * lengths
    # Faces that shrink to nothing, as on a border, have no side: rounding must not decide.
    upright = np.einsum("fc,fc->f", mesh.with_vertices(places).face_vectors, mesh.face_vectors)
    flipped = upright < -1e-6 * np.einsum("fc,fc->f", mesh.face_vectors, mesh.face_vectors)
    torn = np.zeros(len(mesh.vertices), bool)
    torn[ends[stretched].ravel()] = True
    torn[mesh.faces[flipped].ravel()] = True
    return torn


def believable(rest: TriMesh, bent: TriMesh, scale: float, places: FloatArray, sure: BoolArray) -> BoolArray:
    """(V,) the vertices among `sure` whose places leave the mesh whole once the others are filled from them.

    Parameters
    ----------
    rest, bent : the mesh as it was, and bent near to its places.
    scale : units of `bent` per unit of `rest`.
    places : (V, 3) the places, in the units of `bent`.
    """
    plain = scale * rest.edge_lengths
    lengths = np.maximum(np.clip(bent.edge_lengths, 0.5 * plain, 2 * plain), 1e-9 * bent.size)
    sure = sure.copy()
    here = places
    for _ in range(_ROUNDS):
        torn = torn_vertices(bent, lengths, here) & sure
        if not torn.any():
            break
        sure &= ~torn
        here = HarmonicFill(rest, sure, np.zeros(len(sure))).values(places)
    return sure
