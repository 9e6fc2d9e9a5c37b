"""Frames out of base mesh positions and normal offsets: the fast half of a normal mesh."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy.sparse as sp

from .arrays import FloatArray, IntArray
from .errors import RetargetError
from .normal_mesh import NormalMesh


class NormalSynthesis:
    """Rebuilds the levels of a normal mesh, frame by frame, in float32.

    Per level: subdivision, boundary vertices moved by their displacement, every other vertex moved by its
    offset along the unit normal, failed vertices put at the mean of their neighbours plus their correction.
    With the neutral's own base and offsets the result is the neutral's normal mesh.

    References
    ----------
    Na and Jung 2004, equations (6) and (8).
    """

    def __init__(self, normal_mesh: NormalMesh) -> None:
        self._levels = [
            _LevelSynthesis(step.matrix, level.faces, level.boundary, level.displacement, level.fill, level.correction)
            for step, level in zip(normal_mesh.steps, normal_mesh.levels, strict=True)
        ]
        self._failed = [np.flatnonzero(level.failed) for level in normal_mesh.levels]
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
            for level, failed, own in zip(self._levels, self._failed, chosen, strict=True):
                positions = level.apply(positions, own if own.ndim == 1 else own[frame], failed)
            finest[frame] = positions
        return finest


class _LevelSynthesis:
    def __init__(
        self,
        matrix: sp.csr_matrix,
        faces: IntArray,
        boundary: IntArray,
        displacement: FloatArray,
        fill: sp.csr_matrix,
        correction: FloatArray,
    ) -> None:
        self.count = int(matrix.shape[0])
        self._matrix = matrix.astype(np.float32)
        self._corners = np.ascontiguousarray(faces.T).astype(np.intp)
        ones = np.ones(faces.size, np.float32)
        incidence = sp.csr_matrix((ones, (faces.ravel(), np.repeat(np.arange(len(faces)), 3))), (self.count, len(faces)))
        self._incidence = incidence
        self._boundary, self._displacement = boundary, displacement.astype(np.float32)
        self._fill, self._correction = fill.astype(np.float32), correction.astype(np.float32)
        self._a, self._b, self._c = (np.empty((len(faces), 3), np.float32) for _ in range(3))

    def apply(self, coarse: FloatArray, offsets: FloatArray, failed: IntArray) -> FloatArray:
        fine: FloatArray = self._matrix @ coarse
        fine[self._boundary] += self._displacement
        normals = self._normals(fine)
        normals *= offsets[:, None]
        fine += normals
        if len(failed):
            fine[failed] = self._fill @ fine + self._correction
        return fine

    def _normals(self, positions: FloatArray) -> FloatArray:
        a, b, c = self._a, self._b, self._c
        np.take(positions, self._corners[0], axis=0, out=a, mode="clip")
        np.take(positions, self._corners[1], axis=0, out=b, mode="clip")
        np.take(positions, self._corners[2], axis=0, out=c, mode="clip")
        b -= a
        c -= a
        np.multiply(b[:, 1], c[:, 2], out=a[:, 0])
        a[:, 0] -= b[:, 2] * c[:, 1]
        np.multiply(b[:, 2], c[:, 0], out=a[:, 1])
        a[:, 1] -= b[:, 0] * c[:, 2]
        np.multiply(b[:, 0], c[:, 1], out=a[:, 2])
        a[:, 2] -= b[:, 1] * c[:, 0]
        normals: FloatArray = self._incidence @ a
        length = np.einsum("ij,ij->i", normals, normals)
        np.sqrt(length, out=length)
        np.maximum(length, 1e-30, out=length)
        normals /= length[:, None]
        return normals
