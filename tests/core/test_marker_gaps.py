"""Gaps in takes of markers."""

import json
from dataclasses import replace

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.markers.gaps import fill_gaps
from facial_retarget_addon.core.markers.take import MarkerTake


def swinging(frames: int = 60) -> MarkerTake:
    time = np.arange(frames) / 60
    places = np.stack([np.sin(5 * time + k)[:, None] * [3.0, -1, 2] for k in range(4)], axis=1)
    return MarkerTake("swing", 60.0, ("a", "b", "c", "d"), places)


def with_gaps(take: MarkerTake, *gaps: tuple[int, slice]) -> MarkerTake:
    places = take.positions.copy()
    for marker, frames in gaps:
        places[frames, marker] = np.nan
    return replace(take, positions=places)


def test_a_whole_take_stays_as_it_is() -> None:
    filled, report = fill_gaps(swinging(), "refuse")
    np.testing.assert_array_equal(filled.positions, swinging().positions)
    assert report["gaps"] == 0
    json.dumps(report)


def test_gaps_are_filled_smoothly_and_counted() -> None:
    take = swinging()
    filled, report = fill_gaps(with_gaps(take, (1, slice(10, 16)), (1, slice(30, 31)), (3, slice(20, 24))))
    np.testing.assert_allclose(filled.positions, take.positions, atol=0.05)
    np.testing.assert_array_equal(filled.positions[:, [0, 2]], take.positions[:, [0, 2]])
    assert json.loads(json.dumps(report)) == {
        "gaps": 3,
        "frames": 11,
        "longest": 0.1,
        "longest_marker": "b",
        "markers": {"b": 2, "d": 1},
    }


def test_a_curve_never_swings_beyond_the_seen_places() -> None:
    places = np.zeros((20, 1, 3))
    places[10:] = 1
    filled, _ = fill_gaps(with_gaps(MarkerTake("step", 60.0, ("a",), places), (0, slice(8, 13))))
    assert filled.positions.min() == 0
    assert filled.positions.max() == 1
    assert (np.diff(filled.positions[:, 0, 0]) >= 0).all()


def test_ends_are_held() -> None:
    take = swinging()
    filled, report = fill_gaps(with_gaps(take, (0, slice(0, 5)), (2, slice(50, 60))))
    np.testing.assert_array_equal(filled.positions[:5, 0], np.tile(take.positions[5, 0], (5, 1)))
    np.testing.assert_array_equal(filled.positions[50:, 2], np.tile(take.positions[49, 2], (10, 1)))
    assert report["gaps"] == 2


def test_a_marker_seen_once_keeps_still() -> None:
    take = swinging(20)
    filled, _ = fill_gaps(with_gaps(take, (0, slice(0, 7)), (0, slice(8, 20))))
    np.testing.assert_array_equal(filled.positions[:, 0], np.tile(take.positions[7, 0], (20, 1)))


@pytest.mark.parametrize(
    ("gap", "settings", "message"),
    [
        ((1, slice(None)), {}, "'b' are never seen in 60 frames"),
        ((1, slice(10, 50)), {}, r"'b' is hidden for 0.667 s from frame 11, expected gaps of at most 0.5 s"),
        ((2, slice(5, 6)), {"how": "refuse"}, "have 1 gaps, expected none: marker 'c'"),
        ((2, slice(5, 6)), {"how": "guess"}, "gaps shall be 'guess'"),
    ],
)
def test_what_cannot_be_filled_is_refused(gap: tuple[int, slice], settings: dict[str, str], message: str) -> None:
    with pytest.raises(RetargetError, match=message):
        fill_gaps(with_gaps(swinging(), gap), **settings)


def test_markers_can_be_picked_by_name() -> None:
    take = swinging().subset(["d", "b", "d"])
    assert take.names == ("d", "b")
    np.testing.assert_array_equal(take.positions, swinging().positions[:, [3, 1]])
    with pytest.raises(RetargetError, match="'x', 'y' are not in the take 'swing'"):
        take.subset(["b", "x", "y"])
