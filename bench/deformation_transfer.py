"""The peer: deformation transfer (Sumner and Popovic 2004) in gradient form, its solver factored once.

Every target triangle takes the deformation gradient of the source triangle at its counterpart; one
least-squares solve per frame finds the vertices (Botsch et al. 2006 for the form with V unknowns).

The correspondence is that of its users: the source's points are warped onto the target's (biharmonic spline), then
every target triangle takes the source triangle that is closest to its centre and faces the same way (the paper pairs
triangles by centre and normal as well, after a warp that closes in on the target in four passes).
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from facial_retarget_addon.core.arrays import FloatArray, IntArray, cross, unit_vectors
from facial_retarget_addon.core.closest_point import SurfaceFinder, closest_agreeing
from facial_retarget_addon.core.matching.smooth_warp import fit_smooth_warp
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.problem import Problem

from .alignment import AGREEMENT, common_places, head_similarity


class DeformationTransfer:
    """Fitted to a pair of faces and a source triangle (Ft,) for every target triangle."""

    def __init__(
        self, source: TriMesh, target: TriMesh, source_face: IntArray, still: FloatArray | None = None
    ) -> None:
        """Invert the source triangles that are used and factor the target's system.

        One vertex of each component stays in its place: that of the greatest value in `still` (Vt,), or the first.
        """
        self._faces = source.faces[source_face]
        self._inverse = np.linalg.inv(_edges(source.vertices, self._faces).astype(np.float64))
        gradient = _gradient_operator(target)
        area = np.repeat(target.face_areas, 3)
        self._right = (gradient.T @ sp.diags(area)).tocsr()
        count = len(target.vertices)
        labels = target.components
        order = np.arange(count) if still is None else np.argsort(-still, kind="stable")
        pins = order[np.unique(labels[order], return_index=True)[1]]
        self._pin = sp.csr_matrix((np.ones(len(pins)), (pins, pins)), shape=(count, count)) * area.mean()
        system = (self._right @ gradient + self._pin).tocsc()
        self._solver = splu(system, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        self._rest = self._pin @ target.vertices

    def frame(self, source: FloatArray) -> FloatArray:
        """Target positions (Vt, 3) of one source frame (Vs, 3)."""
        gradients = np.einsum("fij,fjk->fik", _edges(source, self._faces), self._inverse)
        # Row 3 f + k of the operator is the derivative along axis k: the transposed gradient, stacked.
        solved: FloatArray = self._solver.solve(self._right @ gradients.transpose(0, 2, 1).reshape(-1, 3) + self._rest)
        return solved


class AlignedTransfer:
    """Deformation transfer with a correspondence of its own, between heads laid on one another."""

    def __init__(self, problem: Problem) -> None:
        """Find the source triangle of every target triangle, and factor."""
        self._similarity = head_similarity(problem)
        source = problem.source.mesh
        aligned = source.with_vertices(self._similarity.apply(source.vertices))
        target = problem.target.mesh
        # What is farthest from the points, the neck or the back of the head, stays.
        far = np.linalg.norm(target.vertices - common_places(problem)[1].mean(axis=0), axis=1)
        self._transfer = DeformationTransfer(aligned, target, matched_faces(problem), far)

    def frames(self, source: FloatArray) -> FloatArray:
        """Target positions (F, Vt, 3) of source frames (F, Vs, 3)."""
        return np.stack([self._transfer.frame(frame) for frame in self._similarity.apply(source)])


def matched_faces(problem: Problem) -> IntArray:
    """(Ft,) the source triangle of each target triangle."""
    source, target = problem.source.mesh, problem.target.mesh
    warp = fit_smooth_warp(*common_places(problem))
    finder = SurfaceFinder(source.with_vertices(warp.apply(source.vertices)))
    centres = target.vertices[target.faces].mean(axis=1)
    return closest_agreeing(finder, centres, target.face_normals, AGREEMENT).face


def _edges(vertices: FloatArray, faces: IntArray) -> FloatArray:
    """(F, 3, 3) columns: two edges and the unit normal."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return np.stack([b - a, c - a, unit_vectors(cross(b - a, c - a))], axis=2)


def _gradient_operator(mesh: TriMesh) -> sp.csr_matrix:
    """(3 F, V) piecewise linear gradient: row 3 f + k is the derivative along axis k in face f."""
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    edges = np.stack([b - a, c - a], axis=1)
    gram = np.einsum("fik,fjk->fij", edges, edges)
    slopes = np.einsum("fij,fjk->fik", np.linalg.inv(gram), edges)
    corner = np.stack([-slopes.sum(axis=1), slopes[:, 0], slopes[:, 1]], axis=1)
    count = len(mesh.faces)
    rows = np.broadcast_to(3 * np.arange(count)[:, None, None] + np.arange(3), (count, 3, 3))
    columns = np.broadcast_to(mesh.faces[:, :, None], (count, 3, 3))
    return sp.csr_matrix((corner.ravel(), (rows.ravel(), columns.ravel())), shape=(3 * count, len(mesh.vertices)))
