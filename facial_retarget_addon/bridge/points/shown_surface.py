"""The surface of a face as it is shown, and what of the neutral lies under the mouse.

A ray meets the artist's own polygons where modifiers and shape keys have put their vertices, so that what it meets is
a place of the neutral too: the same vertices with the same weights. Modifiers that add vertices, such as subdivision,
smooth the surface that is drawn; a place then lies on the polygons below it, at the same pixel.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from bpy.types import Depsgraph, Object, Region, RegionView3D

from ...core.arrays import FloatArray, IntArray
from ...core.closest_point import SurfaceFinder
from ...core.errors import RetargetError
from ...core.mesh import TriMesh
from ...core.raycast import RayCaster
from ...core.sliding import Place
from ...core.view_rays import View
from ..meshes import neutral_mesh
from ..raycast import available_caster
from .point_places import shown_vertices
from .topology import topology_of

COVER, NEAR = 0.01, 0.05
"""Lashes and shells that a point of the skin is placed through: their area at most, of the skin's, and how far they lie
before it at most, of the mesh's size. An eyeball has more area: whoever clicks there shall not hit its socket.
"""


KEPT = 4
"""Meshes whose pieces are kept: each press of the mouse would wait for them."""

_components: dict[str, IntArray] = {}
"""Topology of a mesh -> (V,) the component of each vertex; the one made last stands last."""


class ShownSurface:
    """The polygons of an object as they look now, in world space; it stays as it is when the object changes."""

    def __init__(self, thing: Object, depsgraph: Depsgraph) -> None:
        """Read the object.

        Raises
        ------
        RetargetError : if it is no surface, or a modifier has renumbered its vertices.
        """
        vertices = shown_vertices(thing, depsgraph)
        if vertices is None:
            raise RetargetError(
                f"object {thing.name!r} has a modifier that makes its vertices anew, so that no place on it is one of "
                "its mesh; turn the modifier off in the viewport while you place points"
            )
        self.mesh: TriMesh = neutral_mesh(thing).with_vertices(vertices)
        self._topology = topology_of(thing.data)

    @cached_property
    def _caster(self) -> RayCaster:
        return available_caster()(self.mesh)

    @cached_property
    def _pieces(self) -> IntArray:
        """(F,) the component that each triangle belongs to."""
        if self._topology not in _components:
            _components[self._topology] = self.mesh.components
            while len(_components) > KEPT:
                del _components[next(iter(_components))]
        return _components[self._topology][self.mesh.faces[:, 0]]

    @cached_property
    def _areas(self) -> FloatArray:
        """Of each component; that of the skin is the largest."""
        return np.bincount(self._pieces, self.mesh.face_areas)

    @cached_property
    def _skin(self) -> IntArray:
        """(S,) the triangles of the skin."""
        return np.flatnonzero(self._pieces == self._areas.argmax())

    @cached_property
    def _skin_caster(self) -> RayCaster:
        return available_caster()(TriMesh(self.mesh.vertices, self.mesh.faces[self._skin]))

    def under(self, view: View, pixel: FloatArray, on_skin: bool = False) -> Place | None:
        """The place that is seen at a pixel (2,) of a view, other objects left aside; None beside the surface.

        on_skin : go through what covers the skin, such as lashes and the shells of eyes.
        """
        origin, direction = (one[None] for one in view.ray(pixel))
        hit = self._caster.nearest(origin, direction)
        if not hit.found[0]:
            return None
        face = int(hit.face[0])
        if on_skin and self._areas[self._pieces[face]] < COVER * self._areas.max():
            behind = self._skin_caster.nearest(origin, direction, hit.distance + NEAR * self.mesh.size)
            if behind.found[0]:
                return self._place(int(self._skin[behind.face[0]]), behind.weights[0])
        return self._place(face, hit.weights[0])

    def closest(self, position: FloatArray) -> Place:
        """The place closest to a position (3,) in world space."""
        found = SurfaceFinder(self.mesh).closest(position[None])
        return self._place(int(found.face[0]), found.weights[0])

    def place(self, vertices: Sequence[int], weights: Sequence[float]) -> Place:
        """A place by the vertices (3,) that hold it and their weights (3,)."""
        corners, shares = np.array(vertices), np.array(weights)
        return Place(corners, shares, shares @ self.mesh.vertices[corners])

    def _place(self, face: int, weights: FloatArray) -> Place:
        return self.place(self.mesh.faces[face].tolist(), weights.tolist())


def view_of(region: Region, shown: RegionView3D) -> View:
    """A region of a 3D view: one of its four in quad view."""
    size = np.array([region.width, region.height], np.float64)
    return View(size, np.array(shown.view_matrix, np.float64), np.array(shown.window_matrix, np.float64))
