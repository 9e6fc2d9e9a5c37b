"""The part of a head's surface that can be seen from outside: no mouth bag, no back of an eyelid."""

from __future__ import annotations

import numpy as np

from ..arrays import BoolArray, FloatArray, cross, unit_vectors
from ..mesh import TriMesh
from ..raycast import RayCaster

TURNS = 5
"""Ways out that are tried around a face's normal, beside the normal itself."""
LEAN = np.radians(50.0)
"""How far these lean away from it."""
_LIFT = 1e-4


def seen_from_outside(mesh: TriMesh, caster: RayCaster) -> BoolArray:
    """(F,) true for faces from whose middle some straight way leads out of the mesh, on their outer side.

    Parameters
    ----------
    caster : casts rays on the whole mesh, with its eyes and teeth.
    """
    normal = mesh.face_normals
    across = unit_vectors(cross(normal, np.where(np.abs(normal[:, :1]) < 0.7, [[1.0, 0, 0]], [[0, 1.0, 0]])))
    other = cross(normal, across)
    start = mesh.vertices[mesh.faces].mean(axis=1) + _LIFT * mesh.size * normal
    seen = np.zeros(len(normal), bool)
    for direction in _ways(normal, across, other):
        left = np.flatnonzero(~seen)
        seen[left] = ~caster.nearest(start[left], direction[left]).found
    return seen


def _ways(normal: FloatArray, across: FloatArray, other: FloatArray) -> list[FloatArray]:
    turns = 2 * np.pi * np.arange(TURNS) / TURNS
    leaning = [np.cos(LEAN) * normal + np.sin(LEAN) * (np.cos(t) * across + np.sin(t) * other) for t in turns]
    return [normal, *leaning]
