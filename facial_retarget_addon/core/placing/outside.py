"""The part of a head's surface that can be seen from outside: no mouth bag, no back of an eyelid."""

from __future__ import annotations

import numpy as np

from ..acting.eyeballs import ROUND, WRAPS, fit_sphere
from ..arrays import BoolArray, FloatArray, IntArray, cross, unit_vectors
from ..mesh import TriMesh
from ..raycast import CasterFactory
from .pieces import members

TURNS = 8
"""Ways out that are tried around a face's normal, beside the normal itself."""
LEAN = np.radians(50.0)
"""How far these lean away from it."""
LARGE = 0.05
"""Share of the mesh's area from which a piece hides what is behind it."""
FEWEST = 12
"""Vertices of an eyeball, at least."""
_LIFT = 1e-4


def seen_from_outside(mesh: TriMesh, pieces: IntArray, make_caster: CasterFactory) -> BoolArray:
    """(F,) true for faces from whose middle some straight way leads out of the mesh, on their outer side.

    Only large pieces and eyeballs stand in the way: lashes hide nothing.

    Parameters
    ----------
    pieces : (V,) labels of the pieces.
    """
    solid = _solid(mesh, pieces)
    caster = make_caster(TriMesh(mesh.vertices, mesh.faces[solid[mesh.faces[:, 0]]]))
    normal = mesh.face_normals
    corners = mesh.vertices[mesh.faces]
    across = unit_vectors(corners[:, 1] - corners[:, 0])
    other = cross(normal, across)
    start = corners.mean(axis=1) + _LIFT * mesh.size * normal
    seen = np.zeros(len(normal), bool)
    for direction in _ways(normal, across, other):
        left = np.flatnonzero(~seen)
        seen[left] = ~caster.nearest(start[left], direction[left]).found
    return seen


def _solid(mesh: TriMesh, pieces: IntArray) -> BoolArray:
    """(V,) vertices of pieces that hide what is behind them."""
    areas = np.bincount(pieces, mesh.vertex_areas)
    solid = areas >= LARGE * areas.sum()
    for piece, own in enumerate(members(pieces)):
        solid[piece] = solid[piece] or is_ball(mesh.vertices[own])
    hiding: BoolArray = solid[pieces]
    return hiding


def is_ball(positions: FloatArray) -> bool:
    """Whether the vertices (n, 3) of a piece are those of an eyeball, or of the front half of one."""
    if len(positions) < FEWEST:
        return False
    middle, radius = fit_sphere(positions)
    away = np.linalg.norm(positions - middle, axis=1)
    round_ = away.std() < ROUND * radius
    return bool(round_ and np.linalg.norm(positions.mean(axis=0) - middle) < WRAPS * radius)


def _ways(normal: FloatArray, across: FloatArray, other: FloatArray) -> list[FloatArray]:
    turns = 2 * np.pi * np.arange(TURNS) / TURNS
    leaning = [np.cos(LEAN) * normal + np.sin(LEAN) * (np.cos(t) * across + np.sin(t) * other) for t in turns]
    return [normal, *leaning]
