"""The base mesh as lines that lie on a face's surface, and move with it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray, unit_vectors
from ..closest_point import SurfaceFinder, closest_agreeing
from ..mesh import TriMesh
from ..points import FeaturePoints
from .placed_points import PlacedPoints

PIECES = 8
"""Straight pieces that stand for an edge."""
AGREEMENT = 0.2
"""Least dot product of a place's normal and those at the ends of its edge: a lip's line stays off the other lip."""


@dataclass(frozen=True, eq=False)
class SurfaceLines:
    """Edges of a base mesh on a face.

    Attributes
    ----------
    vertices : (N, 3) of the face, that hold each place of the lines.
    weights : (N, 3) of these vertices.
    pieces : (L, 2) straight pieces, as rows of the places.
    folded : (T, 3) base triangles that fold over, as rows of the places.
    folded_names : of the points of these triangles.
    """

    vertices: IntArray
    weights: FloatArray
    pieces: IntArray
    folded: IntArray
    folded_names: frozenset[str]

    def places(self, positions: FloatArray) -> FloatArray:
        """(N, 3) places of the lines on positions (V, 3) of the face."""
        places: FloatArray = np.einsum("nk,nkc->nc", self.weights, positions[self.vertices])
        return places


def surface_lines(mesh: TriMesh, points: FeaturePoints, faces: IntArray) -> SurfaceLines:
    """The edges of a base mesh on one face's neutral.

    Parameters
    ----------
    points : of the base mesh, in the order of its rows.
    faces : (F, 3) its triangles.
    """
    placed = PlacedPoints.on(mesh, points)
    ends = TriMesh(placed.positions, faces).edges
    shares: FloatArray = np.linspace(0.0, 1.0, PIECES + 1)[1:-1, None]

    def between(values: FloatArray) -> FloatArray:
        """(E, PIECES - 1, 3) values (P, 3) along each edge, without its ends."""
        start, gap = values[ends[:, :1]], values[ends[:, 1:]] - values[ends[:, :1]]
        along: FloatArray = start + shares * gap
        return along

    normals = unit_vectors(between(placed.normals)).reshape(-1, 3)
    near = closest_agreeing(SurfaceFinder(mesh), between(placed.positions).reshape(-1, 3), normals, AGREEMENT)
    inner = len(points) + np.arange(len(near.face)).reshape(len(ends), PIECES - 1)
    rows = np.concatenate([ends[:, :1], inner, ends[:, 1:]], axis=1)
    folded: IntArray = faces[placed.agreement(faces) < 0]
    return SurfaceLines(
        np.concatenate([points.vertices, mesh.faces[near.face]]),
        np.concatenate([points.weights, near.weights]),
        np.stack([rows[:, :-1], rows[:, 1:]], axis=2).reshape(-1, 2),
        folded,
        frozenset(points.names[row] for row in np.unique(folded)),
    )
