"""facial-retarget morph: a generic head made into another by its points alone."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.cli import main
from facial_retarget_addon.files.mesh_file import MeshFile
from facial_retarget_addon.files.meshes import read_mesh, write_mesh
from facial_retarget_addon.files.points import read_points, write_points

from .conftest import FaceOnDisk


@pytest.fixture
def other(tmp_path: Path) -> tuple[Path, Path]:
    face = demo.targets()[1].face
    write_mesh(MeshFile.from_mesh(face.mesh), tmp_path / "other.ply")
    write_points(face.points, tmp_path / "other.json")
    return tmp_path / "other.ply", tmp_path / "other.json"


def morph(face: FaceOnDisk, other: tuple[Path, Path], out: Path) -> int:
    return main(
        [
            "morph",
            *map(str, face.arguments),
            "--to-face",
            str(other[0]),
            "--to-points",
            str(other[1]),
            "--out",
            str(out),
            "--quiet",
        ]
    )


def test_the_heads_points_arrive_and_its_topology_stays(
    face: FaceOnDisk, other: tuple[Path, Path], tmp_path: Path
) -> None:
    assert morph(face, other, tmp_path / "out.obj") == 0
    generic, found, goal = read_mesh(face.neutral), read_mesh(tmp_path / "out.obj"), read_mesh(other[0])
    np.testing.assert_array_equal(found.corners, generic.corners)
    ours, theirs = read_points(face.points, found.mesh), read_points(other[1], goal.mesh)
    there = theirs.subset(ours.names).positions(goal.mesh.vertices)
    assert np.abs(ours.positions(found.mesh.vertices) - there).max() < 1e-3 * goal.mesh.size


def test_an_input_is_never_overwritten(
    face: FaceOnDisk, other: tuple[Path, Path], capsys: pytest.CaptureFixture[str]
) -> None:
    before = other[0].read_bytes()
    assert morph(face, other, other[0]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert other[0].read_bytes() == before


def test_points_without_common_names_are_one_sentence(
    face: FaceOnDisk, other: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other[1].write_text(other[1].read_text().replace('": {', '_else": {').replace('"points_else"', '"points"'))
    assert morph(face, other, tmp_path / "out.obj") == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "expected at least 4" in error
    assert not (tmp_path / "out.obj").exists()
