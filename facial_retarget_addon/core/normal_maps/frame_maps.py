"""Normal maps of a performance: the finest level of a fitted pair on the artist's mesh, or on one of the levels."""

from __future__ import annotations

import numpy as np
from scipy.sparse.csgraph import dijkstra

from ..arrays import FloatArray, IntArray, Progress, no_progress
from ..errors import RetargetError
from ..gained_face import GainedFace
from ..level_retargeter import LevelRetargeter
from ..mesh import TriMesh
from ..methods.settings import MapSettings
from ..problem import Problem
from ..raycast import CasterFactory, EmbreeCaster
from .chart import disc_chart
from .key_poses import Pose
from .normal_map import NormalMap, fit_normal_map
from .surface import TexturedSurface
from .texels import tiles

_FADE = 0.03
"""Over which the map of an artist's mesh fades out towards the finest level's outer border, in that level's sizes."""

Tile = tuple[int, int]
"""Whole u and v of a UDIM tile; (0, 0) is tile 1001."""


class FrameMaps:
    """Normal maps of frames.

    Parameters
    ----------
    retargeter : fitted to the problem.
    surface : the target in its neutral, its vertices the first of the retargeter's; None where the settings name a
        level, which gets a chart of its own.

    Attributes
    ----------
    surface : the light mesh in its neutral.
    mapped : the same, with triangles only where the maps are for them: an artist's eyes, teeth and lashes, which the
        finest level has not, may lie over the skin in the texture.
    maps : UDIM tile -> the map of its texels.

    Raises
    ------
    RetargetError : if there is no such level, or the texture coordinates cover no pixel or lie in no UDIM tile.
    """

    def __init__(
        self,
        retargeter: LevelRetargeter,
        problem: Problem,
        surface: TexturedSurface | None,
        settings: MapSettings,
        progress: Progress = no_progress,
    ) -> None:
        self._retargeter = retargeter
        (self._rest,), faces = retargeter.detail(problem.source.mesh.vertices.astype(np.float32)[None])
        fine = TriMesh(self._rest, faces)
        self._gained = GainedFace(problem.target, problem.gains)
        self._fine_strength = retargeter.at_finest(self._gained.strength)[:, None].astype(np.float32)
        self._own = surface is not None
        self.surface = surface or _level_surface(fine, retargeter.level_faces(settings.level))
        strength = _fade(fine) if self._own else None
        self.mapped = self.surface
        if self._own:
            self.mapped = self.surface.part(retargeter.skin[: len(self.surface.mesh.vertices)])
        self.maps = light_maps(self.mapped, fine, settings, strength, problem.make_caster, progress)

    def frame(self, source: FloatArray) -> tuple[FloatArray, dict[Tile, FloatArray]]:
        """The light mesh (V, 3) of a source frame (Vs, 3), and each tile's unit normals (size, size, 3).

        See `NormalMap.vectors`.
        """
        light, fine = self.pose(source)
        return light, {tile: held.vectors(light, fine) for tile, held in self.maps.items()}

    def pose(self, source: FloatArray) -> Pose:
        """Both meshes of a source frame (Vs, 3)."""
        (fine,), _ = self._retargeter.detail(source[None])
        fine = self._rest + self._fine_strength * (fine - self._rest)
        light = self._gained.scale(self._retargeter.frames(source[None]))[0] if self._own else fine
        return Pose(light[: len(self.surface.mesh.vertices)], fine)


def light_maps(
    surface: TexturedSurface,
    fine: TriMesh,
    settings: MapSettings,
    strength: FloatArray | None = None,
    make_caster: CasterFactory = EmbreeCaster,
    progress: Progress = no_progress,
) -> dict[Tile, NormalMap]:
    """The map of each UDIM tile that a light mesh reaches; parameters and errors as `fit_normal_map`."""
    found = _udim_tiles(surface)
    maps: dict[Tile, NormalMap] = {}
    for number, tile in enumerate(found):
        progress(number / len(found), "placing the pixels")
        maps[tile] = fit_normal_map(surface, fine, settings.pixels, tile, settings.margin, strength, make_caster)
    return maps


def _udim_tiles(surface: TexturedSurface) -> list[Tile]:
    """The tiles of a surface, at least one."""
    found = tiles(surface.triangle_uvs)
    if not found:
        low, high = surface.uvs.min(axis=0), surface.uvs.max(axis=0)
        raise RetargetError(
            f"texture coordinates from ({low[0]:.3g}, {low[1]:.3g}) to ({high[0]:.3g}, {high[1]:.3g}) lie in no UDIM "
            "tile, expected some from (0, 0) on"
        )
    return found


def _level_surface(fine: TriMesh, faces: IntArray) -> TexturedSurface:
    """A level with a chart of its own."""
    mesh = TriMesh(fine.vertices[: faces.max() + 1], faces)
    corners = faces.ravel()
    return TexturedSurface(mesh, np.full(len(faces), 3), corners, disc_chart(mesh)[corners])


def _fade(fine: TriMesh) -> FloatArray:
    """(N,) strength of the map at the finest level's vertices: 0 at its outer border, 1 farther inside."""
    if not fine.boundary_loops:
        return np.ones(len(fine.vertices))
    reach = _FADE * fine.size
    distance = dijkstra(fine.graph, indices=fine.boundary_loops[0], min_only=True, limit=reach)
    share = np.minimum(distance / reach, 1.0)
    strength: FloatArray = share * share * (3 - 2 * share)
    return strength
