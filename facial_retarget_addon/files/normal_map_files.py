"""Normal maps of a performance as pictures in a folder."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..core.arrays import FloatArray, Progress, no_progress
from ..core.errors import RetargetError
from ..core.methods.settings import MapSettings
from ..core.normal_maps.encoding import as_picture
from ..core.normal_maps.frame_maps import FrameMaps, Tile
from ..core.normal_maps.surface import TexturedSurface, shaded_triangles
from .images import image_bytes, suffix_of, write_image
from .mesh_file import MeshFile
from .whole import write_whole

STEM = "normal"


def map_name(depth: str, frame: int, tile: Tile | None = None) -> str:
    """Name of a frame's file: the UDIM tile stands before the frame where there are several.

    Raises
    ------
    RetargetError : for a depth that is none of `DEPTHS`.
    """
    udim = "" if tile is None else f".{udim_number(tile)}"
    return f"{STEM}{udim}.{frame:04d}{suffix_of(depth)}"


def first_number(start: int) -> int:
    """Number of the first picture of frames from `start` on: Blender plays no pictures with numbers below 0."""
    return max(start, 0)


def textured(face: MeshFile, what: str) -> TexturedSurface:
    """A mesh with its texture coordinates.

    Raises
    ------
    RetargetError : if it has none; the message starts with `what`.
    """
    if face.uvs is None:
        raise RetargetError(
            f"{what} has no texture coordinates, expected some for its normal maps; unwrap it, or make the maps for a "
            "level of its normal mesh"
        )
    mesh = shaded_triangles(face.mesh, face.counts, face.corners)
    return TexturedSurface(mesh, face.counts, face.corners, face.uvs)


def udim_number(tile: Tile) -> int:
    """1001 for the tile (0, 0)."""
    return 1001 + tile[0] + 10 * tile[1]


def write_frame_maps(
    folder: Path,
    settings: MapSettings,
    maps: FrameMaps,
    frames: FloatArray,
    first: int,
    progress: Progress = no_progress,
) -> FloatArray:
    """Write the maps of source frames (F, Vs, 3) into a folder that is there, the first frame's number being `first`.

    Returns
    -------
    (F, V, 3) float32 the light mesh of the frames.
    """
    light = np.empty((len(frames), len(maps.surface.mesh.vertices), 3), np.float32)
    for row, frame in enumerate(frames):
        progress(row / len(frames), f"normal map {row + 1} of {len(frames)}")
        light[row], tiles = maps.frame(frame)
        for path, tile in _map_paths(folder, settings, maps, first + row).items():
            write_image(_picture(tiles[tile], settings), path, settings.depth)
    return light


def write_missing_maps(
    folder: Path, settings: MapSettings, maps: FrameMaps, frames: FloatArray, progress: Progress = no_progress
) -> None:
    """Write those maps of source frames (F, Vs, 3), numbered from 1, that a folder lacks, each whole or not at all.

    Raises
    ------
    RetargetError : if the system refuses.
    """
    for row, frame in enumerate(frames):
        progress(row / len(frames), f"normal map {row + 1} of {len(frames)}")
        paths = _map_paths(folder, settings, maps, 1 + row)
        if not all(path.exists() for path in paths):
            _, tiles = maps.frame(frame)
            for path, tile in paths.items():
                write_whole(path, image_bytes(_picture(tiles[tile], settings), settings.depth))


def _map_paths(folder: Path, settings: MapSettings, maps: FrameMaps, number: int) -> dict[Path, Tile]:
    """Each picture of a frame and its tile."""
    several = len(maps.maps) > 1
    return {folder / map_name(settings.depth, number, tile if several else None): tile for tile in maps.maps}


def _picture(vectors: FloatArray, settings: MapSettings) -> FloatArray:
    return as_picture(vectors, settings.convention == "directx")
