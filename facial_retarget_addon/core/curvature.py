"""Principal curvatures and directions of a mesh, and the rotations that they give between two faces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import FloatArray, IntArray, cross, unit_vectors
from .mesh import TriMesh
from .rigid import closest_rotations

ESTIMATORS = ("least_squares", "taubin")

_FLAT = 0.05
"""Curvature times edge length that counts for little beside its own error."""
AGREEMENT = 15.0
"""Degrees between a principal direction and the one that the edges around it carry over, from which on it counts for
nothing: the match is off there, or the estimate."""
_ROUND, _CLEAR = 0.05, 0.2
"""Anisotropies below which principal directions say nothing, and above which they decide."""


@dataclass(frozen=True, eq=False)
class PrincipalFrames:
    """Normals and principal directions at the vertices of a mesh.

    Attributes
    ----------
    axes : (V, 3, 3) right-handed; rows normal, direction of the larger curvature, direction of the smaller one.
    curvatures : (V, 2) larger and smaller, in 1 / units; negative where the surface is convex, seen along its normal.
    anisotropy : (V,) from 0 for a round or flat place, whose directions mean nothing, to 1.
    """

    axes: FloatArray
    curvatures: FloatArray
    anisotropy: FloatArray


def principal_frames(mesh: TriMesh, estimator: str = "least_squares") -> PrincipalFrames:
    """Principal curvatures from the normal curvatures k_ij = 2 N_i . (v_j - v_i) / |v_j - v_i|^2 along the edges.

    Parameters
    ----------
    mesh : of outward faces.
    estimator : "least_squares" fits a second fundamental form to the k_ij, weighted by the areas at the edges, and
        converges with the square of the edge; "taubin" reads it from the eigenvalues of the tensor sum, which takes
        edges for evenly spread and does not converge where they are not.

    References
    ----------
    Taubin 1995 (ICCV, 902-907).
    """
    normals = mesh.vertex_normals
    across, along = _tangents(normals)
    basis = np.stack([across, along], axis=1)
    here, there, weights = _directed_edges(mesh)
    edges = mesh.vertices[there] - mesh.vertices[here]
    squared = np.maximum(np.square(edges).sum(axis=1), 1e-300)
    bend = 2 * np.einsum("ei,ei->e", normals[here], edges) / squared
    flat = np.einsum("eki,ei->ek", basis[here], edges)
    flat /= np.maximum(np.linalg.norm(flat, axis=1, keepdims=True), 1e-300)
    if estimator == "taubin":
        form = _taubin(here, weights, bend, flat, len(normals))
    else:
        form = _least_squares(here, weights, bend, flat, len(normals))
    values, vectors = np.linalg.eigh(form)
    larger = np.einsum("vk,vki->vi", vectors[:, :, 1], basis)
    axes = np.stack([normals, larger, cross(normals, larger)], axis=1)
    size = np.abs(values).sum(axis=1) + _FLAT / np.maximum(mesh.vertex_edge_length, 1e-300)
    return PrincipalFrames(axes, values[:, ::-1], (values[:, 1] - values[:, 0]) / size)


def frame_rotations(
    source: TriMesh, target: TriMesh, estimator: str = "least_squares", agreement: float | None = AGREEMENT
) -> FloatArray:
    """Rotations (V, 3, 3) from each vertex's frame on the source to its frame on the target.

    Principal directions are lines without a sign, swap where the curvatures do, and mean nothing at round and flat
    places. So the best rotation of the ring of edges around a vertex, turned to take normal to normal, carries the
    source's first direction over; of the target's four directions the closest one is meant (of two where both faces
    are clearly anisotropic), and it counts as much as both faces are anisotropic there and as it agrees with what was
    carried over. A mesh onto itself gives the identity, a turned one that turn.

    Parameters
    ----------
    source, target : two meshes of the same faces.
    agreement : in degrees, see `AGREEMENT`; None to follow the target's direction wherever it lies.

    References
    ----------
    Min and Jung 2005, equations (4) and (5), which leave the choice of the directions open.
    """
    ours, theirs = principal_frames(source, estimator), principal_frames(target, estimator)
    carried = np.einsum("vij,vj->vi", _ring_rotations(source, target, ours, theirs), ours.axes[:, 1])
    normals = theirs.axes[:, 0]
    carried = unit_vectors(carried - np.einsum("vi,vi->v", carried, normals)[:, None] * normals)
    trust = np.minimum(ours.anisotropy, theirs.anisotropy)
    first = np.einsum("vi,vi->v", carried, theirs.axes[:, 1])
    second = np.einsum("vi,vi->v", carried, theirs.axes[:, 2])
    swapped = (np.abs(second) > np.abs(first)) & (trust < _CLEAR)
    chosen = np.where(swapped[:, None], theirs.axes[:, 2], theirs.axes[:, 1])
    chosen = chosen * np.where(np.where(swapped, second, first) < 0, -1.0, 1.0)[:, None]
    step = np.clip((trust - _ROUND) / (_CLEAR - _ROUND), 0, 1)
    share = step * step * (3 - 2 * step)
    if agreement is not None:
        least = np.cos(np.radians(agreement))
        share *= np.clip((np.einsum("vi,vi->v", carried, chosen) - least) / (1 - least), 0, 1)
    direction = _between(carried, chosen, normals, share)
    axes = np.stack([normals, direction, cross(normals, direction)], axis=1)
    rotations: FloatArray = np.einsum("vki,vkj->vij", axes, ours.axes)
    return rotations


def _tangents(normals: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two unit vectors (V, 3) each, right-handed with the normals."""
    least = np.eye(3)[np.abs(normals).argmin(axis=1)]
    first = unit_vectors(cross(normals, least))
    return first, cross(normals, first)


def _directed_edges(mesh: TriMesh) -> tuple[IntArray, IntArray, FloatArray]:
    """Both directions of every edge, and the area of the faces at it."""
    area = np.bincount(mesh.face_edges.ravel(), np.repeat(mesh.face_areas, 3), len(mesh.edges))
    here, there = np.concatenate([mesh.edges, mesh.edges[:, ::-1]]).T
    return here, there, np.concatenate([area, area])


def _taubin(here: IntArray, weights: FloatArray, bend: FloatArray, flat: FloatArray, count: int) -> FloatArray:
    """(V, 2, 2) second fundamental forms out of the tensors sum w k T T^T: k1 = 3 m1 - m2, k2 = 3 m2 - m1."""
    total = np.bincount(here, weights, count)
    share = weights / np.maximum(total[here], 1e-300)
    tensor = _sums(here, (share * bend)[:, None, None] * flat[:, :, None] * flat[:, None, :], count)
    trace = np.trace(tensor, axis1=1, axis2=2)
    # 3 m1 - m2 = 4 m1 - (m1 + m2), in the tensor's own eigenvectors.
    form: FloatArray = 4 * tensor - trace[:, None, None] * np.eye(2)
    return form


def _least_squares(here: IntArray, weights: FloatArray, bend: FloatArray, flat: FloatArray, count: int) -> FloatArray:
    """(V, 2, 2) forms with the least weighted squared error of T^T II T against the k_ij."""
    terms = np.stack([flat[:, 0] ** 2, 2 * flat[:, 0] * flat[:, 1], flat[:, 1] ** 2], axis=1)
    total = np.bincount(here, weights, count)
    share = weights / np.maximum(total[here], 1e-300)
    system = _sums(here, share[:, None, None] * terms[:, :, None] * terms[:, None, :], count)
    right = _sums(here, (share * bend)[:, None] * terms, count)
    a, b, c = np.einsum("vij,vj->iv", np.linalg.pinv(system, rcond=1e-9, hermitian=True), right)
    return np.stack([a, b, b, c], axis=1).reshape(-1, 2, 2)


def _sums(rows: IntArray, values: FloatArray, count: int) -> FloatArray:
    flat = values.reshape(len(values), -1)
    summed: FloatArray = np.stack([np.bincount(rows, column, count) for column in flat.T], axis=1)
    return summed.reshape(count, *values.shape[1:])


def _ring_rotations(source: TriMesh, target: TriMesh, ours: PrincipalFrames, theirs: PrincipalFrames) -> FloatArray:
    """(V, 3, 3) rotations that best take the edges around each vertex, then its normal, to the target's."""
    here, there, _ = _directed_edges(source)
    before, after = (mesh.vertices[there] - mesh.vertices[here] for mesh in (source, target))
    # The normal counts as one more edge: a flat ring alone leaves its side open.
    reach = np.bincount(here, np.sqrt(np.square(before).sum(axis=1) * np.square(after).sum(axis=1)), len(ours.axes))
    normal = reach[:, None, None] * theirs.axes[:, 0, :, None] * ours.axes[:, 0, None, :]
    rings = closest_rotations(_sums(here, after[:, :, None] * before[:, None, :], len(ours.axes)) + normal)[0]
    return rings


def _between(start: FloatArray, end: FloatArray, normals: FloatArray, share: FloatArray) -> FloatArray:
    """Unit tangents from start to end, both (V, 3), at a share of the angle between them."""
    sine, cosine = np.einsum("vi,vi->v", cross(start, end), normals), np.einsum("vi,vi->v", start, end)
    angle = (share * np.arctan2(sine, cosine))[:, None]
    turned: FloatArray = np.cos(angle) * start + np.sin(angle) * cross(normals, start)
    return turned
