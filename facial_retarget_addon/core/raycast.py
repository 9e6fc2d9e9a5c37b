"""Nearest hit of many rays."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray
from .mesh import TriMesh


class Hits(NamedTuple):
    """Where rays hit: distance (N,), inf without a hit; face (N,), -1 without; weights (N, 3) of its corners."""

    distance: FloatArray
    face: IntArray
    weights: FloatArray

    @property
    def found(self) -> BoolArray:
        """(N,) true where a ray hit."""
        mask: BoolArray = self.face >= 0
        return mask


class RayCaster(Protocol):
    """Casts rays on one mesh: Embree here, Blender's BVHTree where no Embree wheel exists."""

    def nearest(self, origins: FloatArray, directions: FloatArray, limit: FloatArray | float = np.inf) -> Hits:
        """Nearest hit of each ray (origins and unit directions (N, 3)) within `limit` (N,) units."""
        ...


CasterFactory = Callable[[TriMesh], RayCaster]
"""Makes a caster of a mesh: `EmbreeCaster`, or Blender's where it runs."""


class EmbreeCaster:
    """Ray casting through Embree, in float32: places agree with double precision to 2e-7 of the size."""

    def __init__(self, mesh: TriMesh) -> None:
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        self._mesh = mesh
        # Embree works in float32: centred and scaled to 1, so that position and unit cost no digits.
        used = mesh.vertices[np.unique(mesh.faces)]
        self._centre = 0.5 * (used.min(axis=0) + used.max(axis=0))
        self._scale = 1.0 / max(float(np.ptp(used, axis=0).max()), 1e-300)
        self._scene = EmbreeScene()
        corners = (mesh.vertices - self._centre) * self._scale
        TriangleMesh(self._scene, corners.astype(np.float32), mesh.faces.astype(np.int32))

    def nearest(self, origins: FloatArray, directions: FloatArray, limit: FloatArray | float = np.inf) -> Hits:
        """Nearest hit of each ray; see RayCaster."""
        count = len(origins)
        reach = np.broadcast_to(np.asarray(limit, np.float64) * self._scale, (count,))
        if not count:
            return Hits(np.empty(0), np.empty(0, np.int64), np.empty((0, 3)))
        start = np.ascontiguousarray((origins - self._centre) * self._scale, np.float32)
        along = np.ascontiguousarray(directions, np.float32)
        found = self._scene.run(start, along, np.minimum(reach, 1e30).astype(np.float32), output=True)
        face = found["primID"].astype(np.int64)
        face[found["tfar"] > reach * (1 + 1e-6)] = -1
        hit = face >= 0
        u, v = found["u"].astype(np.float64), found["v"].astype(np.float64)
        weights = np.where(hit[:, None], np.stack([1 - u - v, u, v], axis=1), 0.0)
        distance = np.where(hit, found["tfar"].astype(np.float64) / self._scale, np.inf)
        return Hits(distance, face, weights)
