"""Inner products of the scaling functions of an interpolating subdivision scheme, level by level."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, IntArray
from ..levels.butterfly import butterfly
from ..levels.subdivision import Level, hierarchy
from ..levels.vertex_neighbours import adjacency
from ..mesh import TriMesh

_RINGS = 6
"""Rings that must be regular around a vertex for its inner products to be those of the regular lattice."""

REGULAR: dict[tuple[int, int], float] = {
    (0, 1): 0.6273928373589391,
    (1, 1): 0.0944801248216427,
    (2, 1): -0.007740258912666561,
    (2, 2): -0.0273090815359671,
    (3, 1): 4.778975173143678e-05,
    (3, 3): 0.001349319078773392,
    (4, 1): -5.412521507680223e-08,
    (4, 4): 5.290002406823248e-07,
    (4, 6): -7.687409353620786e-05,
    (5, 5): -1.980584365083831e-10,
    (5, 10): -7.394719508094263e-08,
}
"""Butterfly on the regular lattice, a function's own integral being 1: (edges between two vertices, number of
shortest ways) -> inner product. Eigenvector of the two-scale relation; every other one is 0."""


def inner_products(faces: IntArray, vertex_count: int, steps: Sequence[Level]) -> list[sp.csr_matrix]:
    """Inner products <phi_u, phi_v> on every level, the base's first.

    Every base triangle counts alike, whatever its size, so that I_j = P^T I_(j+1) P holds exactly. On the finest
    level, values of the regular lattice stand where its surroundings are regular; the others are those of
    piecewise-linear functions some levels finer, with a Richardson step (their error falls by 4 per level).

    Parameters
    ----------
    faces : (F, 3) of the base.
    vertex_count : of the base.
    steps : the base's butterfly steps.

    Returns
    -------
    len(steps) + 1 matrices, level j's (V_j, V_j) csr. In units where a regular function of the finest level has
    integral 1.

    References
    ----------
    Lounsbery, DeRose and Warren 1997, section 5.
    """
    if steps:
        faces, vertex_count = steps[-1].faces, steps[-1].vertex_count
    found = [_finest(faces, vertex_count)]
    for step in reversed(steps):
        found.append((step.matrix.T @ found[-1] @ step.matrix).tocsr())
    return found[::-1]


def _finest(faces: IntArray, vertex_count: int) -> sp.csr_matrix:
    mesh = TriMesh(np.zeros((vertex_count, 3)), faces)
    neighbours = adjacency(mesh)
    inside = ~_widened(mesh.boundary_vertices | (np.diff(neighbours.indptr) != 6), neighbours)
    exact = _lattice(neighbours, inside)
    near = _by_finer_levels(faces, ~inside, _widened(~inside, neighbours))
    return (exact + sp.diags(~inside * 1.0) @ exact.T @ sp.diags(inside * 1.0) + near).tocsr()


def _widened(some: BoolArray, neighbours: sp.csr_matrix) -> BoolArray:
    """(V,) true for some vertices and `_RINGS` rings around them."""
    for _ in range(_RINGS):
        some = some | (neighbours @ some.astype(np.float64) > 0)
    return some


def _by_finer_levels(faces: IntArray, some: BoolArray, around: BoolArray) -> sp.csr_matrix:
    """(V, V) inner products among some vertices, by functions that are piecewise linear two and one levels finer.

    around : (V,) what their functions depend on; the rest of the mesh is left away.
    """
    used, corners = np.unique(faces[around[faces].all(axis=1)], return_inverse=True)
    rows = np.flatnonzero(some[used])
    one, two = hierarchy(corners.reshape(-1, 3), len(used), 2, butterfly)
    first, finer_rows = _columns(one, rows)
    second, finest_rows = _columns(two, finer_rows)
    coarser, finer = _linear_products(one, 1, finer_rows), second.T @ _linear_products(two, 2, finest_rows) @ second
    near = (first.T @ (finer + (finer - coarser) / 3) @ first).tocoo()
    vertices = used[rows]
    return sp.csr_matrix((near.data, (vertices[near.row], vertices[near.col])), shape=(len(some),) * 2)


def _columns(step: Level, some: IntArray) -> tuple[sp.csr_matrix, IntArray]:
    """Some columns of a step's matrix, without the rows that they do not reach, and which rows are left."""
    matrix = step.matrix[:, some]
    rows = np.flatnonzero(np.diff(matrix.indptr))
    return matrix[rows], rows


def _linear_products(step: Level, levels: int, rows: IntArray) -> sp.csr_matrix:
    """Inner products of the piecewise-linear functions of some vertices, so many levels finer than the unit."""
    twelfth = 0.5 / 4**levels / 12
    a, b, c = step.faces.T
    i, j = np.concatenate([a, b, c, a, b, c]), np.concatenate([b, c, a, a, b, c])
    half = sp.coo_matrix((np.full(len(i), twelfth), (i, j)), shape=(step.vertex_count,) * 2).tocsr()
    return (half + half.T)[rows][:, rows]


def _lattice(neighbours: sp.csr_matrix, rows: BoolArray) -> sp.csr_matrix:
    """(V, V) csr: the lattice's inner products in some rows, nothing in the others."""
    ways = sp.diags(rows * 1.0).tocsr()
    near = ways.astype(bool)
    found = REGULAR[0, 1] * ways
    for edges in range(1, 1 + max(distance for distance, _ in REGULAR)):
        ways = (ways @ neighbours).tocsr()
        ways = ways - ways.multiply(near)
        ways.eliminate_zeros()
        near = near + ways.astype(bool)
        values = np.zeros(len(ways.data))
        for (distance, count), value in REGULAR.items():
            if distance == edges:
                values[np.rint(ways.data) == count] = value
        found = found + sp.csr_matrix((values, ways.indices, ways.indptr), shape=ways.shape)
    return found.tocsr()
