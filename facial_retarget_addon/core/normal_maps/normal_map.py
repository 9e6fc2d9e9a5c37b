"""Tangent-space normal maps: a table of texels once per pair, then pixels for every frame."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, IntArray, cross, unit_vectors
from ..errors import RetargetError
from ..mesh import TriMesh
from ..points import place_matrix
from ..raycast import CasterFactory, EmbreeCaster
from .surface import TexturedSurface
from .tangents import TangentSpace
from .texel_places import place_texels
from .texels import margin, rasterise, ring

_BLOCK = 1 << 14
"""Texels that go through together: what one block needs stays in the cache."""
_THREADS = min(4, os.cpu_count() or 1)


class _Block(NamedTuple):
    """Some texels: the pixels, the matrices to their normals on the fine mesh and to their frames, and their signs.

    strength : (T,) of the map, 0 for a flat one; None for 1 everywhere.
    """

    pixel: IntArray
    fine: sp.csr_matrix
    frame: sp.csr_matrix
    sign: FloatArray
    strength: FloatArray | None


@dataclass(frozen=True, eq=False)
class NormalMap:
    """The texels of a light mesh, each with its place on a fine mesh.

    Attributes
    ----------
    size : pixels along each side.
    pixel : (T,) covered pixels, and with a margin those along their borders, row after row from the bottom left.
    around, nearest : (M,) the other pixels of the margin, and the pixel that each one copies.
    missed : texels without a place on the fine mesh: they are flat.
    """

    size: int
    pixel: IntArray
    around: IntArray
    nearest: IntArray
    missed: int
    _surface: TexturedSurface
    _space: TangentSpace
    _fine_faces: IntArray
    _incidence: sp.csr_matrix
    _blocks: tuple[_Block, ...]

    def vectors(self, light: FloatArray, fine: FloatArray) -> FloatArray:
        """Unit normals of a frame in tangent space.

        Parameters
        ----------
        light : (V, 3) positions of the light mesh. fine : (N, 3) positions of the fine mesh, in the same space.

        Returns
        -------
        (size, size, 3) float32, row 0 at the bottom: x along u, y along v (OpenGL's way), z out of the surface; 0, 0, 1
        where nothing is.
        """
        normals = self._surface.normals(light)
        tangents = self._space.tangents(np.asarray(light, np.float64), normals)
        frames = np.column_stack([normals[self._space.vertex], tangents]).astype(np.float32)
        there = self._fine_normals(fine)
        image = np.zeros((self.size * self.size, 3), np.float32)
        image[:, 2] = 1.0

        def fill(block: _Block) -> None:
            vectors = _in_tangent_space(block.fine @ there, block.frame @ frames, block.sign)
            image[block.pixel] = (vectors if block.strength is None else _weakened(vectors, block.strength)).T

        with ThreadPoolExecutor(_THREADS) as pool:
            list(pool.map(fill, self._blocks))
        image[self.around] = image[self.nearest]
        return image.reshape(self.size, self.size, 3)

    def at_pixels(self, values: FloatArray) -> FloatArray:
        """Values (V,) of the light mesh's vertices at the pixels: (size, size) float32, 0 where nothing is.

        None is beyond the vertices' own: pixels past the borders go on with the surface.
        """
        image = np.zeros(self.size * self.size, np.float32)
        there = np.asarray(values, np.float32)[self._space.vertex]
        for block in self._blocks:
            image[block.pixel] = np.clip(block.frame @ there, there.min(), there.max())
        image[self.around] = image[self.nearest]
        return image.reshape(self.size, self.size)

    def around_vertices(self, picture: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Sums of a picture (size, size) around each vertex: (V,) of its pixels times their weights, (V,) of these."""
        count, flat = len(self._surface.mesh.vertices), np.asarray(picture, np.float64).ravel()
        sums, weights = np.zeros(count), np.zeros(count)
        for block in self._blocks:
            near, ones = block.frame.maximum(0).T, np.ones(len(block.pixel))
            sums += np.bincount(self._space.vertex, near @ flat[block.pixel], count)
            weights += np.bincount(self._space.vertex, near @ ones, count)
        return sums, weights

    def _fine_normals(self, fine: FloatArray) -> FloatArray:
        """(N, 3) float32 unit normals of the fine mesh, area-weighted: its triangles are of like shape."""
        places = np.asarray(fine, np.float32)
        a, b, c = (np.take(places, self._fine_faces[:, k], axis=0) for k in range(3))
        return unit_vectors(self._incidence @ cross(b - a, c - a))


def _in_tangent_space(there: FloatArray, frames: FloatArray, sign: FloatArray) -> FloatArray:
    """Unit coordinates (3, T) of normals (T, 3) in frames (T, 6), each a normal N and a tangent T of the light mesh.

    A normal is x T + y B + z N with B = sign N x T. Neither T nor N is of unit length, nor are they square to one
    another, between the corners: the coordinates come from the inverse of the frame, up to its positive determinant.
    """
    a, b, c = np.ascontiguousarray(there.T)
    k, m, n, s, t, u = np.ascontiguousarray(frames.T)
    to_normal, to_tangent, leaning = a * k + b * m + c * n, a * s + b * t + c * u, k * s + m * t + n * u
    out = np.empty((3, len(there)), np.float32)
    out[0] = to_tangent * (k * k + m * m + n * n) - to_normal * leaning
    out[1] = sign * (a * (m * u - n * t) + b * (n * s - k * u) + c * (k * t - m * s))
    out[2] = to_normal * (s * s + t * t + u * u) - to_tangent * leaning
    length = np.sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2])
    out[2, length == 0] = 1.0
    out /= np.where(length == 0, np.float32(1.0), length)
    return out


def _weakened(vectors: FloatArray, strength: FloatArray) -> FloatArray:
    """Unit vectors (3, T) drawn towards (0, 0, 1) where the strength (T,) is below 1."""
    drawn = vectors * strength
    drawn[2] += 1 - strength
    drawn /= np.sqrt(drawn[0] * drawn[0] + drawn[1] * drawn[1] + drawn[2] * drawn[2])
    return drawn


def fit_normal_map(
    surface: TexturedSurface,
    fine: TriMesh,
    size: int,
    tile: tuple[int, int] = (0, 0),
    margin_width: int = 8,
    strength: FloatArray | None = None,
    make_caster: CasterFactory = EmbreeCaster,
) -> NormalMap:
    """Find the place on the fine mesh of every texel of a light mesh; both in the neutral.

    A texel's place is where the light mesh's normal, followed either way, first meets the fine mesh where it faces the
    same way; where it meets nothing, the closest such place.

    Parameters
    ----------
    surface : the light mesh. fine : the fine mesh, in the same space.
    size : pixels along each side. tile : whole u and v of the UDIM tile.
    margin_width : pixels around the covered ones that are filled, so that no seam shows. Those that a shader mixes in
        at the borders go on with the surface, the others copy the nearest; 0 leaves all of them flat.
    strength : (N,) of the map at the fine mesh's vertices, 0 for a flat one; None for 1 everywhere.

    Raises
    ------
    RetargetError : if the light mesh covers no pixel of the tile.

    References
    ----------
    Na and Jung 2004, section 4.3.
    """
    texels = rasterise(surface.triangle_uvs, size, tile)
    if not len(texels.pixel):
        low, high = surface.uvs.min(axis=0), surface.uvs.max(axis=0)
        raise RetargetError(
            f"texture coordinates from ({low[0]:.3g}, {low[1]:.3g}) to ({high[0]:.3g}, {high[1]:.3g}) cover no pixel "
            f"of UDIM tile {1001 + tile[0] + 10 * tile[1]} at {size} pixels, expected them inside it"
        )
    around = ring(surface.triangle_uvs, size, tile, texels.pixel) if margin_width > 0 else None
    texels, _, face, weights = place_texels(surface, fine, texels, around, make_caster(fine))
    lost = face < 0
    weights[lost] = 0.0
    space = TangentSpace(surface.mesh.faces, surface.triangle_uvs)
    on_fine = place_matrix(fine.faces[face], weights, len(fine.vertices)).astype(np.float32)
    in_frame = place_matrix(space.group[texels.face], texels.weights, space.count).astype(np.float32)
    sign = space.sign[texels.face]
    strong = None if strength is None else (on_fine @ strength).astype(np.float32)
    rows = [slice(first, first + _BLOCK) for first in range(0, len(texels.pixel), _BLOCK)]
    copies, nearest = margin(texels.pixel, size, margin_width)
    incidence = sp.csr_matrix(
        (np.ones(fine.faces.size, np.float32), (fine.faces.ravel(), np.repeat(np.arange(len(fine.faces)), 3))),
        shape=(len(fine.vertices), len(fine.faces)),
    )
    return NormalMap(
        size,
        texels.pixel,
        copies,
        texels.pixel[nearest],
        int(lost.sum()),
        surface,
        space,
        fine.faces,
        incidence,
        tuple(
            _Block(
                texels.pixel[some], on_fine[some], in_frame[some], sign[some], None if strong is None else strong[some]
            )
            for some in rows
        ),
    )
