"""Streams of FAPs with visemes and expressions resolved, and out of ARKit weights."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mpeg4.arkit import ARKIT
from facial_retarget_addon.core.mpeg4.arkit_take import ArkitTake
from facial_retarget_addon.core.mpeg4.conversions import faps_of_arkit, low_level, recipe_matrix, stream_of_values
from facial_retarget_addon.core.mpeg4.expressions import EXPRESSIONS
from facial_retarget_addon.core.mpeg4.faps import FAPS
from facial_retarget_addon.core.mpeg4.stream import FapStream
from facial_retarget_addon.core.mpeg4.visemes import VISEMES

MIRROR = np.array([fap.mirror - 1 for fap in FAPS])
MIRROR_SIGN = np.array([fap.mirror_sign for fap in FAPS])
TAKES = ("livelink_alex_rom_3.npz", "livelink_jmiller.npz")


def stream(frames: int) -> FapStream:
    """A stream that states nothing."""
    empty = stream_of_values("made", 25, np.zeros((frames, 68)))
    return replace(empty, used=np.zeros((frames, 68), bool))


def live_link(path: Path) -> ArkitTake:
    with np.load(path) as take:
        rotations = take["rot"].astype(float)
        return ArkitTake(path.stem, float(take["fps"]), take["weights"], rotations[:, :3], rotations[:, 3:])


def _side(name: str) -> str:
    return next((side for side in ("Left", "Right") if name.endswith(side)), "")


def mirror_image(take: ArkitTake) -> ArkitTake:
    swap = {"Left": "Right", "Right": "Left"}
    order = list(ARKIT)
    partner = [name[: -len(side)] + swap[side] if (side := _side(name)) else name for name in order]
    assert take.head is not None
    assert take.eyes is not None
    turned = np.array([-1, 1, -1])
    return replace(
        take,
        weights=take.weights[:, [order.index(name) for name in partner]],
        head=take.head * turned,
        eyes=np.concatenate([take.eyes[:, 3:] * turned, take.eyes[:, :3] * turned], axis=1),
    )


def take_of(**weights: float) -> ArkitTake:
    """One frame."""
    return ArkitTake("made", 60, np.array([[weights.get(name, 0.0) for name in ARKIT]]), None, None)


def row(recipe: dict[int, int]) -> np.ndarray:
    return recipe_matrix([recipe])[0]


# ---- low-level FAPs ---------------------------------------------------------------------------------
def test_a_stream_that_states_everything_is_its_own_low_level() -> None:
    values = np.random.default_rng(1).normal(size=(7, 68))
    values[:, :2] = 0
    for missing in ("hold", "zero"):
        np.testing.assert_array_equal(low_level(stream_of_values("made", 25, values), missing), values)


def test_unused_faps_hold_what_they_said_or_are_zero() -> None:
    made = stream(4)
    made.values[:, 2] = [7, 5, 99, 3]
    made.used[:, 2] = [False, True, False, True]
    np.testing.assert_array_equal(low_level(made, "hold")[:, 2], [0, 5, 5, 3])
    np.testing.assert_array_equal(low_level(made, "zero")[:, 2], [0, 5, 0, 3])
    np.testing.assert_array_equal(low_level(made), low_level(made, "hold"))


def test_two_visemes_blend() -> None:
    made = stream(3)
    made.used[:, 0] = True
    made.viseme[:] = [[1, 10, 63, 0], [1, 10, 0, 0], [1, 10, 21, 0]]
    first, second = (row(VISEMES[name].recipe) for name in ("viseme_PP", "viseme_aa"))
    np.testing.assert_allclose(low_level(made), [first, second, first / 3 + 2 * second / 3])


def test_viseme_0_is_a_mouth_at_rest() -> None:
    made = stream(2)
    made.used[:, 0] = True
    made.viseme[:] = [[0, 0, 40, 0], [14, 0, 21, 0]]
    np.testing.assert_allclose(low_level(made), [np.zeros(68), row(VISEMES["viseme_ou"].recipe) / 3])


def test_two_expressions_add_up_by_their_intensities() -> None:
    made = stream(2)
    made.used[:, 1] = True
    made.expression[:] = [[1, 63, 6, 21, 0, 0], [3, 42, 0, 63, 0, 0]]
    joy, surprise, anger = (row(EXPRESSIONS[name].recipe) for name in ("joy", "surprise", "anger"))
    np.testing.assert_allclose(low_level(made), [joy + surprise / 3, 2 * anger / 3])


def test_recipes_are_added_to_what_low_level_faps_say() -> None:
    made = stream(1)
    made.used[:] = True
    made.values[:, 30] = 40
    made.expression[:] = [6, 63, 0, 0, 0, 0]
    made.viseme[:] = [10, 0, 63, 0]
    wanted = row(EXPRESSIONS["surprise"].recipe) + row(VISEMES["viseme_aa"].recipe)
    wanted[30] += 40
    np.testing.assert_allclose(low_level(made)[0], wanted)


def test_high_level_faps_are_held_and_dropped_like_the_others() -> None:
    made = stream(3)
    made.used[1, :2] = True
    made.viseme[:] = [[2, 0, 63, 0], [10, 0, 63, 0], [0, 0, 0, 0]]
    made.expression[:] = [[2, 63, 0, 0, 0, 0], [1, 63, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0]]
    shown = row(VISEMES["viseme_aa"].recipe) + row(EXPRESSIONS["joy"].recipe)
    np.testing.assert_allclose(low_level(made, "hold"), [np.zeros(68), shown, shown])
    np.testing.assert_allclose(low_level(made, "zero"), [np.zeros(68), shown, np.zeros(68)])


def test_a_frame_that_defines_its_own_shape_gets_no_recipe() -> None:
    made = stream(1)
    made.used[:, :3] = True
    made.values[:, 2] = 300
    made.viseme[:] = [10, 0, 63, 1]
    made.expression[:] = [1, 63, 0, 0, 0, 1]
    np.testing.assert_array_equal(low_level(made), made.values)


def test_wrong_input_is_told() -> None:
    with pytest.raises(RetargetError, match="'skip', expected 'hold' or 'zero'"):
        low_level(stream(1), "skip")
    made = stream(2)
    made.used[1, :2] = True
    made.viseme[1] = [1, 15, 20, 0]
    with pytest.raises(RetargetError, match="frame 1 of 'made' selects viseme 15, expected 0 to 14"):
        low_level(made)
    made.viseme[1] = 0
    made.expression[1] = [-1, 20, 0, 0, 0, 0]
    with pytest.raises(RetargetError, match="frame 1 of 'made' selects expression -1, expected 0 to 6"):
        low_level(made)
    with pytest.raises(RetargetError, match=r"'made' have shape \(3, 66\), expected \(frames, 68\)"):
        stream_of_values("made", 25, np.zeros((3, 66)))


def test_no_frames_give_no_frames() -> None:
    for missing in ("hold", "zero"):
        assert low_level(stream(0), missing).shape == (0, 68)


def test_a_stream_of_values_states_what_it_is_told() -> None:
    used = np.zeros(68, bool)
    used[[0, 4]] = True
    made = stream_of_values("made", 25, np.ones((2, 68)), used)
    np.testing.assert_array_equal(np.flatnonzero(made.used.all(axis=0)), [4])
    np.testing.assert_array_equal(made.values.sum(axis=1), [1, 1])
    assert not stream_of_values("made", 25, np.ones((2, 68))).used[:, :2].any()


# ---- ARKit ------------------------------------------------------------------------------------------
@pytest.mark.parametrize("name", ARKIT)
def test_a_shape_alone_gives_its_recipe(name: str) -> None:
    np.testing.assert_allclose(faps_of_arkit(take_of(**{name: 0.5})).values[0], row(ARKIT[name]) / 2)


def test_a_take_without_head_leaves_the_head_alone() -> None:
    made = faps_of_arkit(take_of(eyeLookOutLeft=1))
    assert not made.used[:, [0, 1, 47, 48, 49]].any()
    assert made.used[:, 18:26].all()
    np.testing.assert_array_equal(low_level(made), made.values)


def test_angles_that_are_always_zero_were_not_recorded() -> None:
    plain = take_of(eyeLookDownRight=0.5)
    made = faps_of_arkit(replace(plain, head=np.zeros((1, 3)), eyes=np.zeros((1, 6))))
    np.testing.assert_array_equal(made.values, faps_of_arkit(plain).values)
    assert not made.used[:, 47:50].any()


def test_lids_do_not_cross() -> None:
    made = faps_of_arkit(take_of(eyeBlinkLeft=1, eyeLookDownLeft=0.6, eyeSquintLeft=0.7, eyeBlinkRight=0.5))
    assert made.values[0, 18] + made.values[0, 20] == pytest.approx(1024)
    assert made.values[0, 19] + made.values[0, 21] == pytest.approx(512)


@pytest.mark.parametrize("name", TAKES)
def test_a_mirrored_recording_gives_mirrored_faps(shared_data: Path, name: str) -> None:
    take = live_link(shared_data / name)
    take = replace(take, head=np.random.default_rng(2).normal(scale=0.2, size=(len(take), 3)))
    straight, turned = faps_of_arkit(take), faps_of_arkit(mirror_image(take))
    np.testing.assert_allclose(turned.values, (straight.values * MIRROR_SIGN)[:, MIRROR], atol=1e-6)
    np.testing.assert_array_equal(turned.used, straight.used[:, MIRROR])
    one_way = [fap.number - 1 for fap in FAPS if fap.one_way]
    assert straight.values[:, one_way].min() >= 0


@pytest.mark.parametrize("name", TAKES)
def test_recorded_eyes_turn_as_the_eye_look_weights_say(shared_data: Path, name: str) -> None:
    """The signs of Live Link's angles: with and without them the eyes turn the same way, about as far."""
    take = live_link(shared_data / name)
    angles, weights = (faps_of_arkit(one).values[:, 22:26] for one in (take, replace(take, eyes=None)))
    for eye in np.flatnonzero(np.ptp(weights, axis=0) > 10_000):
        assert np.corrcoef(angles[:, eye], weights[:, eye])[0, 1] > 0.98
        assert np.polyfit(weights[:, eye], angles[:, eye], 1)[0] == pytest.approx(1, abs=0.15)


@pytest.mark.parametrize("name", TAKES)
def test_recorded_roll_leans_to_the_subjects_left(shared_data: Path, name: str) -> None:
    """An eye that turns sideways, then about a level axis, rolls by their product in the order yaw, pitch, roll."""
    take = live_link(shared_data / name)
    assert take.eyes is not None
    for eye in (take.eyes[:, :3], take.eyes[:, 3:]):
        left, down, tilt_right = -eye[:, 0], eye[:, 1], -eye[:, 2]
        assert np.linalg.norm(tilt_right - left * down) < 0.1 * np.linalg.norm(tilt_right)


def test_angles_of_the_head_become_faps_48_to_50() -> None:
    take = replace(take_of(), head=np.array([[-0.3, 0.2, -0.1]]))
    made = faps_of_arkit(take)
    np.testing.assert_allclose(made.values[0, 47:50], [20_000, 30_000, 10_000])
    assert made.used[:, 47:50].all()


@pytest.mark.parametrize("name", TAKES)
def test_recorded_blinks_shut_the_eyes_and_jaws_open(shared_data: Path, name: str) -> None:
    take = live_link(shared_data / name)
    values = faps_of_arkit(take).values
    weight = dict(zip(ARKIT, take.weights.T, strict=True))
    shut = weight["eyeBlinkLeft"] > 0.8
    assert shut.any()
    assert (values[shut, 18] + values[shut, 20]).min() > 800
    assert (values[:, 18] + values[:, 20]).max() <= 1024 + 1e-6
    assert np.corrcoef(values[:, 2], -values[:, 4])[0, 1] > 0.9
