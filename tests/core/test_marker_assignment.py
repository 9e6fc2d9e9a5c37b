"""Markers find their feature points by name and by place."""

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.markers.assignment import UNMARKABLE, by_name, by_position
from facial_retarget_addon.core.mpeg4.fdps import FDPS
from facial_retarget_addon.core.mpeg4.mean_face import MEAN_FACE

ANIMFACE = """
ForeHead_M 11.1, ForeHead_L 11.3, ForeHead_R 11.2, Leyebrow_M 4.3, Leyebrow_Inside 4.1, Leyebrow_Outside 4.5,
Eyebrow_Center glabella, Reyebrow_M 4.4, Reyebrow_Inside 4.2, Reyebrow_Outside 4.6, NoseTop nose_bridge, NoseHead 9.3,
NoseHead_L 9.1, NoseHead_R 9.2, Leye_Up 3.1, Leye_Down 3.3, Leye_Inside 3.11, Leye_Outside 3.7, Reye_Up 3.2,
Reye_Down 3.4, Reye_Inside 3.8, Reye_Outside 3.12, Lcheek_Up 5.3, Lcheek_Down 5.1, Lcheek_Outside -, Rcheek_up 5.4,
Rcheek_Down 5.2, Rcheek_Outside -, Mouth_Up 8.1, Mouth_Down 8.2, Mouth_UpL1 8.5, Mouth_Lend 8.3, Mouth_UpR1 8.6,
Mouth_Rend 8.4, Mouth_DownL 8.7, Mouth_DownR 8.8, Chin 2.1, Chin_R1 2.12, Chin_R2 -, Chin_L1 2.11, Chin_L2 -
"""
"""Marker and point of a real take; - where the name does not say."""


def test_the_names_of_a_real_take_are_understood() -> None:
    meant = dict(pair.split() for pair in ANIMFACE.split(","))
    found = by_name(meant)
    assert found.points == {marker: point for marker, point in meant.items() if point != "-"}
    assert found.unknown == tuple(marker for marker, point in meant.items() if point == "-")
    assert not found.doubtful


@pytest.mark.parametrize(
    ("name", "point"),
    [
        ("2.1", "2.1"),
        ("fdp_2_1", "2.1"),
        ("FDP2.10", "2.10"),
        ("Anna:fp 8-3", "8.3"),
        ("LBRO", "4.3"),
        ("RBRO", "4.4"),
        ("RMTH", "8.4"),
        ("Actor1:LMTH", "8.3"),
        ("CHIN", "2.1"),
        ("LeftMouthCorner", "8.3"),
        ("r_mouth_corner", "8.4"),
        ("UpperLip", "8.1"),
        ("LowerLip_R", "8.8"),
        ("BrowInnerLeft", "4.1"),
        ("right eyebrow outer", "4.6"),
        ("L_Upper_Lid", "3.1"),
        ("Right_Cheek", "5.2"),
        ("nostril.L", "9.1"),
        ("Nose-Bridge", "nose_bridge"),
        ("snout", "snout"),
    ],
)
def test_common_names_are_understood(name: str, point: str) -> None:
    assert by_name([name], points=("snout",)).points == {name: point}


@pytest.mark.parametrize(
    "name",
    [
        "",
        "*12",
        "LFHD",
        "LBRO2",
        "8_4",
        "8.44",
        "fdp_12_1",
        "lip",
        "L",
        "LLIP",
        "Chin_L2",
        "hand_L",
        "Left_Right_Eye_Up",
    ]
    + ["snout", "l" * 5000, "MouthUpUp", "1.1"],
)
def test_what_is_not_understood_is_not_guessed(name: str) -> None:
    found = by_name([name])
    assert not found.points
    assert found.unknown == (name,)


def test_two_markers_for_one_point_are_reported_and_not_assigned() -> None:
    found = by_name(["CHIN", "2.1", "LMTH"])
    assert found.points == {"LMTH": "8.3"}
    assert found.doubtful == {"2.1": ("CHIN", "2.1")}


def test_sides_are_mirror_images() -> None:
    for words in ("brow_inner", "brow_outer", "eye_up", "eye_outer", "mouth", "mouth_up", "cheek", "chin", "nostril"):
        left, right = (by_name([f"{words}_{side}"]).points[f"{words}_{side}"] for side in "LR")
        assert FDPS[left].partner == right != left


def other_face(rng: np.random.Generator) -> tuple[list[str], np.ndarray, np.ndarray]:
    """Points of the average face, and markers on the same places of a turned and larger face, a little off."""
    names = [name for name in MEAN_FACE if name not in UNMARKABLE]
    places = np.array([MEAN_FACE[name] for name in names])
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    return names, places, 63 * places @ turn.T + 900 + rng.normal(size=places.shape)


def test_points_are_proposed_by_place() -> None:
    names, places, seen = other_face(np.random.default_rng(3))
    markers = [f"m{k}" for k in range(len(names))]
    known = [names.index(name) for name in ("2.1", "3.7", "3.12", "9.3", "11.1", "8.1")]
    assigned = {markers[k]: names[k] for k in known}
    seen[names.index("5.1")] += 20
    inner = sorted(UNMARKABLE & MEAN_FACE.keys())
    points, on_face = [*names, *inner], np.concatenate([places, [MEAN_FACE[name] for name in inner]])
    proposed = by_position(markers, seen, assigned, points, on_face)
    assert len(proposed) > 20
    assert all(names[markers.index(marker)] == point for marker, point in proposed.items())
    assert not proposed.keys() & assigned.keys()
    assert "5.1" not in proposed.values()
    everything = dict(zip(markers, names, strict=True))
    assert by_position(markers, seen, everything, names, places) == {}


def test_too_few_assigned_markers_propose_nothing() -> None:
    names, places, seen = other_face(np.random.default_rng(4))
    with pytest.raises(RetargetError, match="3 assigned markers"):
        by_position(names, seen, {"2.1": "2.1", "3.7": "3.7", "9.3": "9.3", "x": "4.1"}, names, places)
