"""Ray casting through Blender's BVHTree, where Embree has no wheel: Windows and Linux on ARM."""

from __future__ import annotations

from importlib.util import find_spec

import numpy as np
from mathutils.bvhtree import BVHTree

from ..core.arrays import FloatArray
from ..core.closest_point import closest_on_triangles
from ..core.mesh import TriMesh
from ..core.raycast import CasterFactory, EmbreeCaster, Hits


def available_caster() -> CasterFactory:
    """Embree where its wheel is installed, Blender's BVHTree elsewhere."""
    return EmbreeCaster if find_spec("embreex") is not None else BVHCaster


class BVHCaster:
    """Casts rays on one mesh; core's RayCaster, about four times slower than Embree."""

    def __init__(self, mesh: TriMesh) -> None:
        # BVHTree works in float32: centred and scaled to 1, so that position and unit cost no digits.
        used = mesh.vertices[np.unique(mesh.faces)]
        self._centre = 0.5 * (used.min(axis=0) + used.max(axis=0))
        self._scale = 1.0 / max(float(np.ptp(used, axis=0).max()), 1e-300)
        self._vertices = (mesh.vertices - self._centre) * self._scale
        self._faces = mesh.faces
        self._tree = BVHTree.FromPolygons(self._vertices.tolist(), mesh.faces.tolist(), all_triangles=True)

    def nearest(self, origins: FloatArray, directions: FloatArray, limit: FloatArray | float = np.inf) -> Hits:
        """Nearest hit of each ray; see RayCaster."""
        count = len(origins)
        reach = np.minimum(np.broadcast_to(np.asarray(limit, np.float64) * self._scale, (count,)), 1e30)
        distance, face, point = np.full(count, np.inf), np.full(count, -1, np.int64), np.zeros((count, 3))
        start = (np.asarray(origins, np.float64) - self._centre) * self._scale
        cast = self._tree.ray_cast
        for i, (origin, direction, far) in enumerate(
            zip(start.tolist(), np.asarray(directions).tolist(), reach.tolist(), strict=True)
        ):
            place, _, index, along = cast(origin, direction, far)
            if index is not None:
                distance[i], face[i], point[i] = along / self._scale, index, place
        weights = np.zeros((count, 3))
        hit = face >= 0
        weights[hit] = closest_on_triangles(point[hit], self._vertices[self._faces[face[hit]]])
        return Hits(distance, face, weights)
