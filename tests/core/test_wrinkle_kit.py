"""Wrinkle kits: what pictures of keys say at any values, and how few of them there are."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.normal_maps.key_poses import KeyPoses, Pose, retargeted_poses, sculpted_poses
from facial_retarget_addon.core.normal_maps.normal_map import fit_normal_map
from facial_retarget_addon.core.normal_maps.surface import TexturedSurface
from facial_retarget_addon.core.normal_maps.wrinkle_kit import WrinkleKit, normals_of, slopes, unpacked
from facial_retarget_addon.core.shapes.combinations import Corrective
from facial_retarget_addon.core.shapes.shape_set import ShapeSet

TILE = (0, 0)


def sheet(side: int, mirrored: bool = False) -> TexturedSurface:
    """A flat square of side * side vertices from -1 to 1; the texture of its right half is mirrored if asked."""
    x, y = np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side))
    grid = np.arange(side * side).reshape(side, side)
    quads = np.stack([grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]], axis=-1).reshape(-1, 4)
    counts, corners = np.full(len(quads), 4), quads.ravel()
    places = np.stack([x, y, np.zeros_like(x)], axis=-1).reshape(-1, 3)
    uvs = places[corners, :2] * 0.49 + 0.5
    if mirrored:
        right = places[quads].mean(axis=1)[:, 0].repeat(4) > 0
        uvs[:, 0] = np.where(right, 1.5 - uvs[:, 0], uvs[:, 0])
    return TexturedSurface(TriMesh.from_polygons(places, counts, corners), counts, corners, uvs)


def folds(vertices: np.ndarray, middle: tuple[float, float], fine: bool, height: float = 0.02) -> np.ndarray:
    """Displacements (V, 3) of skin that is pushed together around a place; the fine mesh folds there."""
    x, y = (vertices[:, :2] - middle).T
    near = np.clip(1 - (x * x + y * y) / 0.16, 0, None) ** 2
    moved = np.zeros_like(vertices)
    moved[:, 1] = -0.15 * y * near
    if fine:
        moved[:, 2] = height * np.sin(25 * y) * near
    return moved


PLACES = {"left": (-0.5, 0.0), "right": (0.5, 0.0), "low": (-0.3, -0.1)}


def kit_of(light: TexturedSurface, shapes: Mapping[str, tuple[np.ndarray, np.ndarray]], least: float = 2.0):
    """The kit of shapes of a sheet and of a fine one, the map, and the poses."""
    fine = sheet(161).mesh
    rest = np.array(fine.vertices)
    rest[:, 2] += 0.004 * np.sin(12 * rest[:, 0])
    neutral = Pose(light.mesh.vertices.astype(np.float32), rest.astype(np.float32))
    held = fit_normal_map(light, fine.with_vertices(rest), 128)
    names = tuple(shapes)
    sets = [ShapeSet(names, np.stack([shapes[name][k] for name in names])) for k in (0, 1)]
    posed = sculpted_poses(neutral, *sets)
    return WrinkleKit(light.mesh, {TILE: held}, posed.neutral, posed.keys, least), held, posed


def folded(light: TexturedSurface, *names: str) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    fine = sheet(161).mesh.vertices
    return {name: (folds(light.mesh.vertices, PLACES[name], False), folds(fine, PLACES[name], True)) for name in names}


def angles(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    return np.degrees(np.arccos(np.clip(np.einsum("...i,...i->...", one, other), -1, 1)))


@pytest.mark.parametrize("mirrored", [False, True])
def test_a_key_at_full_strength_is_its_own_map_where_its_mask_is_whole(mirrored: bool) -> None:
    light = sheet(21, mirrored)
    kit, held, posed = kit_of(light, folded(light, "left", "right", "low"))
    for key in kit.keys:
        truth = held.vectors(*posed.keys[key.name]().pose)
        whole = held.at_pixels(key.mask) == 1
        assert whole.sum() > 300
        np.testing.assert_allclose(kit.blended({key.name: 1.0}, TILE)[whole], truth[whole], atol=1e-5)
    np.testing.assert_allclose(kit.blended({}, TILE), kit.neutral(TILE), atol=1e-6)


def test_values_between_and_several_keys_are_nearly_the_map_of_that_mix() -> None:
    light = sheet(21)
    kit, held, posed = kit_of(light, folded(light, "left", "right", "low"))
    for values in ({"left": 0.5}, {"left": 1.0, "low": 1.0}, {"left": 0.3, "right": 0.8, "low": 0.6}):
        mixed = [np.array(rest, np.float64) for rest in posed.neutral]
        for name, value in values.items():
            for place, (there, rest) in enumerate(zip(posed.keys[name]().pose, posed.neutral, strict=True)):
                mixed[place] += value * (there.astype(np.float64) - rest)
        truth = held.vectors(*mixed)
        missing, left = angles(kit.neutral(TILE), truth), angles(kit.blended(values, TILE), truth)
        assert np.sqrt((left**2).mean() / (missing**2).mean()) < 0.2, values


def test_keys_that_wrinkle_nothing_are_dropped_and_a_kit_of_nothing_else_is_refused() -> None:
    light = sheet(21)
    fine = sheet(161).mesh.vertices
    smooth = {"smooth": tuple(folds(v, PLACES["right"], False) for v in (light.mesh.vertices, fine))}
    moved = {"moved": tuple(np.tile([0.1, 0.2, 0.3], (len(v), 1)) for v in (light.mesh.vertices, fine))}
    kit, _, _ = kit_of(light, smooth | moved | folded(light, "left"))
    assert [key.name for key in kit.keys] == ["left"]
    assert kit.dropped["moved"] == 0
    assert kit.dropped["smooth"] < 2
    with pytest.raises(RetargetError, match="none of the 2 shape keys turns normals by 2 degrees"):
        kit_of(light, smooth | moved)


def test_keys_without_a_triangle_in_common_share_a_layer() -> None:
    light = sheet(21)
    kit, held, _ = kit_of(light, folded(light, "left", "right", "low"))
    layer = {key.name: key.layer for key in kit.keys}
    assert layer["left"] != layer["low"]
    assert layer["right"] == max(layer["left"], layer["low"]) or layer["right"] == 0
    assert (kit.layers, kit.difference_pictures, kit.mask_pictures) == (2, 1, 1)
    for one in kit.keys:
        for other in kit.keys:
            if one is not other and one.layer == other.layer:
                assert not ((held.at_pixels(one.mask) > 0) & (held.at_pixels(other.mask) > 0)).any()


def test_a_mask_lies_where_skin_is_strained_and_wrinkles() -> None:
    light = sheet(21)
    kit, _, _ = kit_of(light, folded(light, "left"))
    away = np.linalg.norm(light.mesh.vertices[:, :2] - PLACES["left"], axis=1)
    assert (kit.keys[0].mask[away < 0.15] == 1).all()
    assert (kit.keys[0].mask[away > 0.75] == 0).all()
    assert kit.keys[0].kept > 0.9
    # Skin that only moves has no mask, however much the fine mesh wrinkles there.
    still = {"left": (np.zeros_like(light.mesh.vertices), folds(sheet(161).mesh.vertices, PLACES["left"], True))}
    with pytest.raises(RetargetError, match="none of the 1 shape keys"):
        kit_of(light, still)


def test_pictures_hold_unit_vectors_and_masks() -> None:
    light = sheet(21)
    kit, _, _ = kit_of(light, folded(light, "left", "right", "low"))
    pairs = kit.differences(0, TILE).reshape(-1, 2, 2)
    assert np.einsum("pki,pki->pk", pairs, pairs).max() < 1
    masks = kit.masks(0, TILE)
    assert masks.min() == 0
    assert masks.max() == 1
    assert not masks[..., 3].any()


def test_slopes_become_normals_and_pictures_and_come_back() -> None:
    slope = np.random.default_rng(5).normal(size=(50, 2)).astype(np.float32)
    normals = normals_of(slope)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-6)
    np.testing.assert_allclose(slopes(normals), slope, rtol=1e-4)
    np.testing.assert_allclose(unpacked(normals[:, :2]), slope, rtol=1e-4)
    # What lies flatter than a shader can tell stays finite.
    assert np.isfinite(unpacked(np.array([[1.0, 0.2]], np.float32))).all()
    assert np.isfinite(slopes(np.array([[1.0, 0.0, -0.1]], np.float32))).all()


class Doubler:
    """Poses whose light mesh is the source, and whose fine mesh is twice as large."""

    def pose(self, source: np.ndarray) -> Pose:
        return Pose(source, 2 * source)


def test_a_corrective_is_seen_against_what_it_corrects() -> None:
    rest = np.zeros((2, 3))
    shapes = ShapeSet(("open", "close", "other"), np.arange(18, dtype=np.float32).reshape(3, 2, 3))
    posed = retargeted_poses(Doubler(), rest, shapes, ["close", "other"], [Corrective("close", ("open",))])
    close, other = posed.keys["close"](), posed.keys["other"]()
    np.testing.assert_array_equal(close.start.light, shapes["open"])
    np.testing.assert_array_equal(close.pose.fine, 2 * (shapes["open"] + shapes["close"]))
    assert isinstance(other, KeyPoses)
    assert other.start is posed.neutral
