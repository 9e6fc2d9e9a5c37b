"""facial-retarget markers: the beginning of a marker map."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.cli import main
from facial_retarget_addon.files.motion.marker_map import read_marker_map

from .conftest import FaceOnDisk

NAMED = {"L_mouth_corner": "8.3", "R_mouth_corner": "8.4", "chin": "2.1", "nose_tip": "9.3", "ForeHead_M": "11.1"}


@pytest.fixture
def take(face: FaceOnDisk, tmp_path: Path) -> Path:
    """Markers on the built-in actor, ten times as large and moved: five with telling names, one without, one astray."""
    points = face.actor.face.points
    where = dict(zip(points.names, points.positions(face.actor.face.mesh.vertices), strict=True))
    places = {name: where[point] for name, point in NAMED.items()} | {"m17": where["5.1"], "m99": np.full(3, 40.0)}
    rows = 10.0 * np.array(list(places.values())) + 3.0
    names = [f"{name}_{axis}" for name in places for axis in "xyz"]
    lines = [",".join(["time", *names])]
    lines += [",".join(map(repr, [frame / 25, *rows.ravel().tolist()])) for frame in range(3)]
    path = tmp_path / "take.csv"
    path.write_text("\n".join(lines) + "\n")
    return path


def markers(take: Path, out: Path, *arguments: str) -> int:
    return main(["markers", str(take), "--out", str(out), *arguments])


def test_names_that_say_a_point_are_taken_and_others_named(
    take: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert markers(take, tmp_path / "map.json") == 0
    assert read_marker_map(tmp_path / "map.json").points == NAMED
    assert "to be added by hand: m17, m99" in capsys.readouterr().err


def test_places_suggest_what_names_do_not_say(
    take: Path, face: FaceOnDisk, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert markers(take, tmp_path / "map.json", *face.arguments) == 0
    assert read_marker_map(tmp_path / "map.json").points == NAMED | {"m17": "5.1"}
    error = capsys.readouterr().err
    assert "m17 is put on 5.1 by its place alone" in error
    assert "by hand: m99" in error


def test_a_take_is_never_overwritten(take: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = take.read_bytes()
    assert markers(take, take) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert take.read_bytes() == before


def test_a_face_without_its_points_is_one_sentence(
    take: Path, face: FaceOnDisk, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert markers(take, tmp_path / "map.json", *face.arguments[:2]) == 2
    assert "--face and --points go together" in capsys.readouterr().err
    assert not (tmp_path / "map.json").exists()
