"""A wrinkle kit of ARKit's 52 keys on level 2: what it leaves of the wrinkles' turn, and how many pictures it takes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from time import perf_counter
from typing import cast

import numpy as np

from facial_retarget_addon import demo
from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.core.level_retargeter import LevelRetargeter
from facial_retarget_addon.core.methods.base import fit
from facial_retarget_addon.core.methods.settings import HierarchicalSettings, WrinkleSettings
from facial_retarget_addon.core.normal_maps.frame_maps import FrameMaps
from facial_retarget_addon.core.normal_maps.key_poses import retargeted_poses
from facial_retarget_addon.core.normal_maps.wrinkle_kit import WrinkleKit, fit_wrinkle_kit
from facial_retarget_addon.core.problem import Problem
from facial_retarget_addon.core.shapes.combinations import find_correctives
from facial_retarget_addon.core.shapes.shape_set import ShapeSet

from .timing import Row

MOMENTS: dict[str, dict[str, float]] = {
    "one key at 1": {"browInnerUp": 1.0},
    "one key at 0.5": {"browInnerUp": 0.5},
    "two keys that share wrinkles": {"browInnerUp": 1.0, "browOuterUpLeft": 1.0},
    "five keys": {"browDownLeft": 0.5, "browInnerUp": 1.0, "noseSneerLeft": 0.7, "mouthSmileLeft": 0.8, "jawOpen": 0.3},
    "a whole disgust": {"noseSneerLeft": 1.0, "noseSneerRight": 1.0, "browDownLeft": 0.6, "browDownRight": 0.6},
}
SETTINGS = WrinkleSettings(level=2, pixels=512)
LEFT, PICTURES, KEYS = 0.3, 26, 30
"""Bounds: share of the turn that is left, pictures, keys with wrinkles."""


def rows() -> Iterator[Row]:
    """The kit against the map that the retargeting itself gives at those values; without the kit all is left."""
    donor, ape = demo.donor(42_000), demo.ape()
    rest = donor.face.mesh.vertices
    shapes = ShapeSet.of_positions(rest, demo.face_shapes(donor, ["arkit"]))
    problem = Problem(donor.face, ape.face)
    fitted = cast(LevelRetargeter, fit("hierarchical", problem, HierarchicalSettings(levels=5)))
    maps = FrameMaps(fitted, problem, None, SETTINGS)
    start = perf_counter()
    posed = retargeted_poses(maps, rest, shapes, shapes.names, find_correctives(shapes.names))
    kit = fit_wrinkle_kit(maps, posed, SETTINGS.least)
    for number in range(kit.difference_pictures):
        kit.differences(number, (0, 0))
    yield Row(f"keys with wrinkles, of {len(shapes)}", len(kit.keys), "", KEYS, at_least=True)
    yield Row("pictures of four channels", kit.pictures, "", PICTURES)
    yield Row("making it, 512 x 512", perf_counter() - start, "s")
    for what, values in MOMENTS.items():
        moved = rest + sum(value * shapes[name] for name, value in values.items())
        _, truth = maps.frame(moved.astype(np.float32))
        yield from _compared(what, kit, values, truth[0, 0], maps.maps[0, 0].pixel)


def _compared(
    what: str, kit: WrinkleKit, values: Mapping[str, float], truth: FloatArray, pixel: FloatArray
) -> Iterator[Row]:
    """How far the kit is off, beside how far the neutral's map is, as root of the mean square over the whole face."""
    left, all_of_it = (
        np.degrees(np.arccos(np.clip(np.einsum("hwi,hwi->hw", made, truth), -1, 1))).ravel()[pixel]
        for made in (kit.blended(values, (0, 0)), kit.neutral((0, 0)))
    )
    wrinkled = all_of_it > 2
    share = float(np.sqrt(np.square(left).mean() / np.square(all_of_it).mean()))
    yield Row(f"{what}: left of the turn", share, "", LEFT)
    yield Row(f"{what}: degrees off where it wrinkles, mean", float(left[wrinkled].mean()), "", 2.0)
    yield Row(f"{what}: the neutral's map there", float(all_of_it[wrinkled].mean()), "")
