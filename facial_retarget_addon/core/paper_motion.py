"""The published method: base by multiquadrics of the examples, details as signed normal offsets."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .arrays import FloatArray
from .levels.normal_mesh import NormalMesh
from .levels.normal_synthesis import NormalSynthesis
from .mesh import TriMesh
from .source_reader import SourceReader
from .steering.rbf import MultiquadricMaps


class PaperMotion:
    """Na and Jung's retargeting, equations (3), (4) and (6) to (9), with the corrections that make them solvable.

    The multiquadrics have centres (the printed ones have rank 1), and the detail scale is the square
    root of the printed area ratio, since offsets are lengths.

    Parameters
    ----------
    reader : reads the source's frames.
    maps : base displacements of the source to those of the target.
    source, target : neutral normal meshes.
    gains : strengths of the base and of each level.
    """

    def __init__(
        self,
        reader: SourceReader,
        maps: MultiquadricMaps,
        source: NormalMesh,
        target: NormalMesh,
        gains: Sequence[float],
    ) -> None:
        self._reader, self._maps, self._source, self._target, self._gains = reader, maps, source, target, gains
        self._synthesis = NormalSynthesis(target)
        ours, theirs = (TriMesh(mesh.levels[-1].positions, mesh.levels[-1].faces).area for mesh in (source, target))
        self.detail_scale = float(np.sqrt(theirs / ours))
        # Read like any frame, so that no motion in is no motion out, bit for bit.
        self._rest_levels = reader.levels(reader.rest)
        self._rest_offsets = self._offsets(self._rest_levels)
        self._rest = np.zeros((1, len(target.levels[-1].positions), 3), np.float32)
        self._rest = self(reader.rest[None])

    def __call__(self, frames: FloatArray) -> FloatArray:
        """Displacements (F, N, 3) of the target's finest level for source frames (F, Vs, 3)."""
        base = np.empty((len(frames), *self._target.base.shape))
        offsets = [np.empty((len(frames), len(level.offsets)), np.float32) for level in self._target.levels]
        for k, frame in enumerate(frames):
            levels = self._reader.levels(frame)
            base[k] = self._gains[0] * self._maps((levels[0] - self._rest_levels[0])[None])[0]
            changes = self._offsets(levels)
            for j, (level, rest) in enumerate(zip(self._target.levels, self._rest_offsets, strict=True)):
                offsets[j][k] = level.offsets + self._gains[j + 1] * self.detail_scale * (changes[j] - rest)
        moved = self._fine(offsets, base)
        moved -= self._rest
        return moved

    def _fine(self, offsets: Sequence[FloatArray], base: FloatArray) -> FloatArray:
        """Finest positions for base displacements (F, B, 3) (equation 8)."""
        return self._synthesis.frames(self._target.base + base, offsets)

    def _offsets(self, levels: Sequence[FloatArray]) -> list[FloatArray]:
        """Signed distances along the prediction's normals (equation 6), per level."""
        found = []
        for step, coarse, fine, level in zip(
            self._source.steps, levels[:-1], levels[1:], self._source.levels, strict=True
        ):
            predicted = step.matrix @ coarse
            normals = TriMesh(predicted, step.faces).vertex_normals
            offset = np.einsum("ij,ij->i", fine - predicted, normals)
            offset[level.boundary] = 0.0
            found.append(offset)
        return found
