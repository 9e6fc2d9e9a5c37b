"""A wrinkle kit: what each shape key does to the normals, and where, in as few pictures as hold it.

Detail that lies on a surface is a height over it, and heights add up; so do the slopes of normals in tangent space,
x / z and y / z. A kit is the neutral's normal map and, for each key, the difference of slopes between the key at full
strength and the neutral, with a mask. At any values of the keys the slopes are

    s = s_neutral + sum over keys of value * mask * difference,

and the normal is (s, 1) made unit. For one key at 1, where its mask is 1, that is the key's own normal map.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..arrays import BoolArray, FloatArray, Progress, no_progress
from ..errors import RetargetError
from ..mesh import TriMesh
from .frame_maps import FrameMaps, Tile
from .key_poses import KeyPoses, KeysPosed, Pose
from .normal_map import NormalMap
from .strain import ramp, smoothed, strain

LAYERS, MASKS = 2, 4
"""How many differences, of two channels each, and how many masks one picture of four channels holds."""
LOWEST = 0.1
"""Normals count as no flatter to the surface than this z: slopes have an end."""

_STRAINED = (0.0005, 0.005)
"""Strain at which a mask begins, and at which it is whole."""
_TURNED = (0.75, 2.0)
"""The same for how far the normals around a vertex turn, in degrees: a mask ends where nothing is to be seen."""
_FAINT = 1 / 255
"""Masks below this are 0."""
_LIVELY = 0.995
"""A key turns normals by what this share of the pixels stays below."""


class KitKey(NamedTuple):
    """A key that wrinkles.

    turn : degrees that its liveliest half percent of the pixels turn at least.
    kept : share of its squared slopes that the mask lets through.
    layer : number of the layer that holds its difference.
    mask : (V,) from 0 to 1 at the light mesh's vertices.
    """

    name: str
    turn: float
    kept: float
    layer: int
    mask: FloatArray


class WrinkleKit:
    """The pictures of a kit, made when they are asked for.

    Parameters
    ----------
    mesh : the light mesh in its neutral.
    maps : UDIM tile -> the map of its texels.
    neutral : both meshes in the neutral.
    keys : name -> what gives its poses; called twice.
    least : keys that turn no normal by so many degrees are dropped.

    Attributes
    ----------
    keys : those that wrinkle, in the order in which they arrived.
    dropped : name -> degrees of the others.
    layers : how many there are. Keys whose masks have no triangle in common share one.

    Raises
    ------
    RetargetError : if no key wrinkles.
    """

    def __init__(
        self,
        mesh: TriMesh,
        maps: Mapping[Tile, NormalMap],
        neutral: Pose,
        keys: Mapping[str, Callable[[], KeyPoses]],
        least: float,
        progress: Progress = no_progress,
    ) -> None:
        self._mesh, self._maps, self._neutral, self._poses = mesh, maps, neutral, keys
        found: list[KitKey] = []
        self.dropped: dict[str, float] = {}
        for number, name in enumerate(keys):
            progress(number / len(keys), f"looking for the wrinkles of {name}")
            key = self._look(name)
            if key.turn < least:
                self.dropped[name] = key.turn
            else:
                found.append(key)
        if not found:
            most = max(self.dropped.values(), default=0.0)
            raise RetargetError(
                f"none of the {len(keys)} shape keys turns normals by {least:g} degrees, the most is {most:.2g}; "
                "expected keys with wrinkles that the light mesh lacks"
            )
        layer = _shared_layers(mesh, [key.mask for key in found])
        self.keys = tuple(key._replace(layer=number) for key, number in zip(found, layer, strict=True))
        self.layers = max(layer) + 1

    @property
    def difference_pictures(self) -> int:
        """Pictures that hold the differences."""
        return -(-self.layers // LAYERS)

    @property
    def mask_pictures(self) -> int:
        """Pictures that hold the masks."""
        return -(-len(self.keys) // MASKS)

    @property
    def pictures(self) -> int:
        """All pictures of a tile, the neutral's among them."""
        return 1 + self.difference_pictures + self.mask_pictures

    @property
    def tiles(self) -> tuple[Tile, ...]:
        """The UDIM tiles that have pictures."""
        return tuple(self._maps)

    def neutral(self, tile: Tile) -> FloatArray:
        """Unit normals (size, size, 3) of the neutral, row 0 at the bottom; see `NormalMap.vectors`."""
        return self._maps[tile].vectors(*self._neutral)

    def differences(self, picture: int, tile: Tile) -> FloatArray:
        """(size, size, 4) float32 x and y of two layers, row 0 at the bottom: of unit vectors whose slopes they are."""
        held = self._maps[tile]
        made = np.zeros((held.size, held.size, 2 * LAYERS), np.float32)
        for key in self.keys:
            place = key.layer - LAYERS * picture
            if place in range(LAYERS):
                inside = held.at_pixels(key.mask) > 0
                slope = self._difference(held, self._poses[key.name]())[inside]
                length = np.sqrt(1 + np.einsum("pi,pi->p", slope, slope))
                made[inside, 2 * place : 2 * place + 2] = slope / length[:, None]
        return made

    def masks(self, picture: int, tile: Tile) -> FloatArray:
        """(size, size, 4) float32 masks of four keys from 0 to 1, row 0 at the bottom."""
        held = self._maps[tile]
        made = np.zeros((held.size, held.size, MASKS), np.float32)
        for place, key in enumerate(self.keys[MASKS * picture : MASKS * (picture + 1)]):
            made[..., place] = held.at_pixels(key.mask)
        return made

    def blended(self, values: Mapping[str, float], tile: Tile) -> FloatArray:
        """Unit normals (size, size, 3) that a shader makes of the pictures at some values of the keys."""
        slope = slopes(self.neutral(tile))
        for picture in range(self.difference_pictures):
            held = self.differences(picture, tile)
            for place in range(LAYERS):
                weight = self._weight(LAYERS * picture + place, values, tile)
                slope += weight[..., None] * unpacked(held[..., 2 * place : 2 * place + 2])
        return normals_of(slope)

    def report(self) -> dict[str, Any]:
        """Figures, as plain data."""
        return {
            "keys": [{"name": key.name, "turn": key.turn, "kept": key.kept} for key in self.keys],
            "dropped": self.dropped,
            "pictures": self.pictures,
        }

    def _weight(self, layer: int, values: Mapping[str, float], tile: Tile) -> FloatArray:
        """(size, size) of a layer: the sum of value times mask over its keys."""
        held = self._maps[tile]
        weight = np.zeros((held.size, held.size), np.float32)
        for key in self.keys:
            if key.layer == layer:
                weight += np.float32(values.get(key.name, 0.0)) * held.at_pixels(key.mask)
        return weight

    def _difference(self, held: NormalMap, poses: KeyPoses) -> FloatArray:
        """(size, size, 2) slopes that a key adds."""
        return slopes(held.vectors(*poses.pose)) - slopes(held.vectors(*poses.start))

    def _look(self, name: str) -> KitKey:
        """A key's mask, and how much it does."""
        poses = self._poses[name]()
        squared = {tile: _squared(self._difference(held, poses)) for tile, held in self._maps.items()}
        sums, weights = np.zeros(len(self._mesh.vertices)), np.zeros(len(self._mesh.vertices))
        for tile, held in self._maps.items():
            turned, near = held.around_vertices(np.degrees(np.arctan(np.sqrt(squared[tile]))) ** 2)
            sums, weights = sums + turned, weights + near
        mean = np.sqrt(np.divide(sums, weights, out=np.zeros(len(sums)), where=weights > 0))
        start = self._mesh
        if poses.start is not self._neutral:
            start = start.with_vertices(poses.start.light.astype(np.float64))
        strained = strain(start, poses.pose.light.astype(np.float64) - poses.start.light)
        mask = ramp(strained, *_STRAINED) * ramp(smoothed(start, mean), *_TURNED)
        mask[mask < _FAINT] = 0.0
        whole = np.concatenate([squared[tile].ravel()[held.pixel] for tile, held in self._maps.items()])
        shown = np.concatenate([held.at_pixels(mask).ravel()[held.pixel] for held in self._maps.values()])
        turn = float(np.degrees(np.arctan(np.quantile(shown * np.sqrt(whole), _LIVELY))))
        total = float(whole.sum())
        kept = 1 - float(((1 - shown) ** 2 * whole).sum()) / total if total else 0.0
        return KitKey(name, turn, kept, 0, mask)


def fit_wrinkle_kit(maps: FrameMaps, posed: KeysPosed, least: float, progress: Progress = no_progress) -> WrinkleKit:
    """The kit of retargeted shapes, for the light mesh of some maps; errors as `WrinkleKit`."""
    return WrinkleKit(maps.surface.mesh, maps.maps, posed.neutral, posed.keys, least, progress)


def slopes(vectors: FloatArray) -> FloatArray:
    """Slopes (..., 2) of unit normals (..., 3): x / z and y / z."""
    steep: FloatArray = vectors[..., :2] / np.maximum(vectors[..., 2:], np.float32(LOWEST))
    return steep


def unpacked(xy: FloatArray) -> FloatArray:
    """Slopes (..., 2) of unit vectors of which x and y (..., 2) are known."""
    z = np.sqrt(np.maximum(1 - _squared(xy), np.float32(LOWEST**2)))
    steep: FloatArray = xy / z[..., None]
    return steep


def normals_of(slope: FloatArray) -> FloatArray:
    """Unit normals (..., 3) of slopes (..., 2)."""
    length = np.sqrt(1 + _squared(slope))
    return np.concatenate([slope, np.ones_like(slope[..., :1])], axis=-1) / length[..., None]


def _squared(pairs: FloatArray) -> FloatArray:
    square: FloatArray = np.einsum("...i,...i->...", pairs, pairs)
    return square


def _shared_layers(mesh: TriMesh, masks: Sequence[FloatArray]) -> list[int]:
    """A layer for each mask, so that no two masks of a layer reach the same triangle; the largest ones choose first."""
    reach = [(mask[mesh.faces] > 0).any(axis=1) for mask in masks]
    taken: list[BoolArray] = []
    layer = [0] * len(masks)
    for row in sorted(range(len(masks)), key=lambda row: -int(reach[row].sum())):
        free = (number for number, held in enumerate(taken) if not (held & reach[row]).any())
        layer[row] = next(free, len(taken))
        if layer[row] == len(taken):
            taken.append(np.zeros(len(mesh.faces), bool))
        taken[layer[row]] |= reach[row]
    return layer
