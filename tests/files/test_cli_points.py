"""facial-retarget points: the feature points that a face lacks, proposed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.cli import main
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.problem import Face
from facial_retarget_addon.files.mesh_file import MeshFile
from facial_retarget_addon.files.meshes import write_mesh
from facial_retarget_addon.files.points import read_points, write_points

FIVE = ("3.7", "3.12", "9.3", "2.1", "8.3")


@pytest.fixture(scope="module")
def child() -> Face:
    return demo.child().face


@pytest.fixture
def neutral(child: Face, tmp_path: Path) -> Path:
    write_mesh(MeshFile.from_mesh(child.mesh), tmp_path / "child.obj")
    return tmp_path / "child.obj"


def points(*arguments: object) -> int:
    return main(["points", *map(str, arguments)])


def test_five_points_become_a_set(
    child: Face, neutral: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_points(child.points.subset(FIVE), tmp_path / "five.json")
    assert (
        points("--face", neutral, "--points", tmp_path / "five.json", "--set", "fmc", "--out", tmp_path / "all.json")
        == 0
    )
    found = read_points(tmp_path / "all.json", child.mesh)
    assert len(found) == 48
    np.testing.assert_array_equal(found.subset(FIVE).vertices, child.points.subset(FIVE).vertices)
    assert "43 points proposed" in capsys.readouterr().out


def test_no_points_are_a_guess(child: Face, neutral: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert points("--face", neutral, "--out", tmp_path / "all.json") == 0
    assert len(read_points(tmp_path / "all.json", child.mesh)) == 124
    assert "guessed from the mesh alone" in capsys.readouterr().out


def test_doubtful_points_are_a_warning(
    child: Face, neutral: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    known = child.points.subset([*FIVE, "8.4", "8.1", "8.2"])
    swap = {"8.3": "8.4", "8.4": "8.3"}
    wrong = child.points.subset([swap.get(name, name) for name in known.names])
    write_points(FeaturePoints(known.names, wrong.vertices, wrong.weights), tmp_path / "some.json")
    assert points("--face", neutral, "--points", tmp_path / "some.json", "--out", tmp_path / "all.json") == 0
    error = capsys.readouterr().err
    assert "points 8.3, 8.4 lie" in error or "points 8.4, 8.3 lie" in error


def test_an_input_is_never_overwritten(
    child: Face, neutral: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_points(child.points.subset(FIVE), tmp_path / "five.json")
    before = (tmp_path / "five.json").read_bytes()
    assert points("--face", neutral, "--points", tmp_path / "five.json", "--out", tmp_path / "five.json") == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert (tmp_path / "five.json").read_bytes() == before
