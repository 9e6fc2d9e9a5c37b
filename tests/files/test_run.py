"""Whole jobs through the command line: what good input makes, and that bad input makes nothing."""

from __future__ import annotations

import builtins
import errno
import io
import json
import re
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.cli import main
from facial_retarget_addon.core.methods.settings import RegionGains
from facial_retarget_addon.files import run
from facial_retarget_addon.files.frames import read_frames, write_frames
from facial_retarget_addon.files.job import MaskFile, write_job
from facial_retarget_addon.files.masks import write_mask
from facial_retarget_addon.files.mesh_file import MeshFile
from facial_retarget_addon.files.meshes import read_mesh, write_mesh

from .conftest import dome

pytestmark = pytest.mark.usefixtures("no_method")


def refused(job, listing, capsys, *expected: str, command: str = "run") -> str:
    """The one line that a command says when it refuses; checks the status, the line, and that no file changed."""
    before = listing()
    assert main([command, str(job.path), "--quiet"]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.count("\n") == 1
    assert "Traceback" not in said.err
    for text in expected:
        assert text in said.err
    assert listing() == before
    return said.err


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


def edit_points(path: Path, change) -> None:
    document = json.loads(path.read_text())
    change(document["points"])
    path.write_text(json.dumps(document))


def change_mesh(path: Path, vertices=None, faces=None) -> None:
    """Write a mesh anew with other vertices or triangles."""
    mesh = read_mesh(path).mesh
    vertices = mesh.vertices if vertices is None else vertices
    lines = ["v {} {} {}".format(*v) for v in vertices.tolist()]
    lines += ["f {} {} {}".format(*(f + 1)) for f in (mesh.faces if faces is None else faces)]
    path.write_text("\n".join(lines))


def test_a_sound_job_writes_frames_report_and_page(job, capsys):
    assert main(["run", str(job.path)]) == 0
    frames = read_frames(job.output.frames, 16 * 16)
    assert frames.shape == (3, 256, 3)
    report = json.loads(job.output.report.read_text())
    assert report["settings"]["levels"] == 2
    assert report["examples"][0]["leave_one_out"] is None
    assert report["warnings"] == ["the stand-in does nothing"]
    page = job.output.page.read_text()
    assert page.count("data:image/png;base64,") == 6
    assert "http" not in page
    said = capsys.readouterr()
    assert "100%" in said.err
    assert "warning: the stand-in does nothing" in said.err
    assert not list(job.path.parent.glob(".*"))


def test_quiet_says_only_warnings(job, capsys):
    assert main(["--quiet", "run", str(job.path)]) == 0
    assert capsys.readouterr().err == "facial-retarget: warning: the stand-in does nothing\n"


def test_check_finds_nothing_in_a_sound_job(job, listing, capsys):
    before = listing()
    assert main(["check", str(job.path)]) == 0
    assert "is fine" in capsys.readouterr().out
    assert listing() == before


def test_check_says_everything_at_once(job, capsys):
    job.source.frames.unlink()
    job.target.points.write_text("{")
    job.examples[0].source.write_text("v 1 2")
    assert main(["check", str(job.path)]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 3
    for name in ("source_frames.npz", "target_points.json", "source_joy.obj"):
        assert sum(name in line for line in lines) == 1


def test_check_looks_at_the_problem_even_when_an_example_is_unreadable(job, capsys):
    job.examples[0].source.unlink()
    edit_points(job.source.points, lambda points: points.pop("p0"))
    for name in [f"p{i}" for i in range(1, 7)]:
        edit_points(job.source.points, lambda points, name=name: points.pop(name))
    assert main(["check", str(job.path)]) == 2
    said = capsys.readouterr().err
    assert "source_joy.obj" in said
    assert "29 feature points in common" in said


@pytest.mark.parametrize(
    "name", ["source.obj", "source_points.json", "source_frames.npz", "target.obj", "target_joy.obj"]
)
def test_a_missing_file(job, listing, capsys, name):
    (job.path.parent / name).unlink()
    refused(job, listing, capsys, name, "No such file")


def test_a_missing_job(tmp_path, capsys):
    assert main(["run", str(tmp_path / "none.toml")]) == 2
    assert "none.toml cannot be read" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["source.obj", "source_points.json", "source_frames.npz", "job.toml"])
def test_an_unreadable_file(job, listing, capsys, name):
    (job.path.parent / name).write_bytes(b"\x00\xff" * 50)
    refused(job, listing, capsys, name)


def test_a_folder_in_place_of_a_file(job, listing, capsys):
    job.source.points.unlink()
    job.source.points.mkdir()
    refused(job, listing, capsys, "source_points.json cannot be read")


@pytest.mark.parametrize("value", ["nan", "inf"])
def test_a_vertex_that_is_not_finite(job, listing, capsys, value):
    text = job.target.neutral.read_text()
    job.target.neutral.write_text(re.sub(r"^v \S+", f"v {value}", text, count=1))
    refused(job, listing, capsys, "target.obj has 1 vertices that are NaN", "vertex 0")


def test_an_example_that_is_not_finite(job, listing, capsys):
    text = job.examples[0].target.read_text()
    job.examples[0].target.write_text(re.sub(r"^v \S+", "v nan", text, count=1))
    refused(job, listing, capsys, "example 'joy' of the target has 1 vertices that are NaN")


def test_a_frame_that_is_not_finite(job, listing, capsys):
    frames = np.array(read_frames(job.source.frames, 21 * 21))
    frames[1, 7, 2] = np.nan
    write_frames(frames, job.source.frames)
    refused(job, listing, capsys, "frame 2 of 3", "vertex 7")


def test_frames_of_another_vertex_count(job, listing, capsys):
    write_frames(np.zeros((3, 20, 3)), job.source.frames)
    refused(job, listing, capsys, "(3, 20, 3)", "(frames, 441, 3)")


def test_a_face_index_out_of_range(job, listing, capsys):
    with open(job.target.neutral, "a") as file:
        file.write("\nf 1 2 9999\n")
    refused(job, listing, capsys, "target.obj", "9999", "256")


def test_an_empty_mesh(job, listing, capsys):
    job.target.neutral.write_text("# nothing\n")
    refused(job, listing, capsys, "target.obj has 0 vertices and 0 faces")


def test_a_mesh_that_is_not_manifold(job, listing, capsys):
    faces = read_mesh(job.target.neutral).mesh.faces
    change_mesh(job.target.neutral, faces=np.concatenate([faces, faces[:10]]))
    refused(job, listing, capsys, "target: ", "edges of more than two faces")


def test_flipped_faces(job, listing, capsys):
    faces = read_mesh(job.target.neutral).mesh.faces.copy()
    faces[10:40] = faces[10:40, ::-1]
    change_mesh(job.target.neutral, faces=faces)
    refused(job, listing, capsys, "target: 30 of 450 faces are flipped")


def test_a_mesh_that_is_inside_out(job, listing, capsys):
    change_mesh(job.source.neutral, faces=read_mesh(job.source.neutral).mesh.faces[:, ::-1])
    refused(job, listing, capsys, "source: the faces look inwards")


def test_faces_without_area(job, listing, capsys):
    mesh = read_mesh(job.target.neutral).mesh
    vertices = mesh.vertices.copy()
    vertices[100:108] = vertices[100]
    change_mesh(job.target.neutral, vertices=vertices)
    refused(job, listing, capsys, "target: ", "faces have no area")


def test_a_point_name_that_is_there_twice(job, listing, capsys):
    edit(job.source.points, '"p1":', '"p0":')
    refused(job, listing, capsys, "'p0' appears twice")


def test_unknown_points_are_told(job, capsys):
    edit_points(job.source.points, lambda points: points.update({"chin": points.pop("p35")}))
    assert main(["check", str(job.path)]) == 0
    said = capsys.readouterr().err
    assert "only the source has are not used: chin" in said
    assert "only the target has are not used: p35" in said


def test_a_point_on_another_component(job, listing, capsys):
    mesh = read_mesh(job.source.neutral).mesh
    eye = mesh.vertices[:4] + [5, 0, 0]
    vertices = np.concatenate([mesh.vertices, eye])
    change_mesh(job.source.neutral, vertices, np.concatenate([mesh.faces, mesh.faces[:0], [[441, 442, 443]]]))
    edit_points(job.source.points, lambda points: points.update({"pupil": {"vertex": 442}}))
    job.source.frames.unlink()
    write_frames(np.stack([vertices, vertices * 1.1, vertices * 1.2]), job.source.frames)
    for example in job.examples:
        text = example.source.read_text().splitlines()
        text.insert(441, "v 0 0 0\nv 0 0 1\nv 0 1 0\nv 1 0 0")
        example.source.write_text("\n".join(text))
    refused(job, listing, capsys, "source: points pupil lie on another part")


def test_too_few_points(job, listing, capsys):
    edit_points(job.source.points, lambda points: [points.pop(f"p{i}") for i in range(10)])
    refused(job, listing, capsys, "26 feature points in common", "at least 30")


def test_a_point_on_a_vertex_that_is_not_there(job, listing, capsys):
    edit_points(job.source.points, lambda points: points.update({"p3": {"vertex": 441}}))
    refused(job, listing, capsys, "source_points.json", "'p3'", "0 to 440")


def test_a_base_over_points_that_are_not_there(job, listing, capsys):
    base = job.path.parent / "base.json"
    base.write_text('{"format": "facial-retarget/base-mesh", "version": 1, "triangles": [["p0", "p1", "chin"]]}')
    write_job(replace(job, base=base), job.path)
    refused(job, listing, capsys, "the source lacks: chin", "the target lacks: chin")


def test_an_example_that_is_missing_on_one_side(job, listing, capsys):
    text = job.path.read_text()
    job.path.write_text(text.replace('source = "source_joy.obj"\n', ""))
    refused(job, listing, capsys, "[[examples]] 1 source is missing")


def test_an_example_of_another_vertex_count(job, listing, capsys):
    write_mesh(dome(9), job.examples[1].target)
    refused(job, listing, capsys, "example 'anger' of the target has shape (81, 3), expected (256, 3)")


def test_identical_examples(job, listing, capsys):
    job.examples[1].source.write_bytes(job.examples[0].source.read_bytes())
    refused(job, listing, capsys, "examples 'joy' and 'anger' are identical on the source")


def test_a_source_that_moves_rigidly(job, listing, capsys):
    neutral = read_mesh(job.source.neutral).mesh.vertices
    turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    write_frames(np.stack([neutral, neutral @ turn.T, neutral + [3, 0, 1]]), job.source.frames)
    refused(job, listing, capsys, "the source moves rigidly")


def test_a_huge_level(job, listing, capsys):
    edit(job.path, "levels = 2", "levels = 30")
    refused(job, listing, capsys, "[settings] levels = 30: expected a whole number from 1 to 6")


def test_a_base_so_large_that_its_levels_are_huge(job, listing, capsys):
    edit(job.path, "levels = 2", "levels = 6")
    many = {f"q{i}": {"vertices": [0, 1, 21], "weights": [1 - i / 2000, i / 2000, 0]} for i in range(1500)}
    edit_points(job.source.points, lambda points: points.update(many))
    edit_points(job.target.points, lambda points: points.update(many))
    refused(job, listing, capsys, "level 6 over a base of 1536 points means about 6,291,456 vertices")


def test_an_output_in_a_folder_that_is_not_there(job, listing, capsys):
    edit(job.path, 'frames = "out.npz"', 'frames = "nowhere/out.npz"')
    refused(job, listing, capsys, "there is no folder")


def test_an_output_of_an_unknown_kind(job, listing, capsys):
    edit(job.path, 'frames = "out.npz"', 'frames = "out.abc"')
    refused(job, listing, capsys, "out.abc", ".npz, .pc2, .mdd")


def test_an_output_over_an_input(job, listing, capsys):
    edit(job.path, 'report = "report.json"', 'report = "source.obj"')
    refused(job, listing, capsys, "[output] report and [source] neutral are one file")


def test_an_output_folder_that_holds_something_else(job, listing, capsys):
    (job.path.parent / "photos").mkdir()
    (job.path.parent / "photos" / "cat.jpg").write_bytes(b"cat")
    edit(job.path, 'frames = "out.npz"', 'frames = "photos"')
    refused(job, listing, capsys, "cat.jpg")


@pytest.mark.parametrize("output", ["out.npz", "out.pc2", "out.mdd", "out_folder"])
def test_a_full_disk(job, listing, capsys, monkeypatch, output):
    edit(job.path, 'frames = "out.npz"', f'frames = "{output}"')
    opened = builtins.open

    class Full(io.FileIO):
        def write(self, content):
            raise OSError(errno.ENOSPC, "No space left on device")

    def open_full(file, mode="r", *args, **kwargs):
        return Full(file, mode.replace("b", "")) if "x" in mode else opened(file, mode, *args, **kwargs)

    monkeypatch.setattr(builtins, "open", open_full)
    refused(job, listing, capsys, f"{output} cannot be written: the disk is full")


def test_a_disk_that_is_full_when_the_page_is_written_leaves_no_frames(job, listing, capsys, monkeypatch):
    def full(path, content):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(run.Path, "write_bytes", full)
    refused(job, listing, capsys, "the disk is full")


@pytest.mark.parametrize("share", [0.0, 0.5, 0.85, 0.87])
def test_ctrl_c_leaves_everything_as_it_was(job, listing, capsys, monkeypatch, share):
    job.output.frames.write_bytes(b"earlier work")
    before = listing()

    def stop(done: float, what: str) -> None:
        if done >= share:
            raise KeyboardInterrupt

    monkeypatch.setattr("facial_retarget_addon.cli._progress", lambda arguments: stop)
    assert main(["run", str(job.path)]) == 130
    assert "stopped" in capsys.readouterr().err
    assert listing() == before


def test_ctrl_c_in_a_process_of_its_own(job, listing):
    before = listing()
    code = (
        "import os, signal, sys\n"
        "from facial_retarget_addon import cli\n"
        "from facial_retarget_addon.files import run\n"
        "run.retarget = lambda *args: os.kill(os.getpid(), signal.SIGINT)\n"
        "sys.exit(cli.main(sys.argv[1:]))\n"
    )
    repository = Path(__file__).resolve().parents[2]
    done = subprocess.run([sys.executable, "-c", code, "run", str(job.path)], capture_output=True, cwd=repository)
    assert done.returncode == 128 + signal.SIGINT
    assert b"Traceback" not in done.stderr
    assert listing() == before


def test_frames_as_a_folder_of_obj_are_meshes_and_replace_older_ones(job):
    edit(job.path, 'frames = "out.npz"', 'frames = "out"')
    for _ in range(2):
        assert main(["run", str(job.path), "--quiet"]) == 0
    files = sorted((job.path.parent / "out").iterdir())
    assert [file.name for file in files] == ["frame_0001.obj", "frame_0002.obj", "frame_0003.obj"]
    written, target = read_mesh(files[0]), read_mesh(job.target.neutral)
    assert isinstance(written, MeshFile)
    np.testing.assert_array_equal(written.corners, target.corners)
    np.testing.assert_allclose(written.mesh.vertices, target.mesh.vertices, atol=1e-6)


def test_a_mask_of_the_job_reaches_the_frames(job, capsys):
    weights = np.where(np.arange(256) < 100, 1.0, 0.0)
    write_mask(weights, job.path.with_name("mask.npz"))
    write_job(replace(job, masks=(MaskFile("scar", job.path.with_name("mask.npz"), 0.5),)), job.path)
    assert main(["run", str(job.path)]) == 0
    assert json.loads(job.output.report.read_text())["gains"]["masks"] == {"scar": 0.5}


@pytest.mark.parametrize("command", ["run", "check"])
@pytest.mark.parametrize(
    ("weights", "expected"),
    [
        (np.ones(3), "has weights of shape (3,)"),
        (np.full(256, 2.0), "has weights that do not lie between 0 and 1"),
        (np.full(256, np.nan), "has weights that do not lie between 0 and 1"),
    ],
)
def test_a_mask_that_does_not_fit(job, listing, capsys, weights, expected, command):
    write_mask(weights, job.path.with_name("mask.npz"))
    write_job(replace(job, masks=(MaskFile("scar", job.path.with_name("mask.npz"), 0.5),)), job.path)
    refused(job, listing, capsys, "mask.npz", expected, command=command)


def test_regions_on_points_without_mpeg_names(job, listing, capsys):
    write_job(replace(job, regions=RegionGains(mouth=0.5)), job.path)
    refused(job, listing, capsys, "target:", "are too few to place them")
    refused(job, listing, capsys, "target:", "are too few to place them", command="check")
