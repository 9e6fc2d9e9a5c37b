"""Normal meshes of source frames."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .arrays import FloatArray
from .base.base_mesh import BaseLoop
from .levels.normal_mesh import NormalMesh, build_normal_mesh
from .levels.subdivision import Level
from .mesh import TriMesh
from .points import FeaturePoints, place_matrix
from .raycast import CasterFactory


class SourceReader:
    """Levels of source frames, by material points found once or by piercing every frame anew.

    Parameters
    ----------
    mesh, points : neutral source and its base points.
    loops, steps : the base's boundary loops and subdivision steps.
    neutral : the source's normal mesh.
    pierce : pierce every frame (Na and Jung 2004, 3.1) instead of following the neutral's places.
    make_caster : makes what casts rays on a mesh.
    """

    def __init__(
        self,
        mesh: TriMesh,
        points: FeaturePoints,
        loops: Sequence[BaseLoop],
        steps: Sequence[Level],
        neutral: NormalMesh,
        pierce: bool,
        make_caster: CasterFactory,
    ) -> None:
        self._mesh, self._points, self._loops, self._steps, self._pierce = mesh, points, loops, steps, pierce
        self._make_caster = make_caster
        self._places = [
            place_matrix(mesh.faces[level.place_face], level.place_weights, len(mesh.vertices))
            for level in neutral.levels
        ]

    @property
    def rest(self) -> FloatArray:
        """(Vs, 3) float32, the neutral as a frame."""
        return self._mesh.vertices.astype(np.float32)

    def levels(self, frame: FloatArray) -> list[FloatArray]:
        """Positions of the base and of each level, [(B, 3), (N_1, 3), ...], for one frame (Vs, 3)."""
        positions = frame.astype(np.float64)
        if not self._pierce:
            return [self._points.positions(positions), *(place @ positions for place in self._places)]
        moved = self._mesh.with_vertices(positions)
        pierced = build_normal_mesh(moved, self._points, self._loops, self._steps, self._make_caster)
        return [pierced.base, *(level.positions for level in pierced.levels)]
