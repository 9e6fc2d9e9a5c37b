"""Ways to take a source's motion to a target: linear, pierced, and one riding on another."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import scipy.sparse as sp
from scipy.spatial.transform import Rotation

from .arrays import FloatArray
from .binding import Binding, apply_matrix
from .levels.normal_mesh import NormalMesh
from .rigid import Similarity
from .source_reader import SourceReader

Motion = Callable[[FloatArray], FloatArray]
"""Source frames (F, Vs, 3) float32 to target displacements (F, V, 3) float32, in target units."""

TURN_REACH = 0.35
"""Neighbourhood of a local frame, in eye separations."""
_UNSURE = np.radians(5)
"""By how much surfaces may turn against one another without the motion turning."""


class LinearMotion:
    """A matrix on the source's displacements, then a similarity's scale and rotation.

    Parameters
    ----------
    matrix : (V, Vs) source displacements to the target's places, in source units.
    rest : (Vs, 3) the source's neutral.
    similarity : source to target.
    turns : (V, 3, 3) rotations in place of the similarity's own; None for none.
    """

    def __init__(
        self, matrix: sp.csr_matrix, rest: FloatArray, similarity: Similarity, turns: FloatArray | None = None
    ) -> None:
        self._matrix = (similarity.scale * matrix).astype(np.float32)
        self._rest = rest.astype(np.float32)
        self._turns = np.asarray(similarity.rotation if turns is None else turns, np.float32)

    def __call__(self, frames: FloatArray) -> FloatArray:
        """Displacements (F, V, 3) for source frames (F, Vs, 3)."""
        return turn(apply_matrix(self._matrix, frames - self._rest), self._turns)


class PiercedMotion:
    """Motion of the finest level between normal meshes pierced frame by frame.

    Parameters
    ----------
    reader : reads the source's frames.
    neutral : the source's normal mesh.
    gains : strengths of the base and of each level.
    similarity, turns : as for LinearMotion.
    """

    def __init__(
        self,
        reader: SourceReader,
        neutral: NormalMesh,
        gains: Sequence[float],
        similarity: Similarity,
        turns: FloatArray | None = None,
    ) -> None:
        self._reader, self._neutral, self._gains = reader, neutral, gains
        self._scale = similarity.scale
        self._turns = np.asarray(similarity.rotation if turns is None else turns, np.float32)
        # Read like any frame, so that no motion in is no motion out, bit for bit.
        self._rest = reader.levels(reader.rest)

    def __call__(self, frames: FloatArray) -> FloatArray:
        """Displacements (F, N, 3) for source frames (F, Vs, 3)."""
        rest = self._rest
        moved = np.empty((len(frames), len(rest[-1]), 3), np.float32)
        for k, frame in enumerate(frames):
            levels = [now - before for now, before in zip(self._reader.levels(frame), rest, strict=True)]
            scaled = self._gains[0] * levels[0]
            for step, coarse, fine, gain in zip(
                self._neutral.steps, levels[:-1], levels[1:], self._gains[1:], strict=True
            ):
                scaled = step.matrix @ scaled + gain * (fine - step.matrix @ coarse)
            moved[k] = self._scale * scaled
        return turn(moved, self._turns)


class BlendedMotion:
    """The target's vertices riding on a fine mesh that moves, and beyond its border on another motion.

    Parameters
    ----------
    fine : motion of the fine mesh's vertices.
    binding : the target's vertices on it.
    beyond : motion of the target's vertices away from it.
    """

    def __init__(self, fine: Motion, binding: Binding, beyond: Motion) -> None:
        self._fine, self._binding, self._beyond = fine, binding, beyond

    def __call__(self, frames: FloatArray) -> FloatArray:
        """Displacements (F, V, 3) for source frames (F, Vs, 3)."""
        inside = self._binding.inside.astype(np.float32)[:, None]
        blended: FloatArray = inside * self._binding.displacements(self._fine(frames))
        blended += (1 - inside) * self._beyond(frames)
        return blended


def turn(displacements: FloatArray, turns: FloatArray) -> FloatArray:
    """Displacements (F, V, 3) turned by one rotation (3, 3) or by one for each vertex (V, 3, 3)."""
    if turns.ndim == 2:
        turned: FloatArray = displacements @ turns.T
        return turned
    # All frames of a vertex at once: many times faster than vertex by vertex in every frame.
    by_vertex = np.ascontiguousarray(displacements.transpose(1, 0, 2)) @ turns.transpose(0, 2, 1)
    turned = np.ascontiguousarray(by_vertex.transpose(1, 0, 2))
    return turned


def local_turns(
    before: FloatArray,
    after: FloatArray,
    vertices: FloatArray,
    trust: FloatArray,
    base: FloatArray,
    separation: float,
    places: FloatArray,
    reach: float = TURN_REACH,
) -> FloatArray:
    """(N, 3, 3) rotations at places, each the one that best takes the normals around it to the other face's.

    Normals of a whole neighbourhood are steady where frames of a few feature points are not.

    Parameters
    ----------
    before, after : (V, 3) unit normals at the target's vertices: the source's there, and the target's own.
    vertices : (V, 3) of the target.
    trust : (V,) weight of each vertex.
    base : (B, 3) neutral base vertices of the target, at which rotations are found.
    separation : the target's eye separation.
    places : (N, 3) on the target.
    reach : of a neighbourhood, in eye separations.

    References
    ----------
    Wahba 1965; Markley 1988 for the solution by singular values.
    """
    counts = np.flatnonzero(trust > 0)
    # In single precision from the middle of the face: the weights are smooth, and there are millions of them.
    middle, unit = base.mean(axis=0), np.sqrt(2) * reach * separation
    here, there = ((part - middle) / unit for part in (base, vertices[counts]))
    near = _falling(here, there) * trust[counts]
    products = after[counts, :, None] * before[counts, None, :]
    at_base = _nearest_rotations((near @ products.reshape(-1, 9)).reshape(-1, 3, 3))
    # All base vertices count at every place: nearest ones alone would leave a grain where their set changes.
    at_places = _falling((places - middle) / unit, here)
    blended = at_places @ at_base.reshape(-1, 9) / at_places.sum(axis=1, keepdims=True)
    return _nearest_rotations(blended.reshape(-1, 3, 3))


def _falling(places: FloatArray, others: FloatArray) -> FloatArray:
    """(N, M) exp(-d²) of the distances from places (N, 3) to others (M, 3), over that of each place's nearest one."""
    squared = np.square(places).sum(axis=1)[:, None] + np.square(others).sum(axis=1) - 2 * (places @ others.T)
    squared -= squared.min(axis=1, keepdims=True)
    falling: FloatArray = np.exp(-squared.astype(np.float32))
    return falling


def steady_turns(turns: FloatArray) -> FloatArray:
    """Rotations (V, 3, 3) less by the angle `_UNSURE`, none where they turn by less.

    Small turns tell how two artists shaped their heads, not where their muscles pull.
    """
    vectors = Rotation.from_matrix(turns).as_rotvec()
    angle = np.linalg.norm(vectors, axis=1, keepdims=True)
    less = vectors * np.maximum(angle - _UNSURE, 0.0) / np.maximum(angle, 1e-300)
    steady: FloatArray = Rotation.from_rotvec(less).as_matrix()
    return steady


def _nearest_rotations(matrices: FloatArray) -> FloatArray:
    """Proper rotations (V, 3, 3) closest to matrices (V, 3, 3)."""
    u, _, vt = np.linalg.svd(matrices)
    u[:, :, 2] *= np.linalg.det(u @ vt)[:, None]
    rotations: FloatArray = u @ vt
    return rotations
