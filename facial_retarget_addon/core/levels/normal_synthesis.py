"""Frames out of base mesh positions and normal offsets: the fast half of a normal mesh."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, IntArray, cross, unit_vectors
from ..errors import RetargetError
from ..mesh import TriMesh
from .normal_mesh import NormalLevel, NormalMesh, SecondLook
from .vertex_neighbours import incidence


class NormalSynthesis:
    """Rebuilds the levels of a normal mesh, frame by frame, in float32.

    Per level: subdivision, boundary vertices moved by their displacement (and the others near by after them), every
    other vertex moved by its offset along the unit normal; vertices of a second look and failed ones placed anew by
    the mean of their neighbours. With the neutral's own base and offsets the result is the neutral's normal mesh.

    References
    ----------
    Na and Jung 2004, equations (6) and (8).
    """

    def __init__(self, normal_mesh: NormalMesh) -> None:
        self._levels = [
            _LevelSynthesis(step.matrix, level)
            for step, level in zip(normal_mesh.steps, normal_mesh.levels, strict=True)
        ]
        self._neutral = [level.offsets.astype(np.float32) for level in normal_mesh.levels]
        self._base_count = len(normal_mesh.base)

    def frames(self, base: FloatArray, offsets: Sequence[FloatArray] | None = None) -> FloatArray:
        """Finest positions of a block of frames.

        Parameters
        ----------
        base : (F, B, 3) positions of the base vertices.
        offsets : per level (N,) for all frames or (F, N) for each; the neutral's if none are given.

        Returns
        -------
        (F, N, 3) float32.
        """
        base = np.asarray(base, np.float32)
        if base.ndim != 3 or base.shape[1:] != (self._base_count, 3):
            raise RetargetError(f"base positions have shape {base.shape}, expected (F, {self._base_count}, 3)")
        chosen = self._neutral if offsets is None else [np.asarray(o, np.float32) for o in offsets]
        for k, (mine, level) in enumerate(zip(chosen, self._levels, strict=True)):
            if mine.shape not in ((level.count,), (len(base), level.count)):
                raise RetargetError(
                    f"offsets of level {k + 1} have shape {mine.shape}, expected ({level.count},) or "
                    f"({len(base)}, {level.count})"
                )
        finest = np.empty((len(base), self._levels[-1].count, 3), np.float32)
        for frame, positions in enumerate(base):
            for level, own in zip(self._levels, chosen, strict=True):
                positions = level.apply(positions, own if own.ndim == 1 else own[frame])
            finest[frame] = positions
        return finest


class _LevelSynthesis:
    """The fixed matrices and the scratch of one level."""

    def __init__(self, matrix: sp.csr_matrix, level: NormalLevel) -> None:
        self.count = int(matrix.shape[0])
        self._matrix = matrix.astype(np.float32)
        self._corners = np.ascontiguousarray(level.faces.T).astype(np.intp)
        self._incidence = incidence(TriMesh(level.positions, level.faces)).astype(np.float32)
        self._boundary, self._displacement = level.boundary, level.displacement.astype(np.float32)
        # The boundary's displacement is constant, and so is what follows it.
        self._followers = np.flatnonzero(np.diff(level.spread.indptr))
        self._following = (level.spread @ level.displacement)[self._followers].astype(np.float32)
        self._looks = [_LookSynthesis(look, level.faces) for look in level.second_looks]
        self._failed = np.flatnonzero(level.failed)
        self._fill, self._correction = level.fill.astype(np.float32), level.correction.astype(np.float32)
        # One row per coordinate: contiguous rows are twice as fast as columns.
        self._scratch = np.empty((10, len(level.faces)), np.float32)
        self._sums = np.empty((3, self.count), np.float32)

    def apply(self, coarse: FloatArray, offsets: FloatArray) -> FloatArray:
        fine: FloatArray = self._matrix @ coarse
        fine[self._boundary] += self._displacement
        fine[self._followers] += self._following
        normals = self._normals(fine)
        normals *= offsets
        fine += normals.T
        for look in self._looks:
            look.apply(fine)
        if len(self._failed):
            fine[self._failed] = self._fill @ fine + self._correction
        return fine

    def _normals(self, positions: FloatArray) -> FloatArray:
        """Area-weighted unit normals (3, N)."""
        by_coordinate = np.ascontiguousarray(positions.T)
        corners = self._scratch[:9].reshape(3, 3, -1)
        for k in range(3):
            for axis in range(3):
                np.take(by_coordinate[axis], self._corners[k], out=corners[k, axis], mode="clip")
        origin, u, v = corners
        u -= origin
        v -= origin
        product, other = origin[0], self._scratch[9]
        normals = self._sums
        for axis, (j, k) in enumerate(((1, 2), (2, 0), (0, 1))):
            np.multiply(u[j], v[k], out=product)
            np.multiply(u[k], v[j], out=other)
            product -= other
            normals[axis] = self._incidence @ product
        length = np.einsum("ij,ij->j", normals, normals)
        np.sqrt(length, out=length)
        np.maximum(length, 1e-30, out=length)
        normals /= length
        return normals


class _LookSynthesis:
    """A second look on the few faces that it needs."""

    def __init__(self, look: SecondLook, faces: IntArray) -> None:
        used = np.unique(look.direction.indices)
        self._faces = faces[used]
        self._direction = look.direction[:, used].astype(np.float32)
        self._vertices, self._fill = look.vertices, look.fill.astype(np.float32)
        self._offsets = look.offsets.astype(np.float32)[:, None]

    def apply(self, positions: FloatArray) -> None:
        positions[self._vertices] = self._fill @ positions
        a, b, c = (positions[self._faces[:, k]] for k in range(3))
        normals = unit_vectors(self._direction @ cross(b - a, c - a))
        positions[self._vertices] += self._offsets * normals
