"""Doubtful points: in one place with another, or on the wrong side of their partner."""

import numpy as np
import pytest

from facial_retarget_addon.core.doubts import doubts
from facial_retarget_addon.core.point_sets import POINT_INFOS, POINT_SETS

NAMES = [info.name for info in POINT_SETS["FMC"]]


def diagram(names: list[str]) -> np.ndarray:
    """(P, 3) places of points on the diagram, bent around a head."""
    flat = np.array([POINT_INFOS[name].diagram for name in names])
    return np.column_stack([flat, -0.4 * (flat**2).sum(axis=1)])


def turned(places: np.ndarray) -> np.ndarray:
    """The same in another place, size and direction."""
    angle = 2.0
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    return 40 * places @ turn.T + [3, 4, 5]


@pytest.mark.parametrize("place", [np.asarray, turned], ids=["upright", "turned"])
def test_a_sound_face_has_no_doubts(place) -> None:
    assert doubts(NAMES, place(diagram(NAMES))) == {}


def test_a_face_without_points_has_none() -> None:
    assert doubts([], np.empty((0, 3))) == {}


def test_points_in_one_place_are_both_doubtful() -> None:
    places = turned(diagram(NAMES))
    places[NAMES.index("8.3")] = places[NAMES.index("2.4")]
    found = doubts(NAMES, places)
    assert set(found) == {"8.3", "2.4"}
    assert found["8.3"] == "in the same place as Left Mouth Corner Inside"


def test_a_pair_that_has_changed_sides_is_doubtful() -> None:
    places = turned(diagram(NAMES))
    rows = [NAMES.index("3.7"), NAMES.index("3.12")]
    places[rows] = places[rows[::-1]]
    found = doubts(NAMES, places)
    assert set(found) == {"3.7", "3.12"}
    assert found["3.7"] == "on the wrong side of Right Outer Eye Corner"


def test_two_pairs_do_not_tell_which_side_is_left() -> None:
    names = ["3.7", "3.12", "8.3", "8.4"]
    assert doubts(names, diagram(names)[[1, 0, 2, 3]]) == {}
