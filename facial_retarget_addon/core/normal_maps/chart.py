"""Texture coordinates for a level of a normal mesh, which has none of its own."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from ..arrays import FloatArray, unit_vectors
from ..errors import RetargetError
from ..mesh import TriMesh

_ROOM = 0.49
"""Radius of the disc that the chart fills, in texture widths: a border of one hundredth stays free."""


def disc_chart(mesh: TriMesh) -> FloatArray:
    """Texture coordinates (V, 2) of a surface with one outer border, without overlaps.

    The longest border becomes a circle around (0.5, 0.5), with lengths along it kept; every other vertex lies at the
    mean-value mean of its neighbours. The other borders (eyes, mouth) are closed for that by a vertex each.

    Raises
    ------
    RetargetError : if the mesh is not in one piece or has no border.

    References
    ----------
    Tutte 1963; Floater 2003, "Mean value coordinates".
    """
    loops = mesh.boundary_loops
    if not loops or mesh.components[mesh.faces].max(initial=0) != mesh.components[mesh.faces].min(initial=0):
        raise RetargetError(
            f"the mesh has {len(np.unique(mesh.components[mesh.faces]))} pieces and {len(loops)} borders, "
            "expected one piece with at least one border"
        )
    outer, closed = loops[0], _with_holes_closed(mesh)
    count = len(closed.vertices)
    places = np.zeros((count, 2))
    steps = np.linalg.norm(mesh.vertices[np.roll(outer, -1)] - mesh.vertices[outer], axis=1)
    turn = 2 * np.pi * (np.cumsum(steps) - steps) / steps.sum()
    places[outer] = 0.5 + _ROOM * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    inner = np.setdiff1d(np.unique(closed.faces), outer)
    weights = _mean_values(closed)
    total = sp.diags(np.asarray(weights.sum(axis=1)).ravel())
    system = (total - weights).tocsr()[inner]
    places[inner] = splu(system[:, inner].tocsc()).solve(-(system[:, outer] @ places[outer]))
    chart: FloatArray = places[: len(mesh.vertices)]
    return chart


def _with_holes_closed(mesh: TriMesh) -> TriMesh:
    """The mesh with a fan over every border but the longest."""
    vertices, faces = [mesh.vertices], [mesh.faces]
    for number, loop in enumerate(mesh.boundary_loops[1:]):
        vertices.append(mesh.vertices[loop].mean(axis=0)[None])
        middle = np.full(len(loop), len(mesh.vertices) + number)
        faces.append(np.stack([np.roll(loop, -1), loop, middle], axis=1))
    return TriMesh(np.concatenate(vertices), np.concatenate(faces))


def _mean_values(mesh: TriMesh) -> sp.csr_matrix:
    """(V, V) weights of each vertex's neighbours: the tangents of the half angles on either side, over the length."""
    corners = mesh.vertices[mesh.faces]
    rows, columns, values = [], [], []
    for k in range(3):
        here, ahead, behind = k, (k + 1) % 3, (k + 2) % 3
        one, two = corners[:, ahead] - corners[:, here], corners[:, behind] - corners[:, here]
        cosine = np.clip(np.einsum("fi,fi->f", unit_vectors(one), unit_vectors(two)), -1 + 1e-9, 1.0)
        half = np.sqrt((1 - cosine) / (1 + cosine))
        for other, side in ((ahead, one), (behind, two)):
            rows.append(mesh.faces[:, here])
            columns.append(mesh.faces[:, other])
            values.append(half / np.maximum(np.linalg.norm(side, axis=1), 1e-12 * mesh.size))
    shape = (len(mesh.vertices),) * 2
    return sp.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=shape)
