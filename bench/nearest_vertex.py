"""The peer of least effort: every target vertex takes the motion of the nearest source vertex that faces its way.

The heads are laid on one another by the similarity of their common points (Umeyama 1991).
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.core.problem import Problem

from .alignment import AGREEMENT, head_similarity

CANDIDATES = 32


class NearestVertex:
    """Fitted to a pair of faces."""

    def __init__(self, problem: Problem) -> None:
        """Find the source vertex nearest to every target vertex."""
        source, target = problem.source.mesh, problem.target.mesh
        self._source, self._target = source.vertices, target.vertices
        self._similarity = head_similarity(problem)
        near = cKDTree(self._similarity.apply(source.vertices)).query(target.vertices, k=CANDIDATES)[1]
        normals = source.vertex_normals @ self._similarity.rotation.T
        agree = np.einsum("vkc,vc->vk", normals[near], target.vertex_normals) > AGREEMENT
        # Where none of them agrees, argmax gives the first, which is the nearest of all.
        self._nearest = near[np.arange(len(near)), agree.argmax(axis=1)]

    def frames(self, source: FloatArray) -> FloatArray:
        """Target positions (F, Vt, 3) of source frames (F, Vs, 3)."""
        moved: FloatArray = self._target + self._similarity.turn((source - self._source)[:, self._nearest])
        return moved
