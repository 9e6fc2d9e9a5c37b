"""Subdivision of triangle meshes as sparse matrices.

A scheme takes the connectivity of one level and hands back the matrix to the next, so positions of
any number of frames go through it at once. New vertices come after the old ones, one per edge.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray, IntArray
from ..errors import RetargetError
from ..mesh import TriMesh


@dataclass(frozen=True, eq=False)
class Level:
    """One subdivision step.

    Attributes
    ----------
    matrix : (V', V) csr, float64: values on the coarse vertices to values on the fine ones; rows add up to 1.
    faces : (F', 3) fine faces, oriented like the coarse ones; face 4 f + k lies in coarse face f.
    parents : (E, 2) coarse edges: fine vertex V + e lies on edge e.
    parent_on_boundary : (E,) true for edges on the boundary.
    """

    matrix: sp.csr_matrix
    faces: IntArray
    parents: IntArray
    parent_on_boundary: BoolArray

    @property
    def vertex_count(self) -> int:
        """Number of fine vertices V'."""
        return int(self.matrix.shape[0])

    @property
    def coarse_count(self) -> int:
        """Number of coarse vertices V."""
        return int(self.matrix.shape[1])

    @cached_property
    def interpolating(self) -> bool:
        """Whether every coarse vertex stays where it is."""
        old = self.matrix[: self.coarse_count]
        return bool(old.nnz == self.coarse_count and (old.diagonal() == 1).all())


Scheme = Callable[[IntArray, int], Level]
"""Takes faces (F, 3) and the number of vertices; returns the step to the next level."""


def hierarchy(faces: IntArray, vertex_count: int, levels: int, scheme: Scheme | None = None) -> list[Level]:
    """Steps 1 to `levels` of a subdivision scheme (Loop unless another one is given), coarse to fine.

    Raises
    ------
    RetargetError : if an edge has more than two faces, or faces of both orientations meet.
    """
    step = scheme or loop
    steps: list[Level] = []
    for _ in range(levels):
        steps.append(step(faces, vertex_count))
        faces, vertex_count = steps[-1].faces, steps[-1].vertex_count
    return steps


def loop(faces: IntArray, vertex_count: int) -> Level:
    """One step of Loop subdivision with boundaries.

    Interior edges 3/8 (ends) + 1/8 (opposite corners), boundary edges 1/2 (ends); interior vertices of
    valence n keep 1 - n b with Loop's b = (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n, boundary vertices 3/4 with 1/8
    of each boundary neighbour. A boundary vertex of several boundary edge pairs is a corner and stays.

    Parameters
    ----------
    faces : (F, 3), edge-manifold and oriented.
    vertex_count : number of coarse vertices V; those of no face stay where they are.

    Raises
    ------
    RetargetError : if an edge has more than two faces, or faces of both orientations meet.

    References
    ----------
    Loop 1987; Hoppe et al. 1994 (boundaries).
    """
    mesh = connectivity(faces, vertex_count)
    edges, face_edges = mesh.edges, mesh.face_edges
    on_boundary: BoolArray = mesh.edge_face_count == 1
    matrix = sp.vstack([_loop_vertices(mesh, on_boundary), _loop_edges(mesh, on_boundary)]).tocsr()
    matrix.sort_indices()
    return Level(matrix, split_faces(faces, face_edges, vertex_count), edges, on_boundary)


def split_faces(faces: IntArray, face_edges: IntArray, vertex_count: int) -> IntArray:
    """Each face cut into four at its edges' midpoints, whose vertices are numbered vertex_count + edge; (4 F, 3)."""
    a, b, c = faces.T
    ab, bc, ca = (face_edges + vertex_count).T
    fine: IntArray = np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)
    return fine


def boundary_parameters(loops: Sequence[IntArray], steps: Sequence[Level]) -> list[list[tuple[IntArray, FloatArray]]]:
    """Where the fine boundary vertices lie along the base's boundary loops, for every step.

    Parameters
    ----------
    loops : base boundary loops, each (n,) vertices in order.
    steps : the hierarchy on this base.

    Returns
    -------
    Per step, per loop: vertices (m,) and their dyadic parameters (m,) in [0, n), ascending: parameter k is the
    loop's vertex k, k + 1/2 the vertex between k and k + 1.
    """
    count = steps[0].matrix.shape[1] if steps else 0
    owner = np.full(count, -1, np.int64)
    parameter = np.zeros(count)
    size = np.array([*(len(ring) for ring in loops), 1], np.float64)
    for k, ring in enumerate(loops):
        owner[ring] = k
        parameter[ring] = np.arange(len(ring))
    found: list[list[tuple[IntArray, FloatArray]]] = []
    for step in steps:
        a, b = step.parents.T
        n = np.where(step.parent_on_boundary, size[owner[a]], 1.0)
        forward = np.mod(parameter[b] - parameter[a], n)
        middle = np.where(
            forward <= n / 2, parameter[a] + forward / 2, parameter[b] + np.mod(parameter[a] - parameter[b], n) / 2
        )
        owner = np.concatenate([owner, np.where(step.parent_on_boundary, owner[a], -1)])
        parameter = np.concatenate([parameter, np.where(step.parent_on_boundary, np.mod(middle, n), 0.0)])
        places = []
        for k in range(len(loops)):
            members = np.flatnonzero(owner == k)
            members = members[np.argsort(parameter[members])]
            places.append((members, parameter[members]))
        found.append(places)
    return found


def connectivity(faces: IntArray, vertex_count: int) -> TriMesh:
    """The faces as a mesh without positions; RetargetError if it is not edge-manifold and oriented."""
    mesh = TriMesh(np.zeros((vertex_count, 3)), faces)
    if not mesh.is_edge_manifold:
        raise RetargetError(
            f"a mesh of {vertex_count} vertices and {len(faces)} faces has edges of more than two faces "
            "or faces of both orientations, expected a manifold, oriented mesh to subdivide"
        )
    return mesh


def _loop_edges(mesh: TriMesh, on_boundary: BoolArray) -> sp.coo_matrix:
    """(E, V) weights of the new vertices."""
    edge = mesh.face_edges.ravel()
    opposite = mesh.faces[:, [2, 0, 1]].ravel()
    inside = ~on_boundary[edge]
    end = np.where(on_boundary, 0.5, 0.375)
    every = np.arange(len(mesh.edges))
    rows = np.concatenate([every, every, edge[inside]])
    columns = np.concatenate([mesh.edges[:, 0], mesh.edges[:, 1], opposite[inside]])
    weights = np.concatenate([end, end, np.full(int(inside.sum()), 0.125)])
    return sp.coo_matrix((weights, (rows, columns)), shape=(len(mesh.edges), len(mesh.vertices)))


def _loop_vertices(mesh: TriMesh, on_boundary: BoolArray) -> sp.coo_matrix:
    """(V, V) weights of the old vertices."""
    count = len(mesh.vertices)
    ends = mesh.edges
    valence = np.bincount(ends.ravel(), minlength=count)
    border_valence = np.bincount(ends[on_boundary].ravel(), minlength=count)
    n = np.maximum(valence, 1)
    neighbour = (0.625 - (0.375 + 0.25 * np.cos(2 * np.pi / n)) ** 2) / n
    neighbour[border_valence > 0] = 0.0
    border = np.where(border_valence == 2, 0.125, 0.0)
    a, b = np.concatenate([ends, ends[:, ::-1]]).T
    weights = np.where(np.tile(on_boundary, 2), border[a], neighbour[a])
    own = 1 - np.where(border_valence > 0, border * border_valence, neighbour * valence)
    every = np.arange(count)
    return sp.coo_matrix(
        (np.concatenate([own, weights]), (np.concatenate([every, a]), np.concatenate([every, b]))), shape=(count, count)
    )
