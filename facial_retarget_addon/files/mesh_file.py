"""What a mesh file holds: the triangles to work on, and the artist's polygons and UVs to write back."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..core.arrays import FloatArray, IntArray
from ..core.errors import RetargetError
from ..core.mesh import TriMesh

FARTHEST = 1e18
"""No position of a mesh is farther from the origin: its square still fits into float32."""


MOST_CORNERS = 2048
"""Corners of one polygon: cutting it into triangles takes time that grows with the cube of them."""


@dataclass(frozen=True, eq=False)
class MeshFile:
    """A mesh as it stands in a file.

    Attributes
    ----------
    mesh : triangles on the file's own vertices.
    counts : (P,) corners of each polygon.
    corners : (C,) vertices of the polygons, one after the other.
    uvs : (C, 2) texture coordinates of the corners, or None.
    """

    mesh: TriMesh
    counts: IntArray
    corners: IntArray
    uvs: FloatArray | None = None

    @classmethod
    def from_polygons(
        cls, path: Path, vertices: FloatArray, counts: IntArray, corners: IntArray, uvs: FloatArray | None = None
    ) -> MeshFile:
        """The polygons of a file, triangulated and checked.

        Raises
        ------
        RetargetError : if the mesh is empty, has vertices that are not finite, polygons with fewer than three
            corners, or corners that are no vertex; the message starts with the path.
        """
        bad = np.flatnonzero(~(np.abs(vertices) < FARTHEST).all(axis=1))
        if len(bad):
            raise RetargetError(
                f"{path} has {len(bad)} vertices that are NaN, infinite or farther than {FARTHEST:g}, the first is "
                f"vertex {bad[0]}; expected finite positions"
            )
        largest = int(counts.max(initial=0))
        if largest > MOST_CORNERS:
            raise RetargetError(f"{path} has a polygon with {largest} corners, expected at most {MOST_CORNERS}")
        try:
            mesh = TriMesh.from_polygons(vertices, counts, corners)
        except RetargetError as error:
            raise RetargetError(f"{path}: {error}") from error
        return cls(mesh.checked(str(path)), counts, corners, uvs)

    @classmethod
    def from_mesh(cls, mesh: TriMesh) -> MeshFile:
        """The triangles of a mesh, as polygons without UVs."""
        counts = np.full(len(mesh.faces), 3, np.int64)
        return cls(TriMesh(mesh.vertices, mesh.faces), counts, mesh.faces.ravel())
