"""facial-retarget shapes: the standard's shapes for a face, out of its points alone."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.cli import main
from facial_retarget_addon.core.errors import Cancelled
from facial_retarget_addon.core.mpeg4.sets import SETS
from facial_retarget_addon.files.animation_table import read_table_parameters
from facial_retarget_addon.files.meshes import read_mesh
from facial_retarget_addon.files.mpeg4_face import FapFaceFiles
from facial_retarget_addon.files.shapes_task import ShapesTask, run_shapes_task

from .conftest import FaceOnDisk


def shapes(out: Path, *arguments: object) -> int:
    return main(["shapes", "--out", str(out), "--quiet", *map(str, arguments)])


def test_a_folder_of_shapes_named_as_the_standards(face: FaceOnDisk, tmp_path: Path) -> None:
    report = tmp_path / "r.json"
    sets = ("--set", "expressions", "--set", "visemes")
    assert shapes(tmp_path / "shapes", *face.arguments, *sets, "--report", report) == 0
    written = {path.name for path in (tmp_path / "shapes").iterdir()}
    assert written == {f"{name}.obj" for name in (*SETS["expressions"], *SETS["visemes"])}
    neutral, joy = read_mesh(face.neutral), read_mesh(tmp_path / "shapes" / "joy.obj")
    np.testing.assert_array_equal(joy.corners, neutral.corners)
    np.testing.assert_array_equal(joy.counts, neutral.counts)
    np.testing.assert_allclose(joy.uvs, neutral.uvs)
    assert joy.counts.max() == 4
    corners = face.actor.face.points.subset(["8.3", "8.4"])
    lifted = (corners.positions(joy.mesh.vertices) - corners.positions(neutral.mesh.vertices))[:, 1]
    assert (lifted > 0.02).all()
    said = json.loads(report.read_text())
    assert said["sets"] == ["expressions", "visemes"]
    assert set(said["shapes"]) == {Path(name).stem for name in written}
    assert min(said["shapes"].values()) > 1e-3


def test_one_file_with_an_array_for_each_shape(
    face: FaceOnDisk, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = tmp_path / "p.html"
    assert shapes(tmp_path / "s.npz", *face.arguments, "--set", "expressions", "--page", page) == 0
    with np.load(tmp_path / "s.npz") as found:
        assert set(found.files) == set(SETS["expressions"])
        assert {found[name].shape for name in found.files} == {face.actor.face.mesh.vertices.shape}
    text = page.read_text()
    assert text.count("data:image/png;base64,") == 1 + 6
    assert "<figcaption>surprise</figcaption>" in text
    assert capsys.readouterr().err == ""


def test_shapes_without_points_are_left_out_by_name(
    face: FaceOnDisk, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert shapes(tmp_path / "s.npz", *face.arguments, "--set", "arkit") == 0
    with np.load(tmp_path / "s.npz") as found:
        assert set(SETS["arkit"]) - set(found.files) == {"tongueOut"}
    assert "no points for: tongueOut" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--set", "smiles", "--out", "s.npz"], "set 'smiles' is unknown"),
        (["--set", "faps", "--out", "s.fbx"], "would be a .fbx"),
        (["--set", "faps", "--out", "nowhere/s"], "there is no folder"),
        (["--set", "faps", "--out", "{folder}"], "points lies in out"),
        (["--set", "faps", "--out", "s", "--report", "s/r.json"], "report lies in out"),
        (["--set", "faps", "--out", "taken"], "holds 'notes.txt'"),
        (["--set", "faps", "--out", "s.npz", "--page", "s.npz"], "page and out are one file"),
    ],
)
def test_bad_input_is_one_sentence_and_nothing_is_written(
    arguments: list[str],
    said: str,
    face: FaceOnDisk,
    tmp_path: Path,
    listing: Callable[[], dict[str, bytes]],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "taken").mkdir()
    (tmp_path / "taken" / "notes.txt").write_text("mine")
    before = listing()
    given = [argument.format(folder=face.neutral.parent) for argument in arguments]
    assert main(["--quiet", "shapes", *face.arguments, *given]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1
    assert listing() == before


def test_stopping_leaves_every_file_as_it_was(
    face: FaceOnDisk, tmp_path: Path, listing: Callable[[], dict[str, bytes]]
) -> None:
    def stop(share: float, what: str) -> None:
        if what.startswith("picture 2"):
            raise Cancelled

    files = FapFaceFiles(face.neutral, face.points)
    with pytest.raises(Cancelled):
        run_shapes_task(ShapesTask(files, ("expressions",), tmp_path / "s", page=tmp_path / "p.html"), stop)
    assert listing() == {}


def test_names_are_files_that_every_system_tells_apart() -> None:
    names = [name.lower() for shapes_of in SETS.values() for name in shapes_of]
    assert len(set(names)) == len(names)


def test_a_facial_animation_table(face: FaceOnDisk, tmp_path: Path) -> None:
    assert shapes(tmp_path / "faps.json", *face.arguments, "--set", "faps") == 0
    found, parameters = read_table_parameters(tmp_path / "faps.json", len(face.actor.face.mesh.vertices))
    assert {parameter.kind for parameter in parameters.values()} == {"fap"}
    assert parameters["open_jaw"].key == 3
    assert found.largest().min() > 0
