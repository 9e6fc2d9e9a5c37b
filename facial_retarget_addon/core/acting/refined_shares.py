"""Shares of points evened out along the surface, and corrected so that points arrive where they are sent."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu
from scipy.spatial import cKDTree

from ..arrays import BoolArray, FloatArray, IntArray
from ..mesh import TriMesh
from ..points import FeaturePoints

FAINT = 1e-3
"""Evened-out shares below this are none."""
SMOOTH = 0.018
"""How far shares are evened out along the surface, as a share of the points' extent."""
BESIDE = 0.3
"""The most that shares are evened out, as a share of the median distance from a point to the next."""
SMALL = 1e-3
"""Finished shares below this are none."""
DAMPING = 0.15
"""Damping of the inverse, as a share of its largest singular value: nothing grows to more than half of 1 / it."""
CROWDED = 10.0
"""Points that could move independently only by more than this many times their motion move together instead."""
ASTRAY = 0.01
"""Points that miss their place by more than this share of a motion are named."""


def smoothing(places: FloatArray) -> float:
    """How far shares are evened out: by the extent along the head's axes of places (P, 3), not beyond those beside."""
    extent = float(np.linalg.norm(np.ptp(places, axis=0)))
    beside = cKDTree(places).query(places, k=2)[0][:, 1] if len(places) > 1 else np.array([extent])
    return min(SMOOTH * extent, BESIDE * float(np.median(beside)))


def refine_shares(
    mesh: TriMesh,
    points: FeaturePoints,
    count: int,
    acting: BoolArray,
    blocks: tuple[sp.csr_matrix, ...],
    smooth: float,
) -> tuple[tuple[sp.csr_matrix, ...], list[str]]:
    """The weights evened out along the surface, and then such that the first `count` points arrive where they are sent.

    Exactness may not cost wild motion beside the points: the shares are first brought near it with damping.

    Parameters
    ----------
    points : (n) the points, then the guides.
    acting : (n, 3) which of them act along each axis.
    blocks : three (V, n), from `point_weights`.
    smooth : how far along the surface shares are evened out.

    Returns
    -------
    Three (V, n) matrices, and warnings that name points too close together to move on their own.
    """
    areas = mesh.vertex_areas + 1e-12 * mesh.size**2
    even = splu((sp.diags(areas) + smooth**2 * _laplacian(mesh)).tocsc())
    places = points.matrix(len(mesh.vertices))
    refined, crowded = [], np.zeros(count, bool)
    for axis, block in enumerate(blocks):
        rows = np.flatnonzero(acting[:, axis])
        shares = even.solve(areas[:, None] * block[:, rows].toarray())
        shares[np.abs(shares) < FAINT] = 0.0
        own, held = np.flatnonzero(rows < count), places[rows[rows < count]]
        sent, astray = _sent(places[rows] @ shares, own)
        crowded[rows[own[astray]]] = True
        arriving = held @ shares @ sent
        # A point moves only what its neighbours reach; small shares are left out. What both would have done at the
        # points goes to the vertices that hold them.
        overlap = np.abs(shares).T @ np.abs(shares)
        near = shares @ np.where(overlap > 0, sent, 0.0)
        near[np.abs(near) < SMALL] = 0.0
        lost = np.linalg.pinv((held @ held.T).toarray()) @ (arriving - held @ near)
        exact = (sp.csr_matrix(near) + held.T @ sp.csr_matrix(lost)).tocoo()
        refined.append(sp.csr_matrix((exact.data, (exact.row, rows[exact.col])), shape=block.shape))
    together = [name for name, close in zip(points.names, crowded, strict=False) if close]
    crowd = f"points {', '.join(together)} lie so close together on this mesh that some of them move as one"
    return tuple(refined), [crowd] if together else []


def _sent(arriving: FloatArray, own: IntArray) -> tuple[FloatArray, BoolArray]:
    """What points and guides are to be sent so that the points (rows `own`) arrive where they should.

    Parameters
    ----------
    arriving : (n, n) where each arrives (row) when another (column) is sent to 1.

    Returns
    -------
    (n, n) for a column's motion, what each (row) is sent; and for each of the points whether it still goes astray.
    """
    u, size, vt = np.linalg.svd(arriving)
    damping = DAMPING * size.max(initial=0.0)
    damped = (vt.T * (size / (size**2 + damping**2))) @ u.T
    near = arriving[own] @ damped
    # What the guides get is near enough; the points themselves get the rest.
    missing = np.eye(len(arriving))[own] - near
    rest = np.linalg.pinv(near[:, own], rcond=1 / CROWDED) @ missing
    astray: BoolArray = np.abs(missing - near[:, own] @ rest).max(axis=1, initial=0.0) > ASTRAY
    return damped + damped[:, own] @ rest, astray


def _laplacian(mesh: TriMesh) -> sp.csr_matrix:
    """(V, V) cotangent Laplacian, positive semi-definite, with weights kept positive; rows add up to 0."""
    rows, columns, weights = [], [], []
    for a, b, c in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        i, j, k = mesh.faces[:, a], mesh.faces[:, b], mesh.faces[:, c]
        one, other = mesh.vertices[i] - mesh.vertices[k], mesh.vertices[j] - mesh.vertices[k]
        along = np.einsum("fi,fi->f", one, other)
        cotangent = along / np.maximum(2 * mesh.face_areas, 1e-300)
        rows += [i, j]
        columns += [j, i]
        weights += 2 * [0.5 * np.clip(cotangent, 0.02, 20.0)]
    entries = np.concatenate(weights), (np.concatenate(rows), np.concatenate(columns))
    pull = sp.csr_matrix(entries, shape=(len(mesh.vertices),) * 2)
    return (sp.diags(np.asarray(pull.sum(axis=1)).ravel()) - pull).tocsr()
