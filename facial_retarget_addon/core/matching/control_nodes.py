"""A smooth field on a surface, held by a few hundred control nodes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import dijkstra

from ..arrays import FloatArray, IntArray
from ..mesh import TriMesh


@dataclass(frozen=True, eq=False)
class ControlNodes:
    """Nodes spread over a surface, and the smooth weights by which vertices follow them.

    Attributes
    ----------
    vertices : (K,) the vertices that are nodes.
    weights : (V, K) sparse; rows add up to 1 and reproduce fields that are linear in position. Only nodes that are
        near along the surface count, so that two lips do not share any. Zero rows where no node can be reached.
    bending : (K, K) sparse; row k is a node's value minus what the linear field through its neighbours predicts.
    """

    vertices: IntArray
    weights: sp.csr_matrix
    bending: sp.csr_matrix


def spread_nodes(mesh: TriMesh, spacing: FloatArray, candidates: IntArray, first: IntArray, count: int) -> IntArray:
    """Vertices spread evenly over a surface, each as far as possible from those before it.

    Parameters
    ----------
    spacing : (V,) distances are measured in these, so that nodes are denser where it is small.
    candidates : vertices to choose from.
    first : vertices that come first, whatever their distances.
    count : vertices to choose, the first ones included.

    References
    ----------
    Gonzalez 1985 (farthest-first traversal).
    """
    # Normals count as well, so that surfaces that touch, such as two lips, get nodes on both sides.
    unit = 1 / spacing[candidates] ** 2
    place = np.concatenate([mesh.vertices, 0.5 * np.median(spacing) * mesh.vertex_normals], axis=1)[candidates]
    place -= place.mean(axis=0)
    square = np.einsum("vc,vc->v", place, place)
    row = {int(v): i for i, v in enumerate(candidates)}
    chosen = list(dict.fromkeys(row[int(v)] for v in first))
    nearest = np.full(len(candidates), np.inf)
    for k in range(min(count, len(candidates))):
        if k == len(chosen):
            chosen.append(int(np.argmax(nearest * unit)))
        np.minimum(nearest, square + (square[chosen[k]] - 2 * (place @ place[chosen[k]])), out=nearest)
        nearest[chosen[k]] = -np.inf
    result: IntArray = candidates[np.array(chosen, np.int64)]
    return result


def control_nodes(mesh: TriMesh, nodes: IntArray, steps: sp.csr_matrix) -> ControlNodes:
    """Weights of given nodes (K,): moving least squares over the nodes that are near along the surface.

    steps : (V, V) lengths of the mesh's edges, by which the nearest node of each vertex is told.

    References
    ----------
    Lancaster and Salkauskas 1981 (moving least squares); Roweis and Saul 2000 (weights that predict a place from its
    neighbours).
    """
    count = len(nodes)
    distance, _, origin = dijkstra(steps, indices=nodes, min_only=True, return_predecessors=True)
    owner = np.full(len(mesh.vertices), -1, np.int64)
    owner[nodes] = np.arange(count)
    reached = np.flatnonzero(np.isfinite(distance))
    label = np.full(len(mesh.vertices), -1, np.int64)
    label[reached] = owner[origin[reached]]
    a, b = label[mesh.edges].T
    across = (a != b) & (a >= 0)
    touching = sp.coo_matrix((np.ones(across.sum()), (a[across], b[across])), shape=(count, count)).tocsr()
    touching = touching + touching.T + sp.identity(count, format="csr")
    around = (touching @ touching).tocsr()
    around.sort_indices()
    place = mesh.vertices[nodes]
    # One length per node: to its second ring, blended between nodes so that supports change smoothly.
    pairs = around.tocoo()
    gap = np.linalg.norm(place[pairs.row] - place[pairs.col], axis=1)
    reach = np.zeros(count)
    np.maximum.at(reach, pairs.row, gap)
    reach = np.asarray((sp.diags(1 / np.asarray((touching > 0).sum(axis=1)).ravel()) @ (touching > 0)) @ reach).ravel()
    weights = _least_squares_weights(mesh.vertices[reached], label[reached], around, place, 0.75 * reach, False)
    rows = reached[weights.row]
    full = sp.csr_matrix((weights.data, (rows, weights.col)), shape=(len(mesh.vertices), count))
    predicted = _least_squares_weights(place, np.arange(count), around, place, 0.75 * reach, True)
    return ControlNodes(nodes, full, (sp.identity(count) - predicted).tocsr())


def _least_squares_weights(
    points: FloatArray, label: IntArray, around: sp.csr_matrix, place: FloatArray, reach: FloatArray, leave_out: bool
) -> sp.coo_matrix:
    """Weights (N, K) over the nodes around each point's own; leave_out drops the own node."""
    size = np.diff(around.indptr)
    width = int(size.max())
    column = np.minimum(np.arange(width), size[:, None] - 1) + around.indptr[:-1, None]
    near = around.indices[column]
    valid = np.arange(width) < size[:, None]
    near, valid = near[label], valid[label]
    offset = place[near] - points[:, None]
    radius = np.linalg.norm(offset, axis=2) / reach[near]
    kernel = np.where(valid, np.maximum(1 - radius, 1e-6 * valid) ** 2 * (1 + 2 * radius), 0.0)
    if leave_out:
        kernel = np.where(near == label[:, None], 0.0, kernel)
    basis = [np.ones_like(kernel), *(offset / reach[label][:, None, None]).transpose(2, 0, 1)]
    moment = np.empty((len(points), 4, 4))
    for i in range(4):
        for j in range(i + 1):
            moment[:, i, j] = moment[:, j, i] = np.einsum("nk,nk,nk->n", kernel, basis[i], basis[j])
    # A surface is flat where nodes are dense: the ridge leaves its normal direction alone.
    moment[:, [1, 2, 3], [1, 2, 3]] += 1e-2 * moment[:, 0, 0, None]
    first = np.linalg.solve(moment, np.broadcast_to(np.eye(4)[:, :1], (len(points), 4, 1)))[..., 0]
    weight = kernel * sum(first[:, i, None] * basis[i] for i in range(4))
    weight /= weight.sum(axis=1, keepdims=True)
    row = np.repeat(np.arange(len(points)), width)
    keep = weight.ravel() != 0
    shape = (len(points), len(place))
    return sp.coo_matrix((weight.ravel()[keep], (row[keep], near.ravel()[keep])), shape=shape)
