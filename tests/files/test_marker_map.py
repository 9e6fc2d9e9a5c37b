"""Marker maps on disk."""

import json
from pathlib import Path
from typing import Any

import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.markers.assignment import MarkerMap
from facial_retarget_addon.files.motion.marker_map import read_marker_map, write_marker_map

WHOLE: dict[str, Any] = {
    "format": "facial-retarget/marker-map",
    "version": 1,
    "markers": {"ForeHead_M": "11.1", "Mouth_Lend": "8.3", "Kinn": "2.1"},
    "rigid": ["ForeHead_M", "ForeHead_L", "ForeHead_R"],
    "neutral_frame": 12,
}


def saved(folder: Path, document: object) -> Path:
    path = folder / "map.json"
    path.write_text(document if isinstance(document, str) else json.dumps(document), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    "marker_map",
    [
        MarkerMap({"a": "2.1", "b": "glabella", "ç": "8.3"}, ("a", "b", "c"), (4, 9), {19: 9.5, 20: -2.0}),
        MarkerMap({"a": "2.1"}),
        MarkerMap({}, neutral_frames=(3, 3)),
    ],
)
def test_a_map_is_read_as_it_was_written(tmp_path: Path, marker_map: MarkerMap) -> None:
    write_marker_map(marker_map, tmp_path / "map.json")
    assert read_marker_map(tmp_path / "map.json") == marker_map


def test_a_map_by_hand_is_read(tmp_path: Path) -> None:
    expected = MarkerMap(WHOLE["markers"], tuple(WHOLE["rigid"]), (12, 12))
    assert read_marker_map(saved(tmp_path, WHOLE)) == expected
    short = {key: WHOLE[key] for key in ("format", "version", "markers")}
    assert read_marker_map(saved(tmp_path, short)) == MarkerMap(WHOLE["markers"])


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"format": "facial-retarget/feature-points"}, "format = 'facial-retarget/feature-points', expected"),
        ({"version": 2}, "version = 2, expected 1"),
        ({"markers": ["a"]}, r"markers = \['a'\], expected a table"),
        ({"markers": {"a": 2.1}}, "'a' sits on 2.1, expected the name"),
        ({"markers": {"a": " "}}, "'a' sits on ' '"),
        ({"markers": {"a": "2.1", "b": "2.1"}}, "'a' and 'b' both sit on '2.1'"),
        ({"rigid": "a"}, "rigid = 'a', expected a list"),
        ({"rigid": ["a", 1, "b"]}, "rigid = .* expected names of markers"),
        ({"rigid": ["a", ["a"], "b"]}, "rigid = .* expected names of markers"),
        ({"rigid": ["a", "b", "a"]}, "rigid = .* each once"),
        ({"rigid": ["a", "b"]}, "names 2 markers, expected at least 3"),
        ({"neutral_frame": 0}, "neutral_frame = 0"),
        ({"neutral_frame": True}, "neutral_frame = True, expected a whole number"),
        ({"neutral_last_frame": 11}, "neutral_frame = 12 and neutral_last_frame = 11"),
        ({"gains": {"close_lid": 2}}, "gains has 'close_lid', expected the name of a FAP"),
        ({"gains": {"open_jaw": "2"}}, "gain of 'open_jaw' is '2'"),
        ({"gains": {"open_jaw": 10**400}}, "gain of 'open_jaw' is 1000"),
        ({"neutral": 1}, "neutral is unknown, expected one of"),
    ],
)
def test_what_is_wrong_is_said_in_one_sentence(tmp_path: Path, changes: dict[str, Any], message: str) -> None:
    path = saved(tmp_path, WHOLE | changes)
    with pytest.raises(RetargetError, match=message) as error:
        read_marker_map(path)
    assert str(error.value).startswith(f"{path}: ")
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("text", ["", "[1, 2]", '{"format": "facial', "\x00\x01", '{"markers": {"a": "1", "a": "2"}}'])
def test_what_is_no_map_is_refused(tmp_path: Path, text: str) -> None:
    with pytest.raises(RetargetError, match=r"map\.json"):
        read_marker_map(saved(tmp_path, text))


def test_a_map_that_is_not_there_is_said(tmp_path: Path) -> None:
    with pytest.raises(RetargetError, match="cannot be read"):
        read_marker_map(tmp_path / "none.json")
