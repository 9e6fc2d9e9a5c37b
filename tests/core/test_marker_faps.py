"""Markers become the FAPs that moved them."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.markers.assignment import MarkerMap, by_name
from facial_retarget_addon.core.markers.faps import marker_faps
from facial_retarget_addon.core.markers.lips import OUTER, with_inner_lips
from facial_retarget_addon.core.markers.motion import marker_displacements
from facial_retarget_addon.core.markers.take import MarkerTake
from facial_retarget_addon.core.mpeg4.channels import PointChannels
from facial_retarget_addon.core.mpeg4.faps import FAPS
from facial_retarget_addon.core.mpeg4.fapu import measure_fapu
from facial_retarget_addon.core.mpeg4.fdps import FDPS
from facial_retarget_addon.core.mpeg4.head import head_axes
from facial_retarget_addon.core.mpeg4.head_turn import rotation_of_angles
from facial_retarget_addon.core.mpeg4.mean_face import MEAN_FACE

POINTS = tuple(MEAN_FACE)
NEUTRAL = 63 * np.array(list(MEAN_FACE.values()))
"""An average face, in millimetres."""
BAND = np.array([[-70.0, 80, -20], [70, 80, -20], [0, 95, 10], [-40, 90, 5], [45, 88, 8], [10, 130, -60]])
"""Markers on a band around the head."""
WHOLE_MAP = MarkerMap({f"m{point}": point for point in POINTS}, tuple(f"band{k}" for k in range(len(BAND))))
HEAD = [47, 48, 49]
AXES = head_axes(POINTS, NEUTRAL)
CHANNELS = PointChannels(POINTS, NEUTRAL, AXES, measure_fapu(POINTS, NEUTRAL, AXES))


def column(name: str) -> int:
    return next(fap.number for fap in FAPS if fap.name == name) - 1


def replayed(values: np.ndarray, places: np.ndarray) -> MarkerTake:
    """A take of a head that does what FAPs say while it moves from place to place (F, 3)."""
    on_head = np.concatenate(
        [NEUTRAL + CHANNELS.displacements(values), np.repeat(BAND[None], len(values), axis=0)], axis=1
    )
    turned = np.einsum("fij,fmj->fmi", rotation_of_angles(values[:, HEAD], AXES), on_head)
    return MarkerTake("acted", 60.0, (*WHOLE_MAP.points, *WHOLE_MAP.rigid), turned + places[:, None], "mm")


def acted(rng: np.random.Generator, frames: int = 40) -> tuple[MarkerTake, np.ndarray]:
    """A take of a head that turns, moves and acts at random, after a neutral frame; and its FAPs."""
    values = rng.uniform(-400, 400, (frames, len(FAPS))) * CHANNELS.measurable
    one_way = [fap.number - 1 for fap in FAPS if fap.one_way]
    values[:, one_way] = np.abs(values[:, one_way])
    values[:, HEAD] = rng.uniform(-1, 1, (frames, 3)) * [40_000, 60_000, 20_000]
    values[0] = 0
    return replayed(values, rng.normal(size=(frames, 3)) * 100), values


def real_take(folder: Path, name: str) -> tuple[MarkerTake, MarkerMap]:
    with np.load(folder / f"animface_{name}.npz") as file:
        take = MarkerTake(name, 60.0, tuple(file["markers"].tolist()), file["positions"].astype(np.float64), "cm")
    return take, MarkerMap(by_name(take.names).points)


def test_the_faps_that_moved_the_markers_come_back() -> None:
    take, values = acted(np.random.default_rng(1))
    stream, _ = marker_faps(take, WHOLE_MAP)
    assert CHANNELS.measurable.sum() > 40
    np.testing.assert_allclose(stream.values, values, atol=0.5)
    expected = CHANNELS.measurable.copy()
    expected[HEAD] = True
    np.testing.assert_array_equal(stream.used, np.tile(expected, (len(take), 1)))
    assert (stream.name, stream.fps, len(stream)) == ("acted", 60.0, len(take))


def test_the_linear_method_does_it_too_without_noise() -> None:
    take, values = acted(np.random.default_rng(2))
    stream, report = marker_faps(take, replace(WHOLE_MAP, rigid=("band0", "band1", "band5")), head="linear")
    np.testing.assert_allclose(stream.values, values, atol=0.5)
    assert report["head"]["method"] == "linear"


def test_a_turned_moved_and_scaled_take_says_the_same() -> None:
    rng = np.random.default_rng(3)
    take, values = acted(rng)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    other = replace(take, positions=0.001 * take.positions @ turn.T + [3, -5, 40])
    np.testing.assert_allclose(marker_faps(other, WHOLE_MAP)[0].values, values, atol=0.5)


def test_noise_of_a_tenth_of_a_millimetre_stays_small() -> None:
    rng = np.random.default_rng(4)
    take, values = acted(rng)
    noisy = replace(take, positions=take.positions + 0.1 * rng.normal(size=take.positions.shape))
    off = marker_faps(noisy, WHOLE_MAP)[0].values - values
    # 0.1 mm is some 5 units of the mouth's 22 mm and 10 of the lids' 10 mm, in both the neutral and the other frame.
    assert np.sqrt((off[:, : HEAD[0]] ** 2).mean()) < 15


def test_a_neutral_of_many_frames_is_their_mean_in_the_heads_place() -> None:
    rng = np.random.default_rng(5)
    take, values = acted(rng, 60)
    values[1:30, :47] = values[1:30, 50:] = 0
    on_head = np.concatenate([NEUTRAL, BAND])
    positions = take.positions.copy()
    positions[:30] = np.einsum("fij,mj->fmi", rotation_of_angles(values[:30, HEAD], AXES), on_head)
    positions += 0.3 * rng.normal(size=positions.shape)
    take = replace(take, positions=positions)
    errors = []
    for last in (1, 30):
        stream, _ = marker_faps(take, replace(WHOLE_MAP, neutral_frames=(1, last)))
        errors.append(np.sqrt(((stream.values - values)[30:, : HEAD[0]] ** 2).mean()))
    assert errors[1] < 0.85 * errors[0]


def test_points_move_as_markers_in_the_neutral_heads_place() -> None:
    take, _ = acted(np.random.default_rng(6))
    motion = marker_displacements(take, WHOLE_MAP)
    assert motion.names == POINTS
    np.testing.assert_allclose(motion.neutral, take.positions[0, : len(POINTS)], atol=1e-9)
    np.testing.assert_allclose(motion.displacements[0], 0, atol=1e-9)
    np.testing.assert_allclose(
        motion.head.removed(take.positions[:, : len(POINTS)]), motion.neutral + motion.displacements, atol=1e-9
    )


def test_rigid_markers_are_found_off_the_acting_points() -> None:
    take, values = acted(np.random.default_rng(7))
    stream, report = marker_faps(take, replace(WHOLE_MAP, rigid=()))
    assert report["head"]["found"]
    assert set(report["head"]["rigid"]) <= {*WHOLE_MAP.rigid, *(f"m{p}" for p in ("11.1", "11.2", "11.3"))} | {
        f"m{p}" for p in ("2.13", "2.14", "3.7", "3.8", "3.11", "3.12", "9.12", "9.15")
    }
    np.testing.assert_allclose(stream.values, values, atol=0.5)


def test_what_is_not_marked_is_not_used() -> None:
    take, _ = acted(np.random.default_rng(8))
    without = {marker: point for marker, point in WHOLE_MAP.points.items() if point not in ("4.1", "8.3")}
    stream, report = marker_faps(take, replace(WHOLE_MAP, points=without))
    for name in ("raise_l_i_eyebrow", "squeeze_l_eyebrow", "stretch_l_cornerlip_o", "raise_l_cornerlip_o"):
        assert not stream.used[:, column(name)].any()
        assert not stream.values[:, column(name)].any()
        assert name not in report["faps"]
    assert stream.used[:, column("raise_r_i_eyebrow")].all()


def test_inner_lips_follow_the_outer_ones() -> None:
    _, values = acted(np.random.default_rng(15))
    values[:, 50:60] = 0
    opening = np.random.default_rng(15).uniform(0, 300, (len(values), 10))
    opening[0] = 0
    values[:, [50, 51, 54, 55, 56, 57]] = -opening[:, :6]
    values[:, [52, 53, 58, 59]] = opening[:, 6:]
    outer_only = {marker: point for marker, point in WHOLE_MAP.points.items() if point not in OUTER}
    stream, report = marker_faps(replayed(values, np.zeros((len(values), 3))), replace(WHOLE_MAP, points=outer_only))
    assert report["followed"] == OUTER
    for inner, outer in zip((4, 5, 6, 7, 8, 9, 10, 11, 12, 13), range(51, 61), strict=True):
        assert stream.used[:, inner - 1].all()
        np.testing.assert_allclose(stream.values[:, inner - 1], values[:, outer - 1], atol=0.5)


def test_pressed_lips_do_not_cross() -> None:
    take, _ = acted(np.random.default_rng(16))
    outer_only = {marker: point for marker, point in WHOLE_MAP.points.items() if point not in OUTER}
    motion = marker_displacements(take, replace(WHOLE_MAP, points=outer_only))
    up = head_axes(motion.names, motion.neutral)[1]
    full, _ = with_inner_lips(motion, up)
    height = {name: full.displacements[:, row] @ up for row, name in enumerate(full.names)}
    for upper, lower in (("2.2", "2.3"), ("2.6", "2.8"), ("2.7", "2.9")):
        outer_gap = height[OUTER[upper]] - height[OUTER[lower]]
        np.testing.assert_allclose(height[upper] - height[lower], np.maximum(outer_gap, 0), atol=1e-9)
        middle = (height[upper] + height[lower]) / 2
        np.testing.assert_allclose(middle, (height[OUTER[upper]] + height[OUTER[lower]]) / 2, atol=1e-9)
    assert with_inner_lips(full, up)[1] == {}


def test_the_inner_lip_does_not_swing_back_where_the_chin_cannot(shared_data: Path) -> None:
    take, marker_map = real_take(shared_data, "jaw")
    stream, _ = marker_faps(take, marker_map)
    wide = stream.values[:, column("open_jaw")] > 800
    assert np.abs(stream.values[wide, column("push_b_lip")]).max() < 200
    motion = marker_displacements(take, marker_map)
    forward = head_axes(motion.names, motion.neutral)[2]
    lip = motion.displacements[:, motion.names.index("8.2")] @ forward
    assert (lip[wide] < -0.7).all()  # centimetres


def test_free_points_do_not_count_and_ride_along() -> None:
    take, values = acted(np.random.default_rng(9))
    named = {marker: "freckle" if point == "5.1" else point for marker, point in WHOLE_MAP.points.items()}
    stream, _ = marker_faps(take, replace(WHOLE_MAP, points=named))
    unused = column("puff_l_cheek")
    assert not stream.used[:, unused].any()
    np.testing.assert_allclose(np.delete(stream.values, unused, 1), np.delete(values, unused, 1), atol=0.5)
    assert "freckle" in marker_displacements(take, replace(WHOLE_MAP, points=named)).names


def test_one_way_faps_are_held_at_zero_and_it_is_said() -> None:
    take, values = acted(np.random.default_rng(10))
    chin, turns = POINTS.index("2.1"), rotation_of_angles(values[:, HEAD], AXES)
    positions = take.positions.copy()
    positions[5:8, chin] += 30 * turns[5:8] @ AXES[1]
    stream, report = marker_faps(replace(take, positions=positions), WHOLE_MAP)
    assert (stream.values[:, column("open_jaw")] >= 0).all()
    assert report["clamped"].keys() == {"open_jaw"}
    assert report["clamped"]["open_jaw"]["frames"] == 3
    assert report["clamped"]["open_jaw"]["lowest"] < -500


def test_gains_multiply() -> None:
    take, values = acted(np.random.default_rng(11))
    stream, _ = marker_faps(take, replace(WHOLE_MAP, gains={19: 2.5}))
    values[:, 18] *= 2.5
    np.testing.assert_allclose(stream.values, values, atol=1)


def test_a_real_take_opens_the_jaw(shared_data: Path) -> None:
    take, marker_map = real_take(shared_data, "jaw")
    stream, report = marker_faps(take, marker_map)
    jaw, lip = stream.values[:, column("open_jaw")], stream.values[:, column("raise_b_midlip_o")]
    assert jaw.max() > 1000
    assert np.corrcoef(jaw, lip)[0, 1] < -0.95
    for left, right in (("raise_b_lip_lm_o", "raise_b_lip_rm_o"), ("raise_l_cornerlip_o", "raise_r_cornerlip_o")):
        assert np.corrcoef(stream.values[:, column(left)], stream.values[:, column(right)])[0, 1] > 0.8
    assert {"ForeHead_L", "ForeHead_R"} <= set(report["head"]["rigid"])
    assert report["head"]["residual"] < 0.06
    assert np.abs(report["head"]["degrees"]["yaw"]).max() < 5
    assert json.loads(json.dumps(report)) == report


def test_a_real_take_lifts_both_cheeks(shared_data: Path) -> None:
    take, marker_map = real_take(shared_data, "cheeks")
    stream, report = marker_faps(take, marker_map)
    for left, right in (("lift_l_cheek", "lift_r_cheek"), ("close_b_l_eyelid", "close_b_r_eyelid")):
        pair = stream.values[:, [column(left), column(right)]]
        assert pair.max(axis=0).min() > 200
        assert np.corrcoef(pair.T)[0, 1] > 0.8
    assert "sit beside the lids' edges" in report["warnings"][0]
    assert not marker_faps(take, replace(marker_map, gains={19: 9.0, 20: 9.0}))[1]["warnings"]


def test_swapped_sides_are_noticed(shared_data: Path) -> None:
    swapped = {marker: FDPS[point].partner for marker, point in WHOLE_MAP.points.items()}
    with pytest.raises(RetargetError, match="left and right seem to be swapped"):
        marker_faps(acted(np.random.default_rng(14))[0], replace(WHOLE_MAP, points=swapped))
    take, marker_map = real_take(shared_data, "jaw")
    swapped = {marker: FDPS[point].partner for marker, point in marker_map.points.items() if point in FDPS}
    with pytest.raises(RetargetError, match="left and right seem to be swapped"):
        marker_faps(take, MarkerMap(swapped))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"points": {"m2.1": "2.1", "m8.3": "2.1"}}, "more than one sits on 2.1"),
        ({"points": {"nobody": "2.1"}}, "'nobody' are not in the take 'acted'"),
        ({"points": {"m2.1": "2.1"}}, "no left and right MPEG-4 points"),
        ({"points": {"m2.1": "freckle"}}, "no left and right MPEG-4 points"),
        ({"rigid": ("band0", "brow", "band2")}, "'brow' are not in the take"),
        ({"neutral_frames": (41, 41)}, "neutral frames are 41 to 41, expected frames from 1 to 40"),
        ({"neutral_frames": (3, 2)}, "neutral frames are 3 to 2"),
        ({"gains": {19: np.nan}}, "FAP 19 has the gain nan"),
        ({"gains": {65: 2.0}}, "FAP 65 has the gain 2.0"),
        ({"gains": {0: 2.0}}, "FAP 0 has the gain 2.0"),
    ],
)
def test_a_wrong_map_is_refused(changes: dict[str, object], message: str) -> None:
    take, _ = acted(np.random.default_rng(12))
    with pytest.raises(RetargetError, match=message):
        marker_faps(take, replace(WHOLE_MAP, **changes))


def test_a_gap_is_refused_and_one_of_a_rigid_marker_is_not() -> None:
    take, values = acted(np.random.default_rng(13))
    take.positions[7, -1] = np.nan
    np.testing.assert_allclose(marker_faps(take, WHOLE_MAP)[0].values, values, atol=0.5)
    take.positions[9, 0] = np.nan
    with pytest.raises(RetargetError, match=f"'m{POINTS[0]}' is not seen in frame 10"):
        marker_faps(take, WHOLE_MAP)
