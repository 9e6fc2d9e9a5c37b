"""The head's motion out of rigid markers, and its turn as FAPs 48 to 50."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.markers.head_motion import HeadMotion, head_motion, rigid_markers
from facial_retarget_addon.core.mpeg4.head_turn import head_angles, rotation_of_angles

RIGID = 8
ACTING = 12
AXES = np.array([[0.0, 1, 0], [0, 0, 1], [1, 0, 0]])
"""A head that looks along x with z up."""


def rms(vectors: np.ndarray) -> float:
    return float(np.sqrt((vectors**2).sum(axis=-1).mean()))


def nodding_head(rng: np.random.Generator, frames: int = 200) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A head of 180 mm: neutral markers (M, 3), the same acting and unmoved (F, M, 3), and the same on the moving head.

    The first eight markers do not act.
    """
    neutral = rng.normal(size=(RIGID + ACTING, 3)) * [60, 70, 25] + [300, 1500, -200]
    acting = np.repeat(neutral[None], frames, axis=0)
    acting[:, RIGID:] += 8 * np.sin(np.arange(frames) / 9 + rng.uniform(0, 6, (ACTING, 3, 1))).transpose(2, 0, 1)
    turns = rotation_of_angles(np.cumsum(rng.normal(size=(frames, 3)), axis=0) * 2000, np.eye(3))
    places = np.einsum("fij,fmj->fmi", turns, acting) + np.cumsum(rng.normal(size=(frames, 3)), axis=0)[:, None] * 5
    return neutral, acting, places


def on_three(neutral: np.ndarray, frames: np.ndarray, method: str) -> HeadMotion:
    return head_motion(neutral[:3], frames[:, :3], method)


@pytest.mark.parametrize("method", ["kabsch", "linear"])
def test_a_known_motion_is_found_again(method: str) -> None:
    neutral, acting, places = nodding_head(np.random.default_rng(1))
    motion = on_three(neutral, places, method)
    np.testing.assert_allclose(motion.removed(places), acting, atol=1e-7)
    np.testing.assert_allclose(motion.residual, 0, atol=1e-7)


@pytest.mark.parametrize("noise", [0.1, 0.3, 1.0])
def test_the_error_is_at_the_noise_and_below_the_linear_methods(noise: float) -> None:
    kabsch, kabsch_on_three, linear = [], [], []
    for seed in range(8):
        rng = np.random.default_rng(seed)
        neutral, acting, places = nodding_head(rng)
        seen = places + noise * rng.normal(size=places.shape)
        motions = (
            head_motion(neutral[:RIGID], seen[:, :RIGID]),
            on_three(neutral, seen, "kabsch"),
            on_three(neutral, seen, "linear"),
        )
        for motion, errors in zip(motions, (kabsch, kabsch_on_three, linear), strict=True):
            errors.append(rms(motion.removed(places) - acting))
    level = noise * np.sqrt(3)
    assert np.mean(kabsch) < level
    assert np.mean(kabsch_on_three) < np.mean(linear)
    assert np.mean(kabsch) < 0.5 * np.mean(linear)


def test_the_residual_is_the_noise() -> None:
    rng = np.random.default_rng(5)
    neutral, _, places = nodding_head(rng)
    motion = head_motion(neutral[:RIGID], (places + 0.3 * rng.normal(size=places.shape))[:, :RIGID])
    # Six of the 24 numbers of a frame go into the motion.
    assert np.sqrt((motion.residual**2).mean()) == pytest.approx(0.3 * np.sqrt(3 * 18 / 24), rel=0.05)


def test_the_linear_matrix_is_no_rotation_under_noise_and_kabschs_is() -> None:
    rng = np.random.default_rng(4)
    neutral, _, places = nodding_head(rng)
    seen = places + rng.normal(size=places.shape)
    off = {}
    for method in ("kabsch", "linear"):
        rotations = on_three(neutral, seen, method).rotations
        off[method] = np.abs(np.swapaxes(rotations, 1, 2) @ rotations - np.eye(3)).max()
    assert off["kabsch"] < 1e-12
    assert off["linear"] > 1e-3


def test_trimming_ignores_a_marker_that_acts_and_one_that_jumps() -> None:
    rng = np.random.default_rng(6)
    neutral, acting, places = nodding_head(rng)
    seen = places + 0.1 * rng.normal(size=places.shape)
    rows = np.arange(RIGID + 1)
    seen[50:60, 2] += [40, -30, 20]
    plain, trimmed = (head_motion(neutral[rows], seen[:, rows], trim=trim) for trim in (False, True))
    assert rms(trimmed.removed(places) - acting) < 0.2
    assert rms(trimmed.removed(places) - acting) < 0.1 * rms(plain.removed(places) - acting)
    assert trimmed.weights[50:60, 2].max() < 0.01 < 0.5 < np.median(trimmed.weights[:50, 2])
    assert (plain.weights == 1).all()


def test_a_marker_that_is_not_seen_is_left_out_of_its_frame() -> None:
    neutral, acting, places = nodding_head(np.random.default_rng(7))
    gappy = places.copy()
    gappy[3, 0, 1] = np.nan
    gappy[10:20, 2:5] = np.nan
    motion = head_motion(neutral[:RIGID], gappy[:, :RIGID])
    np.testing.assert_allclose(motion.removed(places), acting, atol=1e-7)
    np.testing.assert_array_equal(motion.weights, np.isfinite(gappy[:, :RIGID]).all(axis=2))


def test_rigid_markers_are_found_among_acting_ones() -> None:
    rng = np.random.default_rng(8)
    neutral, acting, places = nodding_head(rng)
    shuffled = rng.permutation(len(neutral))
    seen = places + 0.05 * rng.normal(size=places.shape)
    seen[20:25, 4] = np.nan
    chosen = shuffled[rigid_markers(neutral[shuffled], seen[:, shuffled])]
    assert set(chosen) <= set(range(RIGID))
    assert len(chosen) >= 6
    motion = head_motion(neutral[chosen], seen[:, chosen])
    assert rms(motion.removed(places) - acting) < 0.1


def test_rigid_markers_spread_out() -> None:
    """Three markers a millimetre apart keep their distances best, and say least about the head."""
    rng = np.random.default_rng(9)
    neutral, _, places = nodding_head(rng)
    places[:, RIGID : RIGID + 3] = places[:, :1] + rng.normal(size=(3, 3))
    neutral = places[0]
    seen = places + 0.1 * rng.normal(size=places.shape)
    assert len(set(rigid_markers(neutral, seen)) & set(range(1, RIGID))) >= 5


@pytest.mark.parametrize("take", ["jaw", "cheeks"])
def test_the_head_is_taken_out_of_a_real_take(shared_data: Path, take: str) -> None:
    """In millimetres; the forehead's markers move 5, and with the head removed about as little as the fit leaves."""
    with np.load(shared_data / f"animface_{take}.npz") as file:
        places, names = 10 * file["positions"].astype(np.float64), file["markers"].tolist()
    rows = rigid_markers(places[0], places)
    motion = head_motion(places[0, rows], places[:, rows])
    residual = np.sqrt((motion.residual**2).mean())
    assert residual < 1
    forehead = [names.index(name) for name in ("ForeHead_M", "ForeHead_L", "ForeHead_R")]
    assert rms(places[:, forehead] - places[0, forehead]) > 4
    assert rms(motion.removed(places)[:, forehead] - places[0, forehead]) < 1.2 * residual


@pytest.mark.parametrize(
    ("neutral", "frames", "method", "message"),
    [
        (np.eye(3), np.eye(3), "kabsch", "shape"),
        (np.eye(3), np.empty((0, 3, 3)), "kabsch", "F at least 1"),
        (np.eye(4)[:, :3], np.ones((2, 4, 3)), "linear", "4 rigid markers"),
        (np.eye(3), np.ones((2, 3, 3)), "svd", "method is 'svd'"),
        (np.eye(3), np.stack([np.eye(3), np.full((3, 3), np.nan)]), "kabsch", "frame 2 shows 0 of the 3"),
        (np.eye(3), np.stack([np.eye(3), np.outer([0, 1, 2], [1, 1, 1])]), "kabsch", "frame 2 lie on one line"),
        (np.eye(3), np.stack([np.eye(3), np.outer([0, 1, 2], [1, 1, 1])]), "linear", "frame 2 lie on one line"),
        (np.outer([0.0, 1, 2], [1, 1, 1]), np.eye(3)[None], "linear", "neutral frame lie on one line"),
    ],
)
def test_bad_markers_are_refused(neutral: np.ndarray, frames: np.ndarray, method: str, message: str) -> None:
    with pytest.raises(RetargetError, match=message):
        head_motion(neutral, frames, method)


def test_too_few_seen_markers_are_refused() -> None:
    frames = np.full((4, 5, 3), np.nan)
    frames[:, :2] = 0
    with pytest.raises(RetargetError, match="2 of the 5 markers"):
        rigid_markers(np.random.default_rng(0).normal(size=(5, 3)), frames)


@given(st.integers(0, 10_000))
def test_turns_come_back_as_they_went(seed: int) -> None:
    rng = np.random.default_rng(seed)
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    axes *= np.sign(np.linalg.det(axes))
    values = rng.uniform(-1, 1, (5, 3)) * [155_000, 310_000, 310_000]
    rotations = rotation_of_angles(values, axes)
    np.testing.assert_allclose(np.linalg.det(rotations), 1, atol=1e-12)
    np.testing.assert_allclose(head_angles(rotations, axes), values, atol=1e-3)


def test_pitch_looks_down_yaw_looks_left_roll_tilts_right() -> None:
    left, up, forward = AXES
    down, to_left, to_right = rotation_of_angles(50_000 * np.eye(3), AXES)
    assert (down @ forward) @ up < -0.4
    assert (to_left @ forward) @ left > 0.4
    assert (to_right @ up) @ left < -0.4
    for turn, still in ((down, left), (to_left, up), (to_right, forward)):
        np.testing.assert_allclose(turn @ still, still, atol=1e-12)
