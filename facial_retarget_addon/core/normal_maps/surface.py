"""The light mesh as a shader sees it: its polygons, their texture coordinates, their smooth normals."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray, cross, unit_vectors
from ..errors import RetargetError
from ..mesh import TriMesh


def shaded_triangles(mesh: TriMesh, counts: IntArray, corners: IntArray) -> TriMesh:
    """A mesh with its quads cut as Blender and its exporters cut them, from the first corner to the third.

    Only a quad that this would fold is cut the other way. Inside a warped quad its texture and normals depend
    on the cut. Polygons with more corners stay cut as they are.

    Parameters
    ----------
    mesh : polygon after polygon. counts, corners : its polygons, as in `TexturedSurface`.
    """
    quads = np.flatnonzero(counts == 4)
    ring = corners[(np.cumsum(counts) - counts)[quads][:, None] + np.arange(4)]
    first, second, third, fourth = (mesh.vertices[ring[:, k]] for k in range(4))
    cut = third - first
    folds = np.einsum("qi,qi->q", np.cross(second - first, cut), np.cross(fourth - first, cut)) > 0
    pieces = np.where(folds[:, None], ring[:, [0, 1, 3, 1, 2, 3]], ring[:, [0, 1, 2, 0, 2, 3]])
    faces = mesh.faces.copy()
    faces[counts[mesh.polygons] == 4] = pieces.reshape(-1, 3)
    return TriMesh(mesh.vertices, faces, mesh.polygons)


@dataclass(frozen=True, eq=False)
class TexturedSurface:
    """A mesh with texture coordinates.

    Attributes
    ----------
    mesh : its triangles, polygon after polygon; vertex i is the artist's vertex i.
    counts : (P,) corners of each polygon. corners : (C,) their vertices, polygon after polygon.
    uvs : (C, 2) texture coordinates of the corners.
    """

    mesh: TriMesh
    counts: IntArray
    corners: IntArray
    uvs: FloatArray

    def __post_init__(self) -> None:
        if np.shape(self.uvs) != (len(self.corners), 2):
            raise RetargetError(
                f"texture coordinates have shape {np.shape(self.uvs)}, expected ({len(self.corners)}, 2): one a corner"
            )
        if not np.isfinite(self.uvs).all():
            raise RetargetError("texture coordinates are NaN or infinite, expected finite ones")

    def part(self, shown: BoolArray) -> TexturedSurface:
        """The same polygons, of which only those with vertices (V,) that are shown have triangles."""
        kept = shown[self.mesh.faces].all(axis=1)
        mesh = TriMesh(self.mesh.vertices, self.mesh.faces[kept], self.mesh.polygons[kept])
        return TexturedSurface(mesh, self.counts, self.corners, self.uvs)

    @property
    def shown_polygons(self) -> BoolArray | None:
        """(P,) the polygons that have triangles; None if all have."""
        shown = np.zeros(len(self.counts), bool)
        shown[self.mesh.polygons] = True
        return None if shown.all() else shown

    @cached_property
    def triangle_corners(self) -> IntArray:
        """(F, 3) rows of `corners` that each triangle of the mesh was cut from."""
        width = len(self.mesh.vertices)
        key = np.repeat(np.arange(len(self.counts)), self.counts) * width + self.corners
        order = np.argsort(key, kind="stable")
        wanted = self.mesh.polygons[:, None] * width + self.mesh.faces
        rows: IntArray = order[np.searchsorted(key, wanted.ravel(), sorter=order)].reshape(-1, 3)
        return rows

    @cached_property
    def triangle_uvs(self) -> FloatArray:
        """(F, 3, 2) texture coordinates of the triangles."""
        uvs: FloatArray = np.asarray(self.uvs, np.float64)[self.triangle_corners]
        return uvs

    @cached_property
    def _beside(self) -> tuple[IntArray, IntArray, IntArray]:
        """(C,) rows of the corner before and after each corner in its polygon, and its polygon."""
        end = np.cumsum(self.counts)
        first = np.repeat(end - self.counts, self.counts)
        row, count = np.arange(len(self.corners)), np.repeat(self.counts, self.counts)
        owner = np.repeat(np.arange(len(self.counts)), self.counts)
        return first + (row - first - 1) % count, first + (row - first + 1) % count, owner

    def normals(self, vertices: FloatArray) -> FloatArray:
        """Smooth unit normals (V, 3) of positions (V, 3), as Blender shades them: polygons weighted by their angles."""
        before, after, owner = self._beside
        places = np.asarray(vertices, np.float64)[self.corners]
        away = unit_vectors(places[after] - places)
        angle = np.arccos(np.clip(-np.einsum("ci,ci->c", away[before], away), -1.0, 1.0))
        start = places[(np.cumsum(self.counts) - self.counts)[owner]]
        pieces = cross(places - start, places[after] - start)
        polygon = np.stack([np.bincount(owner, pieces[:, k], len(self.counts)) for k in range(3)], axis=1)
        weighted = angle[:, None] * unit_vectors(polygon.astype(np.float64))[owner]
        sums = [np.bincount(self.corners, weighted[:, k], len(self.mesh.vertices)) for k in range(3)]
        return unit_vectors(np.stack(sums, axis=1))
