"""Normal maps of a performance as pictures in a folder."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..core.arrays import FloatArray, Progress, no_progress
from ..core.errors import RetargetError
from ..core.normal_maps.encoding import as_picture
from ..core.normal_maps.frame_maps import FrameMaps, Tile
from .images import DEPTHS, write_image

STEM = "normal"


@dataclass(frozen=True)
class MapFiles:
    """How normal maps are written.

    depth : one of `DEPTHS`. directx : green points down.
    """

    depth: str = "png16"
    directx: bool = False

    @property
    def suffix(self) -> str:
        """Of the files."""
        if self.depth not in DEPTHS:
            raise RetargetError(f"pictures of depth {self.depth!r} are not known, expected one of {', '.join(DEPTHS)}")
        return DEPTHS[self.depth][0]

    def name(self, frame: int, tile: Tile | None = None) -> str:
        """Of a frame's file: the UDIM tile stands before the frame where there are several."""
        udim = "" if tile is None else f".{udim_number(tile)}"
        return f"{STEM}{udim}.{frame:04d}{self.suffix}"


def udim_number(tile: Tile) -> int:
    """1001 for the tile (0, 0)."""
    return 1001 + tile[0] + 10 * tile[1]


def write_frame_maps(
    folder: Path, files: MapFiles, maps: FrameMaps, frames: FloatArray, first: int, progress: Progress = no_progress
) -> FloatArray:
    """Write the maps of source frames (F, Vs, 3) into a folder that is there, the first frame's number being `first`.

    Returns
    -------
    (F, V, 3) float32 the light mesh of the frames.
    """
    light = np.empty((len(frames), len(maps.surface.mesh.vertices), 3), np.float32)
    several = len(maps.maps) > 1
    for row, frame in enumerate(frames):
        progress(row / len(frames), f"normal map {row + 1} of {len(frames)}")
        light[row], tiles = maps.frame(frame)
        for tile, vectors in tiles.items():
            path = folder / files.name(first + row, tile if several else None)
            write_image(as_picture(vectors, files.directx), path, files.depth)
    return light
