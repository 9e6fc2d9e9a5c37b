"""A face's axes, units and points: whatever its pose and size, FAPs mean the same."""

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mpeg4.channels import FOLLOWERS, LIDS, PointChannels
from facial_retarget_addon.core.mpeg4.faps import FAPS
from facial_retarget_addon.core.mpeg4.fapu import Fapu, measure_fapu
from facial_retarget_addon.core.mpeg4.fdps import FDPS
from facial_retarget_addon.core.mpeg4.head import LEFT, head_axes
from facial_retarget_addon.core.mpeg4.mean_face import MEAN_FACE, place_missing
from facial_retarget_addon.core.rigid import fit_similarity

Places = dict[str, np.ndarray]


@pytest.fixture(scope="module")
def places() -> Places:
    """The actor's MPEG-4 points."""
    face = demo.actor(vertices=6000).face
    where = zip(face.points.names, face.points.positions(face.mesh.vertices), strict=True)
    return {name: place for name, place in where if name in FDPS}


def rotation(rng: np.random.Generator) -> np.ndarray:
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    return turn * np.sign(np.linalg.det(turn))


def arrays(places: Places) -> tuple[list[str], np.ndarray]:
    return list(places), np.array(list(places.values()))


def without(places: Places, *names: str) -> Places:
    return {name: place for name, place in places.items() if name not in names}


def units(places: Places) -> Fapu:
    return measure_fapu(*arrays(places), head_axes(*arrays(places)))


def channels(places: Places) -> PointChannels:
    names, positions = arrays(places)
    return PointChannels(names, positions, head_axes(names, positions), units(places))


def lengths(fapu: Fapu) -> np.ndarray:
    return np.array([fapu.length(unit) for unit in ("IRISD", "ES", "ENS", "MNS", "MW")])


def realistic(rng: np.random.Generator, frames: int = 50) -> np.ndarray:
    values = rng.uniform(-600, 600, (frames, len(FAPS)))
    one_way = [fap.number - 1 for fap in FAPS if fap.one_way]
    values[:, one_way] = np.abs(values[:, one_way])
    return values


def test_an_upright_head_has_upright_axes(places: Places) -> None:
    axes = head_axes(*arrays(places))
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(axes) > 0
    np.testing.assert_allclose(axes[0], [1, 0, 0], atol=1e-9)
    assert np.degrees(np.arccos(axes[1, 1])) < 3


def test_the_axes_go_with_the_head(places: Places) -> None:
    rng = np.random.default_rng(0)
    names, positions = arrays(places)
    axes = head_axes(names, positions)
    for size in (1e-3, 1.0, 250.0):
        turn = rotation(rng)
        moved = size * positions @ turn.T + rng.normal(size=3) * 10 * size
        np.testing.assert_allclose(head_axes(names, moved), axes @ turn.T, atol=1e-9)


def test_every_left_point_has_its_partner_on_the_right() -> None:
    assert {FDPS[name].partner for name in LEFT} & LEFT == set()
    on_middle = {name for name, point in FDPS.items() if point.partner == name}
    assert LEFT | {FDPS[name].partner for name in LEFT} | on_middle == set(FDPS)
    assert all(MEAN_FACE[name][0] > 0 for name in LEFT if name in MEAN_FACE)


def test_axes_without_chin_or_brows_are_near(places: Places) -> None:
    axes = head_axes(*arrays(places))
    fewer = head_axes(*arrays(without(places, "2.1", "4.3", "4.4")))
    assert np.degrees(np.arccos(np.clip(np.einsum("ij,ij->i", axes, fewer), -1, 1))).max() < 8


def test_axes_need_a_pair(places: Places) -> None:
    middle = {name: place for name, place in places.items() if FDPS[name].partner == name}
    with pytest.raises(RetargetError, match=r"no left and right .* at least one pair such as 8\.3 and 8\.4"):
        head_axes(*arrays(middle))


def test_too_few_points_are_named() -> None:
    with pytest.raises(RetargetError, match=r"2\.1, 4\.3, 4\.4 are missing, and 2 others are too few"):
        head_axes(["8.3", "8.4"], np.array([[0.4, 0, 0], [-0.4, 0, 0]]))


def test_units_are_lengths_of_the_face(places: Places) -> None:
    fapu = units(places)
    assert 0.10 < fapu.irisd / fapu.es < 0.30
    assert 0.6 < fapu.ens / fapu.es < 0.9
    assert 0.25 < fapu.mns / fapu.es < 0.55
    assert 0.6 < fapu.mw / fapu.es < 1.0
    assert fapu.unit("MW") == fapu.mw / 1024
    assert fapu.unit("AU") == 1e-5
    assert fapu.mw == pytest.approx(np.linalg.norm(places["8.3"] - places["8.4"]))


def test_units_are_the_standards_gaps() -> None:
    """A made-up face of points alone, whose gaps are all different."""
    heights = {"3.1": 1.3, "3.3": 1.0, "3.2": 1.4, "3.4": 0.9, "3.5": 1.1, "3.6": 1.2, "9.15": 0.2, "2.2": -0.5}
    across = {"3.5": 0.6, "3.6": -0.7, "8.3": 0.5, "8.4": -0.3}
    names = [*heights, "8.3", "8.4", "2.3"]
    positions = np.array([[across.get(name, 0.0), heights.get(name, -0.6), 0.0] for name in names])
    fapu = measure_fapu(names, positions, np.eye(3))
    np.testing.assert_allclose(lengths(fapu), [0.4, 1.3, 0.95, 0.7, 0.8])
    assert "placed" not in "".join(fapu.taken.values())


def test_units_grow_with_the_face_and_do_not_turn(places: Places) -> None:
    rng = np.random.default_rng(1)
    names, positions = arrays(places)
    moved = 3.5 * positions @ rotation(rng).T + [5, -80, 3]
    np.testing.assert_allclose(lengths(units(dict(zip(names, moved, strict=True)))), 3.5 * lengths(units(places)))


def test_missing_points_are_placed_and_said(places: Places) -> None:
    whole = units(places)
    assert "3.5 taken between 3.7 and 3.11" in whole.taken["ES"]
    assert whole.taken["MW"] == "8.3 to 8.4"
    one_eyed = units(without(places, "3.2", "3.4"))
    assert one_eyed.taken["IRISD"] == "3.1 to 3.3"
    assert one_eyed.irisd == pytest.approx(whole.irisd, rel=1e-3)
    lacking = units(without(places, "3.7", "9.15", "8.4"))
    assert "3.5 placed by the average face" in lacking.taken["ES"]
    assert "9.15 placed by the average face" in lacking.taken["MNS"]
    assert "8.4 placed by the average face" in lacking.taken["MW"]
    np.testing.assert_allclose(lengths(lacking), lengths(whole), rtol=0.25)


def test_given_pupils_count(places: Places) -> None:
    left, right = (np.mean([places[a], places[b]], axis=0) for a, b in (("3.7", "3.11"), ("3.8", "3.12")))
    given = units(places | {"3.5": left + [0.05, 0, 0], "3.6": right})
    assert given.taken["ES"] == "3.5 to 3.6"
    assert given.es == pytest.approx(units(places).es + 0.05)


def test_closed_eyes_are_no_neutral(places: Places) -> None:
    shut = places | {"3.1": places["3.3"], "3.2": places["3.4"]}
    with pytest.raises(RetargetError, match=r"the unit IRISD of the neutral face is 0 .* eyes open"):
        units(shut)


def test_crossed_sides_give_one_sentence(places: Places) -> None:
    crossed = places | {"8.3": places["8.4"], "8.4": places["8.3"]}
    with pytest.raises(RetargetError, match=r"the unit MW .* left points on the subject's left"):
        units(crossed)


def test_an_upper_lip_above_the_nose_gives_one_sentence(places: Places) -> None:
    with pytest.raises(RetargetError, match="the unit MNS of the neutral face is -"):
        units(places | {"9.15": places["2.1"]})


def test_placed_points_lie_where_the_average_face_has_them() -> None:
    rng = np.random.default_rng(2)
    turn, names = rotation(rng), list(MEAN_FACE)
    where = 7 * np.array(list(MEAN_FACE.values())) @ turn.T + [1, 2, 3]
    kept = [name for name in names if name not in ("2.1", "9.3", "4.1")]
    found = place_missing(kept, where[[names.index(name) for name in kept]], ["2.1", "9.3", "4.1", "8.3"])
    for name, place in found.items():
        np.testing.assert_allclose(place, where[names.index(name)], atol=1e-9)


def test_the_actor_looks_like_the_average_face(places: Places) -> None:
    names = [name for name in places if name in MEAN_FACE]
    average, own = (np.array([table[name] for name in names]) for table in (MEAN_FACE, places))
    off = np.linalg.norm(fit_similarity(average, own).apply(average) - own, axis=1)
    assert np.median(off) < 0.15 * units(places).es


def test_given_points_are_left_where_they_are(places: Places) -> None:
    found = place_missing(*arrays(places), ["2.1", "8.3"])
    np.testing.assert_array_equal(found["2.1"], places["2.1"])
    np.testing.assert_array_equal(found["8.3"], places["8.3"])


def test_each_fap_moves_its_point_by_its_unit_in_its_direction(places: Places) -> None:
    motion, fapu = channels(places), units(places)
    moved = motion.displacements(1024 * np.eye(len(FAPS))) @ motion.axes.T
    for fap in FAPS[2:]:
        if fap.kind != "translation" or fap.points[0] not in places or fap.points[0] in LIDS:
            continue
        row = motion.names.index(fap.points[0])
        expected = np.zeros(3)
        expected[fap.axis] = fap.sign * fapu.length(fap.unit)
        np.testing.assert_allclose(moved[fap.number - 1, row], expected, atol=1e-12, err_msg=fap.name)
        others = {fap.points[0], *FOLLOWERS.get(fap.number, {})}
        others |= {name for name in motion.names if FDPS[name].rides_on == fap.points[0]}
        still = [k for k, name in enumerate(motion.names) if name not in others]
        assert not moved[fap.number - 1, still].any(), fap.name


def test_1024_leads_a_lid_exactly_to_the_other(places: Places) -> None:
    motion = channels(places)
    for number, name in ((19, "3.1"), (20, "3.2"), (21, "3.3"), (22, "3.4")):
        values = np.zeros((1, len(FAPS)))
        values[0, number - 1] = 1024
        moved = motion.displacements(values)[0, motion.names.index(name)]
        np.testing.assert_allclose(places[name] + moved, places[LIDS[name]], atol=1e-12)


def test_values_are_read_back_off_the_points(places: Places) -> None:
    motion = channels(places)
    values = realistic(np.random.default_rng(3)) * motion.measurable
    assert motion.measurable.sum() == 46
    assert not motion.measurable[[0, 1, 47, 48, 49]].any()
    np.testing.assert_allclose(motion.values(motion.displacements(values)), values, atol=1e-8)


def test_a_turned_and_scaled_head_reads_the_same(places: Places) -> None:
    rng = np.random.default_rng(4)
    names, positions = arrays(places)
    turn, size = rotation(rng), 40.0
    other = channels(dict(zip(names, size * positions @ turn.T + [9, 9, 9], strict=True)))
    motion = channels(places)
    values = realistic(rng) * motion.measurable
    moved = motion.displacements(values)
    np.testing.assert_allclose(other.displacements(values), size * moved @ turn.T, atol=1e-8)
    np.testing.assert_allclose(other.values(size * moved @ turn.T), values, atol=1e-6)


def test_the_chin_goes_with_the_jaw_and_is_read_without_it(places: Places) -> None:
    motion = channels(places)
    values = np.zeros((2, len(FAPS)))
    values[:, 2] = 400
    values[1, 17] = 100
    moved = motion.displacements(values)
    boss, bottom = (motion.names.index(name) for name in ("2.10", "2.1"))
    np.testing.assert_allclose(moved[0, boss], moved[0, bottom])
    assert (moved[1, boss] - moved[1, bottom]) @ motion.axes[1] == pytest.approx(100 * units(places).unit("MNS"))
    np.testing.assert_allclose(motion.values(moved)[:, [2, 17]], values[:, [2, 17]], atol=1e-9)


def test_a_tongue_moves_and_rolls(places: Places) -> None:
    mouth = 0.5 * (places["2.2"] + places["2.3"])
    tongue = {"6.1": [0, 0, -0.1], "6.2": [0, 0, -0.3], "6.3": [0.15, 0, -0.3], "6.4": [-0.15, 0, -0.3]}
    with_tongue = places | {name: mouth + np.array(offset) for name, offset in tongue.items()}
    motion = channels(with_tongue)
    assert not channels(places).measurable[42:47].any()
    assert motion.measurable[42:46].all()
    values = np.zeros((1, len(FAPS)))
    values[0, 46] = 20_000
    moved = motion.displacements(values)[0] @ motion.axes.T
    left, right = (moved[motion.names.index(name)] for name in ("6.3", "6.4"))
    np.testing.assert_allclose([left, right], [[0, 0.2 * 0.15, 0]] * 2, atol=1e-3)


def test_a_point_that_is_not_there_is_not_measured(places: Places) -> None:
    fewer = channels(without(places, "9.3", "5.1"))
    assert not fewer.measurable[[63 - 1, 64 - 1, 39 - 1]].any()
    assert fewer.measurable[40 - 1]
    values = realistic(np.random.default_rng(5))
    found = fewer.values(fewer.displacements(values))
    assert not found[:, ~fewer.measurable].any()
