"""Named parts on disk."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.cli import main
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.parts.kinds import named_vertices
from facial_retarget_addon.files.job import Job, read_job, write_job
from facial_retarget_addon.files.mesh_file import MeshFile
from facial_retarget_addon.files.meshes import write_mesh
from facial_retarget_addon.files.obj import read_obj, read_obj_groups
from facial_retarget_addon.files.parts import read_parts, write_parts
from facial_retarget_addon.files.run import check_job, read_inputs

from .conftest import FaceOnDisk, dome

DOME = dome(7).mesh
PIECES = TriMesh(
    np.concatenate([DOME.vertices, DOME.vertices + 5, DOME.vertices + 9]),
    np.concatenate([DOME.faces + k * len(DOME.vertices) for k in range(3)]),
)


def written(tmp_path: Path, parts: str) -> Path:
    path = tmp_path / "parts.json"
    path.write_text(f'{{"format": "facial-retarget/parts", "version": 1, "parts": {parts}}}')
    return path


def test_writing_and_reading_gives_the_same_parts(tmp_path: Path) -> None:
    named = {"lashes": np.array([60, 140]), "tongue": np.array([3, 4, 5])}
    write_parts(named, PIECES, tmp_path / "parts.json")
    parts = json.loads((tmp_path / "parts.json").read_text())["parts"]
    assert parts == {"lashes": {"vertices": [49, 98]}, "tongue": {"vertices": [0]}}
    again = read_parts(tmp_path / "parts.json", PIECES)
    assert list(again) == list(named)
    for name, vertices in named_vertices(PIECES, named).items():
        np.testing.assert_array_equal(named_vertices(PIECES, again)[name], vertices)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('{"teef": {"vertices": [1]}}', "a part is named 'teef', expected one of left eyeball, right eyeball"),
        ('{"tongue": {"vertices": []}}', "part 'tongue' is at [], expected vertices from 0 to 146"),
        ('{"tongue": {"vertices": [147]}}', "part 'tongue' is at [147], expected vertices from 0 to 146"),
        ('{"tongue": {"vertices": [true]}}', "part 'tongue' is at [True], expected vertices from 0 to 146"),
        ('{"tongue": {"vertex": 3}}', "part 'tongue' vertices is missing, expected a list"),
        ('{"tongue": {"vertices": [3], "side": "left"}}', "part 'tongue' side is unknown"),
        ('{"tongue": 3}', "part 'tongue' is 3, expected a table"),
        ('{"tongue": {"vertices": [3]}, "tongue": {"vertices": [3]}}', "'tongue' appears twice"),
    ],
)
def test_what_is_no_part_is_refused(tmp_path: Path, text: str, expected: str) -> None:
    with pytest.raises(RetargetError) as error:
        read_parts(written(tmp_path, text), PIECES)
    assert expected in str(error.value)
    assert "parts.json" in str(error.value)


def test_another_document_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "parts.json"
    path.write_text('{"format": "facial-retarget/feature-points", "version": 2, "parts": {}}')
    with pytest.raises(RetargetError, match=r"format = .*expected 'facial-retarget/parts'; version = 2, expected 1"):
        read_parts(path, PIECES)


GROUPED = """
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 5
v 1 0 5
v 0 1 5
v 0 0 9
v 1 0 9
v 0 1 9
o the head
usemtl skin
f 1 2 3
g lashes upper
f 4 5 6
usemtl enamel
f 7 8 9
g lashes
f 7 9 8
g empty
"""


def test_groups_of_an_obj_file_are_parts(tmp_path: Path) -> None:
    neutral = tmp_path / "head.obj"
    neutral.write_text(GROUPED)
    groups = {name: vertices.tolist() for name, vertices in read_obj_groups(neutral).items()}
    assert groups == {
        "the head": list(range(9)),
        "lashes": list(range(3, 9)),
        "upper": list(range(3, 9)),
        "empty": [],
        "skin": list(range(6)),
        "enamel": [6, 7, 8],
    }
    mesh = read_obj(neutral).mesh
    parts = written(tmp_path, '{"lower teeth": {"groups": ["enamel"]}, "tongue": {"vertices": [3]}}')
    found = read_parts(parts, mesh, neutral)
    assert {name: vertices.tolist() for name, vertices in found.items()} == {"lower teeth": [6, 7, 8], "tongue": [3]}
    for wanted, expected in (
        ('["gold"]', "part 'tongue' has groups ['gold'], expected some of those with faces: the head, lashes, upper"),
        ('["empty"]', "part 'tongue' has groups ['empty'], expected some"),
        ("[3]", "part 'tongue' has groups [3], expected some"),
        ("[]", "part 'tongue' has groups [], expected some"),
    ):
        with pytest.raises(RetargetError) as error:
            read_parts(written(tmp_path, f'{{"tongue": {{"groups": {wanted}}}}}'), mesh, neutral)
        assert expected in str(error.value)
    with pytest.raises(RetargetError, match=r"groups are those of an .obj file, but the neutral is head\.ply"):
        read_parts(written(tmp_path, '{"tongue": {"groups": ["enamel"]}}'), mesh, tmp_path / "head.ply")


def with_parts(job: Job, parts: str) -> Job:
    """The job on a target with one more piece, which its parts file names."""
    mesh = dome(16, 2.0).mesh
    count = len(mesh.vertices)
    pieces = TriMesh(
        np.concatenate([mesh.vertices, DOME.vertices + 9]), np.concatenate([mesh.faces, DOME.faces + count])
    )
    write_mesh(MeshFile.from_mesh(pieces), job.target.neutral)
    changed = replace(
        job, examples=(), target=replace(job.target, parts=written(job.path.parent, parts % {"piece": count + 5}))
    )
    write_job(changed, job.path)
    return changed


def test_a_job_s_parts_reach_its_faces(job: Job) -> None:
    job = with_parts(job, '{"tongue": {"vertices": [%(piece)d]}}')
    assert read_job(job.path) == job
    assert not check_job(job.path).faults
    problem = read_inputs(read_job(job.path)).problem
    assert dict(problem.source.named_parts) == {}
    assert {name: list(held) for name, held in problem.target.named_parts.items()} == {"tongue": [16 * 16 + 5]}


def test_a_part_on_the_skin_is_a_fault_of_the_job(job: Job) -> None:
    with_parts(job, '{"tongue": {"vertices": [7]}}')
    assert "target: part 'tongue' and the skin are one connected piece" in "; ".join(check_job(job.path).faults)


def test_parts_that_cannot_be_read_are_a_fault_of_the_job(job: Job) -> None:
    with_parts(job, '{"tongue": 3}')
    assert "part 'tongue' is 3, expected a table" in "; ".join(check_job(job.path).faults)


def test_the_command_line_plays_a_face_whose_parts_are_named(
    face: FaceOnDisk, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    mesh = face.actor.face.mesh
    skin = face.actor.face.points.vertices[0, 0]
    eye = int(np.flatnonzero(mesh.components == mesh.components[-1])[0])
    command = ["shapes", *face.arguments, "--set", "expressions", "--out", str(tmp_path / "shapes")]
    assert main([*command, "--parts", str(written(tmp_path, f'{{"tongue": {{"vertices": [{skin}]}}}}'))]) == 2
    assert "parts.json: part 'tongue' and the skin are one connected piece" in capsys.readouterr().err
    report = tmp_path / "report.json"
    named = written(tmp_path, f'{{"still": {{"vertices": [{eye}]}}}}')
    assert main([*command, "--parts", str(named), "--report", str(report)]) == 0
    assert "named still" in report.read_text()
    assert main(["fap", "take.fap", "--parts", str(named), "--out", str(tmp_path / "out.fap")]) == 2
    assert "--parts goes with --face and --points" in capsys.readouterr().err
