"""How feature points share a surface among them: regions, neighbours, weights, blending.

Kshirsagar, Garchery and Magnenat-Thalmann 2003, section 2. A point reaches as far as its neighbours let it,
and acts along an axis only where it is constrained there; so the weights are found once for each axis.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray, IntArray, unit_vectors
from ..geodesic import distances_between, shortcut_graph, surface_distances
from ..mesh import TriMesh
from ..points import FeaturePoints

SOFT = 0.25
"""Weight of the nearest neighbour's distance in a point's reach, against the neighbours that lie in the direction."""
LEAST = 1e-4
"""Shares of a point's motion below this are none."""
SAME = 1e-6
"""Points nearer to each other than this share of the mesh's size are in one place."""
NEAREST = 6
"""Neighbours of a point that has no region of its own."""


@dataclass(frozen=True, eq=False)
class Reach:
    """What one point sends to the vertices around it.

    Attributes
    ----------
    vertices : (n,) that it reaches.
    distance : (n,) along the surface.
    far : (n,) d of equation (2): where the reach ends in the direction of each vertex.
    """

    vertices: IntArray
    distance: FloatArray
    far: FloatArray

    @property
    def weight(self) -> FloatArray:
        """(n,) W of equation (4), greater than zero."""
        weight: FloatArray = np.sin(0.5 * np.pi * (1 - self.distance / self.far))
        return weight

    def ending(self, farthest: float) -> Reach:
        """The same, but no farther than this."""
        return _within(self.vertices, self.distance, np.minimum(self.far, farthest))


def point_weights(
    mesh: TriMesh,
    points: FeaturePoints,
    acting: BoolArray,
    variant: str = "default",
    farthest: FloatArray | None = None,
) -> tuple[sp.csr_matrix, sp.csr_matrix, sp.csr_matrix]:
    """The share that each vertex takes of each point's displacement, for each of three axes.

    The default is continuous: a point's reach (equation 2) takes in all neighbours by the cosine of their direction,
    and where the reaches end the motion fades out; between points the shares add up to 1. `paper` is as printed.

    Parameters
    ----------
    mesh : V vertices.
    points : P places on it. Those on other components keep to them.
    acting : (P, 3) whether a point acts along an axis, be it that it moves or that it holds the surface there.
    farthest : (P,) where each point's reach ends at the latest; nowhere if not given.

    Returns
    -------
    Three (V, P) matrices, one for each axis.

    References
    ----------
    Kshirsagar et al. 2003, equations (1) to (5).
    """
    paper = variant == "paper"
    places = points.positions(mesh.vertices)
    distances = surface_distances(mesh, points, graph=None if paper else shortcut_graph(mesh))
    between = distances_between(distances, mesh, points)
    normals = unit_vectors(np.einsum("pk,pkc->pc", points.weights, mesh.vertex_normals[points.vertices]))
    matrices = []
    for axis in range(3):
        rows = np.flatnonzero(acting[:, axis])
        neighbours = _neighbours(mesh, distances[rows])
        apart = np.isfinite(between) & (between > SAME * mesh.size)
        reaches = []
        for i, row in enumerate(rows):
            beside = rows[neighbours[i] & apart[row, rows]]
            if not len(beside):
                # Another point in the same place has the region: the nearest others are the neighbours.
                others = rows[apart[row, rows]]
                beside = others[np.argsort(between[row, others], kind="stable")[:NEAREST]]
            reach = _paper_reach if paper else _reach
            own = reach(mesh, places, normals, distances[row], between[row, beside], row, beside)
            reaches.append(own if farthest is None else own.ending(farthest[row]))
        matrices.append(_blend(len(mesh.vertices), len(points), rows, reaches, paper))
    return matrices[0], matrices[1], matrices[2]


def _neighbours(mesh: TriMesh, distances: FloatArray) -> BoolArray:
    """(n, n) which of n points' regions touch; a vertex belongs to the point nearest along the surface."""
    count = len(distances)
    if not count:
        return np.zeros((0, 0), bool)
    label = np.where(np.isfinite(distances.min(axis=0)), distances.argmin(axis=0), count)
    meeting = label[mesh.edges]
    touching = np.zeros((count + 1, count + 1), bool)
    touching[meeting[:, 0], meeting[:, 1]] = touching[meeting[:, 1], meeting[:, 0]] = True
    np.fill_diagonal(touching, False)
    return touching[:count, :count]


def _cosines(
    mesh: TriMesh, places: FloatArray, normal: FloatArray | None, vertices: IntArray, row: int, beside: IntArray
) -> FloatArray:
    """(n, k) cosine of the angle at a point between vertices and neighbours, in its tangent plane if one is given."""
    away, towards = mesh.vertices[vertices] - places[row], places[beside] - places[row]
    if normal is not None:
        away, towards = (vectors - np.outer(vectors @ normal, normal) for vectors in (away, towards))
    cosines: FloatArray = unit_vectors(away) @ unit_vectors(towards).T
    return cosines


def _reach(
    mesh: TriMesh,
    places: FloatArray,
    normals: FloatArray,
    distance: FloatArray,
    gaps: FloatArray,
    row: int,
    beside: IntArray,
) -> Reach:
    """Equations (2) to (4) without their steps: every neighbour counts by the cosine of its direction."""
    if not len(beside):
        return _alone(distance)
    vertices = np.flatnonzero(distance < gaps.max())
    facing = np.maximum(_cosines(mesh, places, normals[row], vertices, row, beside), 0.0)
    far = (facing @ gaps + SOFT * gaps.min()) / (facing.sum(axis=1) + SOFT)
    return _within(vertices, distance[vertices], far)


def _paper_reach(
    mesh: TriMesh,
    places: FloatArray,
    normals: FloatArray,
    distance: FloatArray,
    gaps: FloatArray,
    row: int,
    beside: IntArray,
) -> Reach:
    """Equations (1) to (4) as printed; where no neighbour lies within a right angle, the nearest one's distance."""
    if not len(beside):
        return _alone(distance)
    vertices = np.flatnonzero(np.isfinite(distance))
    cosine = _cosines(mesh, places, None, vertices, row, beside)
    order = np.argsort(-cosine, axis=1)[:, :2]
    facing = np.maximum(np.take_along_axis(cosine, order, axis=1), 0.0)
    total = facing.sum(axis=1)
    both = np.divide((facing * gaps[order]).sum(axis=1), total, out=np.full(len(total), gaps.min()), where=total > 0)
    single = (facing > 0).sum(axis=1) == 1
    both[single] = gaps[order[single, 0]] / facing[single, 0]
    return _within(vertices, distance[vertices], both)


def _alone(distance: FloatArray) -> Reach:
    """A point without neighbours acts on all of its component, less and less towards the far end."""
    vertices = np.flatnonzero(np.isfinite(distance))
    end = distance[vertices].max(initial=0.0)
    return _within(vertices, distance[vertices], np.full(len(vertices), 1.001 * end))


def _within(vertices: IntArray, distance: FloatArray, far: FloatArray) -> Reach:
    inside = distance < far
    return Reach(vertices[inside], distance[inside], far[inside])


def _blend(count: int, columns: int, rows: IntArray, reaches: list[Reach], paper: bool) -> sp.csr_matrix:
    """Equation (5) as a (count, columns) matrix."""
    if not reaches:
        return sp.csr_matrix((count, columns))
    vertex = np.concatenate([reach.vertices for reach in reaches])
    column = np.repeat(rows, [len(reach.vertices) for reach in reaches])
    weight = np.concatenate([reach.weight for reach in reaches])
    distance = np.concatenate([reach.distance for reach in reaches])
    pull = weight / np.maximum(distance, 1e-300) ** (2 if paper else 1)
    share = pull / np.bincount(vertex, pull, count)[vertex]
    if not paper:
        # Near one point alone the motion is its weight's; between points the weights add up to 1 and more.
        reached = np.minimum(np.bincount(vertex, weight, count), 1.0)
        share *= np.sin(0.5 * np.pi * reached)[vertex]
    kept = share > LEAST
    return sp.csr_matrix((share[kept], (vertex[kept], column[kept])), shape=(count, columns))
