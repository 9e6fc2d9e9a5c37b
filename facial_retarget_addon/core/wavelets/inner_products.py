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

_EXTRA = 2
"""Levels beyond the finest on which functions count as piecewise linear."""

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
    beyond = hierarchy(faces, vertex_count, _EXTRA, butterfly)
    coarser, finer = (_pulled_down(beyond[:count]) for count in (_EXTRA - 1, _EXTRA))
    near = finer + (finer - coarser) / 3
    mesh = TriMesh(np.zeros((vertex_count, 3)), faces)
    neighbours = adjacency(mesh)
    inside = _deep(mesh, neighbours)
    exact = _lattice(neighbours, inside)
    deep, rest = sp.diags(inside * 1.0), sp.diags(~inside * 1.0)
    return (exact + rest @ exact.T @ deep + rest @ near @ rest).tocsr()


def _pulled_down(steps: Sequence[Level]) -> sp.csr_matrix:
    """Piecewise-linear inner products after some steps, as those of the functions before them."""
    faces, count = steps[-1].faces, steps[-1].vertex_count
    twelfth = 0.5 / 4 ** len(steps) / 12
    a, b, c = faces.T
    rows, columns = np.concatenate([a, b, c, a, b, c]), np.concatenate([b, c, a, a, b, c])
    half = sp.coo_matrix((np.full(len(rows), twelfth), (rows, columns)), shape=(count, count)).tocsr()
    mass = half + half.T
    for step in reversed(steps):
        mass = step.matrix.T @ mass @ step.matrix
    return mass.tocsr()


def _deep(mesh: TriMesh, neighbours: sp.csr_matrix) -> BoolArray:
    """(V,) true for vertices whose surroundings are regular for `_RINGS` rings."""
    irregular = mesh.boundary_vertices | (np.diff(neighbours.indptr) != 6)
    for _ in range(_RINGS):
        irregular = irregular | (neighbours @ irregular.astype(np.float64) > 0)
    deep: BoolArray = ~irregular
    return deep


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
