"""Feature points as a triangulation sees them: positions and surface normals on one face."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray, cross, unit_vectors
from ..mesh import TriMesh
from ..points import FeaturePoints


@dataclass(frozen=True, eq=False)
class PlacedPoints:
    """Points on one face: positions (P, 3), and unit normals of the surface there (P, 3)."""

    positions: FloatArray
    normals: FloatArray

    @classmethod
    def on(cls, mesh: TriMesh, points: FeaturePoints) -> PlacedPoints:
        """Points of a mesh."""
        return cls(points.positions(mesh.vertices), unit_vectors(points.positions(mesh.vertex_normals)))

    def agreement(self, faces: IntArray) -> FloatArray:
        """(F,) dot product of each triangle's normal and the surface normals at its corners; below 0 it folds over."""
        mean = unit_vectors(self.normals[faces].mean(axis=1))
        a, b, c = (self.positions[faces[:, k]] for k in range(3))
        dots: FloatArray = np.einsum("fi,fi->f", unit_vectors(cross(b - a, c - a)), mean)
        return dots
