"""Frames as few shape keys: how few, how well, and what becomes of keys that are there."""

from dataclasses import replace

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.face_regions import REGIONS
from facial_retarget_addon.core.methods.settings import BakeSettings
from facial_retarget_addon.core.reduction.bake_keys import RigKeys, compact_keys, onto_rig
from facial_retarget_addon.core.reduction.compact import compact
from facial_retarget_addon.core.reduction.keyed import KeyedMotion
from facial_retarget_addon.core.reduction.rig_fit import fit_to_keys, residual_keys


def bumps(count: int = 4, frames: int = 60) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A sheet with bumps in places of their own that come and go by themselves: neutral, shapes, curves."""
    rng = np.random.default_rng(5)
    x, y = np.meshgrid(np.linspace(0, 10, 40), np.linspace(0, 10, 40))
    neutral = np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3)
    centres = np.array([[2, 2], [8, 2], [2, 8], [8, 8]])[:count]
    shapes = np.zeros((count, len(neutral), 3), np.float32)
    for shape, centre in zip(shapes, centres, strict=True):
        distance = np.linalg.norm(neutral[:, :2] - centre, axis=1)
        shape[:, 2] = np.maximum(0, 1 - distance / 2.5) ** 2
    curves = np.abs(rng.normal(size=(frames, count))).astype(np.float32)
    return neutral, shapes, curves / curves.max(axis=0)


def frames_of(shapes: np.ndarray, curves: np.ndarray) -> np.ndarray:
    return np.einsum("fk,kvi->fvi", curves, shapes)


def test_every_bump_becomes_a_key_of_its_own() -> None:
    neutral, shapes, curves = bumps()
    found = compact(frames_of(shapes, curves), neutral, 0.005, 5.0, np.random.default_rng(0))
    assert len(found.shapes) == 4
    assert found.errors.max() <= 0.005
    for shape in shapes:
        alike = [np.sum(shape * key) / np.linalg.norm(shape) / np.linalg.norm(key) for key in found.shapes]
        assert max(alike) > 0.99
    for key in found.shapes:
        lengths = np.linalg.norm(key, axis=1)
        assert (lengths > 0.02 * lengths.max()).mean() < 0.25


@pytest.mark.parametrize("share", [0.001, 0.005, 0.02])
def test_a_performance_keeps_its_tolerance_with_few_keys(share: float) -> None:
    actor = demo.actor(3_000)
    motion = demo.performance(actor) - actor.face.mesh.vertices.astype(np.float32)
    found = compact(motion, actor.face.mesh.vertices, share, 1.0, np.random.default_rng(0))
    away = np.linalg.norm(found.displacements() - motion, axis=2)
    moving = np.linalg.norm(motion, axis=2).max(axis=0) > share
    np.testing.assert_allclose(found.errors, np.sqrt((away[:, moving] ** 2).mean(axis=1)), rtol=1e-3, atol=1e-7)
    np.testing.assert_allclose(found.worst, away.max(axis=1), rtol=1e-3, atol=1e-7)
    assert found.errors.max() <= share * (1 + 1e-3)
    assert len(found.shapes) < len(motion) / 5
    np.testing.assert_allclose(found.curves.max(axis=0), 1, rtol=1e-5)
    assert np.abs(found.curves).max() < 1 + 1e-5


def test_keys_are_named_after_the_regions_that_they_move_and_numbered_where_points_do_not_tell() -> None:
    actor = demo.actor(3_000)
    frames, settings = demo.performance(actor), BakeSettings("compact", tolerance=0.02)
    baked = compact_keys(actor.face, 1.0, frames, settings)
    assert baked.made == len(baked.names) == len(set(baked.names)) > 1
    assert {name.removeprefix("retargeted_").split("_")[0].split(".")[0] for name in baked.names} <= {*REGIONS, "head"}
    assert any("mouth" in name or "jaw" in name for name in baked.names)
    points = actor.face.points
    nameless = replace(points, names=tuple(f"p{number}" for number in range(len(points))))
    numbered = compact_keys(replace(actor.face, points=nameless), 1.0, frames, settings)
    assert numbered.names == tuple(f"retargeted_{number}" for number in range(1, 1 + baked.made))


def test_a_rig_that_has_the_name_of_a_new_key_is_refused() -> None:
    actor = demo.actor(3_000)
    moves = np.ones((1, len(actor.face.mesh.vertices), 3), np.float32)
    rig = RigKeys(("retargeted_residual_1",), moves, np.zeros(1), np.ones(1))
    with pytest.raises(RetargetError, match="'retargeted_residual_1', expected another name"):
        onto_rig(actor.face, rig, actor.face.mesh.vertices + moves, BakeSettings("rig", residual=9))


def test_a_tighter_tolerance_takes_no_fewer_keys() -> None:
    actor = demo.actor(3_000)
    motion = demo.performance(actor) - actor.face.mesh.vertices.astype(np.float32)
    counts = [
        len(compact(motion, actor.face.mesh.vertices, share, 1.0, np.random.default_rng(0)).shapes)
        for share in (0.02, 0.005, 0.001)
    ]
    assert counts == sorted(counts)
    assert counts[0] < counts[-1]


def test_no_motion_needs_no_key_and_one_frame_needs_one() -> None:
    neutral, shapes, _ = bumps()
    still = compact(np.zeros((5, len(neutral), 3), np.float32), neutral, 0.01, 5.0, np.random.default_rng(0))
    assert still.shapes.shape == (0, len(neutral), 3)
    assert still.curves.shape == (5, 0)
    assert still.displacements().shape == (5, len(neutral), 3)
    one = compact(shapes[:1], neutral, 1e-3, 5.0, np.random.default_rng(0))
    assert len(one.shapes) == 1
    assert one.errors.max() <= 1e-3


class CountingDirections:
    """A generator that notes how many random directions were asked for."""

    def __init__(self) -> None:
        self.counts: list[int] = []

    def standard_normal(self, shape: tuple[int, int], kind: type) -> np.ndarray:
        self.counts.append(shape[1])
        return np.random.default_rng(0).standard_normal(shape, kind)


def test_a_motion_far_larger_than_the_tolerance_needs_no_more_components() -> None:
    """Lengths that differ by a tolerance from those of the motion would be lost in its float32."""
    neutral, shapes, _ = bumps()
    curve = np.sin(np.arange(300) * 0.37, dtype=np.float32)
    moves = curve[:, None, None] * (np.float32([0, 0, 1]) + 0.01 * shapes[:1])
    directions = CountingDirections()
    keyed = compact(moves, neutral, 2e-4, 5.0, directions)
    assert directions.counts == [32 + 8]
    assert len(keyed.shapes) == 1
    assert keyed.errors.max() <= 2e-4


def test_what_cannot_be_meant_is_refused() -> None:
    neutral, shapes, _ = bumps()
    with pytest.raises(RetargetError, match=r"shape \(0, 1600, 3\).*at least one frame"):
        compact(shapes[:0], neutral, 0.01, 5.0, np.random.default_rng(0))
    with pytest.raises(RetargetError, match="tolerance 0"):
        compact(shapes, neutral, 0, 5.0, np.random.default_rng(0))
    with pytest.raises(RetargetError, match=r"\(4, 1600, 3\) and shape keys of shape \(2, 9, 3\)"):
        fit_to_keys(shapes, np.ones((2, 9, 3)), np.zeros(2), np.ones(2))
    with pytest.raises(RetargetError, match="none of 4 shape keys moves"):
        fit_to_keys(shapes, 0 * shapes, np.zeros(4), np.ones(4))
    with pytest.raises(RetargetError, match=r"shape key 1 ranges from 1.0 to 0.0"):
        fit_to_keys(shapes, shapes, np.array([0.0, 1.0, 0, 0]), np.array([1.0, 0.0, 1, 1]))


def test_a_rigs_own_motion_comes_back_as_its_sliders() -> None:
    _, shapes, curves = bumps()
    found = fit_to_keys(frames_of(shapes, curves), shapes, np.zeros(4), np.ones(4))
    np.testing.assert_allclose(found.curves, curves, atol=1e-3)
    assert found.errors.max() < 1e-3


def test_sliders_stay_in_their_ranges_and_are_the_best_ones_there() -> None:
    _, shapes, curves = bumps()
    low, high = np.full(4, 0.1), np.array([0.5, 1.0, 1.0, 1.0])
    found = fit_to_keys(frames_of(shapes, curves), shapes, low, high)
    # The bumps do not overlap: the best value is the nearest in the range.
    np.testing.assert_allclose(found.curves, np.clip(curves, low, high), atol=1e-3)


def test_smoothness_takes_jitter_out_and_keeps_slow_motion() -> None:
    _, shapes, _ = bumps()
    slow = 0.5 - 0.5 * np.cos(np.linspace(0, 2 * np.pi, 100))[:, None] * np.ones(4)
    noisy = slow + 0.05 * np.random.default_rng(2).normal(size=slow.shape)
    rough = fit_to_keys(frames_of(shapes, noisy).astype(np.float32), shapes, np.full(4, -1), np.full(4, 2))
    smooth = fit_to_keys(frames_of(shapes, noisy).astype(np.float32), shapes, np.full(4, -1), np.full(4, 2), 5.0)
    assert np.abs(smooth.curves - slow).mean() < 0.6 * np.abs(rough.curves - slow).mean()
    assert np.abs(np.diff(smooth.curves, 2, axis=0)).mean() < 0.2 * np.abs(np.diff(rough.curves, 2, axis=0)).mean()


def test_sparsity_leaves_keys_at_zero_that_others_nearly_stand_for() -> None:
    _, shapes, curves = bumps()
    extra = np.concatenate([shapes, 0.4 * (shapes[:1] + shapes[1:2])])
    motion = frames_of(shapes, curves).astype(np.float32)
    many = fit_to_keys(motion, extra, np.full(5, -1), np.full(5, 2))
    few = fit_to_keys(motion, extra, np.full(5, -1), np.full(5, 2), sparsity=0.01)
    assert np.abs(many.curves[:, 4]).mean() > 0.1
    assert not few.curves[:, 4].any()
    assert np.abs(few.displacements() - motion).max() < 0.02 * np.abs(motion).max()


def test_the_price_of_a_value_is_taken_off_it() -> None:
    # Bumps that do not overlap: each value falls by the price over its key's own energy, and stops at zero.
    _, shapes, curves = bumps()
    energy = (shapes.astype(np.float64) ** 2).sum(axis=(1, 2))
    found = fit_to_keys(frames_of(shapes, curves), shapes, np.zeros(4), np.ones(4), sparsity=0.1)
    expected = np.clip(curves - 0.1 * energy.mean() / energy, 0, 1)
    np.testing.assert_allclose(found.curves, expected, atol=2e-3)


def test_a_residual_key_takes_what_the_sliders_leave_in_its_frames_only() -> None:
    _, shapes, curves = bumps()
    motion = frames_of(shapes, curves).astype(np.float32)
    keyed = fit_to_keys(motion, shapes[:3], np.zeros(3), np.ones(3))
    more = residual_keys(motion, keyed, [slice(0, 30)])
    assert len(more.shapes) == 4
    assert more.errors[:30].max() < 1e-3 < keyed.errors[:30].max()
    np.testing.assert_array_equal(more.curves[30:, 3], 0)
    np.testing.assert_allclose(more.errors[30:], keyed.errors[30:], rtol=1e-4)


def test_a_keyed_motion_is_its_curves_times_its_shapes() -> None:
    _, shapes, curves = bumps()
    keyed = KeyedMotion(shapes, curves, np.zeros(60), np.zeros(60))
    np.testing.assert_allclose(keyed.displacements(slice(3, 9)), frames_of(shapes, curves)[3:9], atol=1e-6)
