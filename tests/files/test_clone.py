"""facial-retarget clone: the shapes of one head for one or many others, by a job or by options."""

from __future__ import annotations

import errno
import json
import shutil
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.cli import main
from facial_retarget_addon.core.errors import Cancelled, RetargetError
from facial_retarget_addon.core.methods.settings import HierarchicalSettings
from facial_retarget_addon.core.shapes.prepare import Preparation
from facial_retarget_addon.core.shapes.shape_set import ShapeSet
from facial_retarget_addon.core.shapes.sides import SideNames
from facial_retarget_addon.files import clone_task
from facial_retarget_addon.files.animation_table import read_table
from facial_retarget_addon.files.clone_job import (
    BuiltInActor,
    CloneJob,
    SourceFiles,
    TargetFiles,
    read_clone_job,
    write_clone_job,
)
from facial_retarget_addon.files.clone_task import run_clone_job
from facial_retarget_addon.files.job import FaceFiles
from facial_retarget_addon.files.mesh_file import MeshFile
from facial_retarget_addon.files.meshes import read_mesh, write_mesh
from facial_retarget_addon.files.mpeg4_face import FapFaceFiles
from facial_retarget_addon.files.pages.clone_page import worst_keys
from facial_retarget_addon.files.pages.lettering import lettered
from facial_retarget_addon.files.points import write_points
from facial_retarget_addon.files.shape_files import add_shapes, read_shapes
from facial_retarget_addon.files.shapes_task import ShapesTask, run_shapes_task
from facial_retarget_addon.files.whole import written_whole

from .conftest import FaceOnDisk

NAMES = ("browInnerUp", "jawOpen", "mouthClose", "mouthSmileLeft")


@pytest.fixture(scope="module")
def heads(face: FaceOnDisk, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a donor, four of its shapes, and two heads."""
    folder = tmp_path_factory.mktemp("heads")
    run_shapes_task(ShapesTask(FapFaceFiles(face.neutral, face.points), ("arkit",), folder / "arkit.npz"))
    mesh_file = read_mesh(face.neutral)
    shapes = read_shapes(folder / "arkit.npz", mesh_file.mesh).subset(NAMES)
    (folder / "arkit.npz").unlink()
    with written_whole() as aside:
        add_shapes(aside, shapes, folder / "shapes", mesh_file)
    for name, seed in (("one", 3), ("two", 4)):
        head = demo.warped_actor(np.random.default_rng(seed), vertices=3000)
        write_mesh(MeshFile(head.face.mesh, head.counts, head.corners), folder / f"{name}.obj")
        write_points(head.face.points, folder / f"{name}.json")
    write_mesh(mesh_file, folder / "donor.obj")
    write_points(face.actor.face.points, folder / "donor.json")
    return folder


@pytest.fixture
def job(heads: Path, tmp_path: Path) -> CloneJob:
    def files(name: str) -> FaceFiles:
        return FaceFiles(heads / f"{name}.obj", heads / f"{name}.json")

    source = SourceFiles(files("donor"), heads / "shapes")
    return CloneJob(source, (TargetFiles(files("one"), tmp_path / "one.npz"),))


# ---- the job file -------------------------------------------------------------------------------

FULL = Preparation(
    keep=("mouth*", "jaw*", "brow*"),
    drop=("*Right",),
    arkit_wholes=True,
    merge={"smile now": ("mouthSmileLeft", "mouthSmileRight")},
    split=("jawOpen",),
    feather=0.5,
    sides=SideNames(".L", ".R"),
    arkit_names=True,
    correctives={"mouthClose": ()},
)


def test_a_job_comes_back_as_it_was_written(job: CloneJob, tmp_path: Path) -> None:
    whole = replace(
        job,
        targets=(
            replace(job.targets[0], corrected=tmp_path / "corrected", report=tmp_path / "r.json"),
            replace(job.targets[0], shapes=tmp_path / "two", page=tmp_path / "p.html", sheet=tmp_path / "s.png"),
        ),
        preparation=FULL,
        method="hierarchical",
        settings=HierarchicalSettings(levels=2, level_gains=(1.0, 0.5)),
    )
    path = tmp_path / "clone.toml"
    for one in (job, whole, replace(job, source=BuiltInActor(("arkit", "visemes")))):
        write_clone_job(one, path)
        assert replace(read_clone_job(path), path=None) == one
        if one is whole:
            assert 'shapes = "two"' in path.read_text()


def test_a_short_job_is_enough(tmp_path: Path) -> None:
    (tmp_path / "clone.toml").write_text(
        'version = 1\n[source]\nneutral = "a.obj"\npoints = "a.json"\nshapes = "a"\n'
        '[[targets]]\nneutral = "b.obj"\npoints = "b.json"\nshapes = "b.json.npz"\n'
    )
    read = read_clone_job(tmp_path / "clone.toml")
    assert (read.method, read.preparation) == ("motion_cloning", Preparation())


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("version = 2", "version = 2, expected 1"),
        ('version = 1\nmethod = "magic"', "method = 'magic', expected one of"),
        ("version = 1", "targets is missing, expected a list"),
        ("version = 1\ntargets = []", "expected at least one"),
        ("version = 1\n[[targets]]\ncolour = 1", r"\[\[targets\]\] 1 colour is unknown"),
        ("version = 1\n[shapes]\nkeep = [1]", r"\[shapes\] keep = \[1\], expected a list of texts"),
        ('version = 1\n[shapes]\nsides = ["_L"]', "expected the left and the right half's ending"),
        ('version = 1\n[shapes]\nfeather = "wide"', "feather = 'wide', expected a number"),
        ("version = 1\n[shapes]\narkit_names = 1", "arkit_names = 1, expected true or false"),
        ('version = 1\n[shapes.merge]\na = "b"', r"\[shapes.merge\] a = 'b', expected a list"),
        ("version = 1\n[source]\nactor = 'arkit'", "actor = 'arkit', expected a list"),
        ("version = 1\n[source]\nactor = []\nneutral = 'a.obj'", "neutral is unknown"),
        ("version = 1\n[settings]\nlevels = 3", "has no setting 'levels'"),
    ],
)
def test_what_is_wrong_with_a_job_is_said(text: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "clone.toml").write_text(text)
    with pytest.raises(RetargetError, match=said):
        read_clone_job(tmp_path / "clone.toml")


# ---- doing it -----------------------------------------------------------------------------------


def clone(heads: Path, *arguments: object) -> int:
    source = [str(heads / name) for name in ("donor.obj", "donor.json", "shapes")]
    return main(["clone", "--quiet", "--source", *source, *map(str, arguments)])


def target(heads: Path, name: str, out: Path) -> list[object]:
    return ["--target", heads / f"{name}.obj", heads / f"{name}.json", out]


def test_one_command_gives_a_set_to_many_heads(heads: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    one, two = tmp_path / "one", tmp_path / "two.json"
    assert clone(heads, *target(heads, "one", one), *target(heads, "two", two), "--page") == 0
    assert {path.name for path in one.iterdir()} == {f"{name}.obj" for name in NAMES}
    mesh_file = read_mesh(heads / "one.obj")
    shapes = read_shapes(one, mesh_file.mesh)
    assert shapes.largest().min() > 0.01 * mesh_file.mesh.size
    assert read_mesh(one / "jawOpen.obj").counts.tolist() == mesh_file.counts.tolist()
    report = json.loads((tmp_path / "one.report.json").read_text())
    assert [row["name"] for row in report["shapes"]] == sorted(NAMES)
    assert (report["source_file"], report["target_file"]) == ("donor.obj", "one.obj")
    table = json.loads(two.read_text())["shapes"]
    assert {name: table[name]["key"] for name in table} == {name: name for name in sorted(NAMES)}
    page = (tmp_path / "two.html").read_text()
    assert page.count("data:image/png;base64,") == 3 * len(NAMES)
    assert "mouthClose with jawOpen" in page
    assert (tmp_path / "two.png").read_bytes().startswith(b"\x89PNG")
    assert f"{one}: 4 shapes" in capsys.readouterr().out


def test_a_job_chooses_splits_and_learns(job: CloneJob, tmp_path: Path) -> None:
    run_clone_job(job)
    mesh = read_mesh(job.targets[0].face.neutral).mesh
    first = read_shapes(tmp_path / "one.npz", mesh)
    corrected = ShapeSet(("mouthSmileLeft",), 1.5 * first["mouthSmileLeft"][None])
    with written_whole() as aside:
        add_shapes(aside, corrected, tmp_path / "corrected.json", read_mesh(job.targets[0].face.neutral))
    how = Preparation(keep=("mouth*", "brow*"), split=("brow*",), sides=SideNames("Left", "Right"))
    learning = replace(job.targets[0], shapes=tmp_path / "again.npz", corrected=tmp_path / "corrected.json")
    (report,) = run_clone_job(replace(job, preparation=how, targets=(learning,)))
    again = read_shapes(tmp_path / "again.npz", mesh)
    # The jaw serves mouthClose and was not asked for.
    assert again.names == ("browInnerUpLeft", "browInnerUpRight", "mouthClose", "mouthSmileLeft")
    np.testing.assert_allclose(again["mouthSmileLeft"], corrected["mouthSmileLeft"], atol=1e-6 * mesh.size)
    assert [figure["name"] for figure in report["examples"]] == ["mouthSmileLeft"]
    halves = again["browInnerUpLeft"] + again["browInnerUpRight"]
    brow = first["browInnerUp"]
    assert np.linalg.norm(halves - brow) < 0.1 * np.linalg.norm(brow)
    assert [row["name"] for row in report["shapes"]] == list(again.names)


def test_a_table_is_a_source_too(job: CloneJob, heads: Path, tmp_path: Path) -> None:
    donor = read_mesh(job.source.face.neutral)
    with written_whole() as aside:
        add_shapes(aside, read_shapes(heads / "shapes", donor.mesh), tmp_path / "table.json", donor)
    run_clone_job(job)
    run_clone_job(
        replace(
            job,
            source=replace(job.source, shapes=tmp_path / "table.json"),
            targets=(replace(job.targets[0], shapes=tmp_path / "by_table.npz"),),
        )
    )
    assert (tmp_path / "one.npz").read_bytes() == (tmp_path / "by_table.npz").read_bytes()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "clone expects a job file, or one of --source and --actor and at least one --target"),
        (["--method", "magic"], "--method magic is unknown"),
        (["clone.toml", "--page"], "cannot be read"),
    ],
)
def test_options_that_do_not_fit_are_refused(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["clone", *arguments]) == 2
    assert said in capsys.readouterr().err


def test_a_job_and_options_do_not_go_together(
    job: CloneJob, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_clone_job(job, tmp_path / "clone.toml")
    assert main(["clone", str(tmp_path / "clone.toml"), "--keep", "jaw*"]) == 2
    assert "but --keep came with" in capsys.readouterr().err
    assert main(["clone", str(tmp_path / "clone.toml"), "--quiet"]) == 0
    assert read_shapes(tmp_path / "one.npz", read_mesh(job.targets[0].face.neutral).mesh).names == NAMES


def test_every_fault_of_the_files_is_said_and_nothing_is_written(
    heads: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bad = [*target(heads, "one", tmp_path / "one.npz"), "--target", heads / "gone.obj", heads / "two.json", "no/x.npz"]
    assert clone(heads, *bad, "--keep", "ear*") == 2
    said = capsys.readouterr().err
    for part in ("gone.obj cannot be read", "there is no folder no", "no shape is called 'ear*'"):
        assert part in said
    assert said.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_an_input_is_never_replaced(heads: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert clone(heads, *target(heads, "one", heads / "shapes")) == 2
    assert "are one file" in capsys.readouterr().err


def test_a_clone_job_is_checked(job: CloneJob, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "clone.toml"
    write_clone_job(job, path)
    assert main(["check", str(path)]) == 0
    assert f"{path} is fine" in capsys.readouterr().out
    smirk = ShapeSet(("smirk",), np.zeros((1, *read_mesh(job.targets[0].face.neutral).mesh.vertices.shape)))
    with written_whole() as aside:
        add_shapes(aside, smirk, tmp_path / "smirk.json", read_mesh(job.targets[0].face.neutral))
    write_clone_job(replace(job, targets=(replace(job.targets[0], corrected=tmp_path / "smirk.json"),)), path)
    assert main(["check", str(path)]) == 2
    assert "corrected shapes smirk are not among the source's browInnerUp" in capsys.readouterr().err
    assert {entry.name for entry in tmp_path.iterdir()} == {"clone.toml", "smirk.json"}
    path.write_text("targets = 1")
    assert main(["check", str(path)]) == 2


def test_stopping_leaves_everything_as_it_was(job: CloneJob, tmp_path: Path) -> None:
    def stop(share: float, what: str) -> None:
        if share > 0.5:
            raise Cancelled

    with pytest.raises(Cancelled):
        run_clone_job(job, stop)
    assert not list(tmp_path.iterdir())


# ---- pictures -----------------------------------------------------------------------------------


def test_the_worst_keys_are_those_with_most_defects() -> None:
    rows = [{"name": f"k{n}", "torn_edges": n % 4, "flipped_triangles": n} for n in range(6)]
    assert worst_keys(rows) == ["k3", "k5", "k2"]
    assert worst_keys([{"name": "a", "torn_edges": 0, "flipped_triangles": 0}, {"name": "b", "corrected": True}]) == []


def test_letters_are_written_where_they_fit() -> None:
    white = np.full((20, 30, 3), 255, np.uint8)
    written = lettered(white, "i1", colour=(0, 0, 0))
    dark = (written == 0).all(axis=2)
    assert dark[2:7, 2:5].tolist() == [[a == "#" for a in row] for row in ("###", ".#.", ".#.", ".#.", "###")]
    assert not dark[:, 9:].any()
    assert (white == 255).all()
    assert (lettered(white, "abcdefghijklmn", scale=2) != 255).any()


def test_the_built_in_actor_lends_its_shapes(heads: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = ["--target", str(heads / "one.obj"), str(heads / "one.json"), str(tmp_path / "one.npz")]
    assert (
        main(
            [
                "clone",
                "--quiet",
                "--actor",
                "visemes",
                "--actor",
                "arkit",
                "--keep",
                "*aw*",
                "--keep",
                "*aa",
                "--keep",
                "mouthSmile*",
                *target,
            ]
        )
        == 0
    )
    with np.load(tmp_path / "one.npz") as made:
        assert {"viseme_aa", "jawOpen", "mouthSmileLeft"} <= set(made)
        shapes = {name: made[name] for name in made}
    head = demo.warped_actor(np.random.default_rng(3), vertices=3000)
    skin = slice(0, len(head.places))
    for name in ("viseme_aa", "mouthSmileLeft"):
        truth = demo.face_shapes(head)[name][skin]
        moved = truth - head.face.mesh.vertices[skin]
        assert np.linalg.norm(shapes[name][skin] - truth) < 0.25 * np.linalg.norm(moved), name
    (tmp_path / "clone.toml").write_text(
        f'version = 1\n[source]\nactor = ["moods"]\n[[targets]]\nneutral = "{heads / "one.obj"}"\n'
        f'points = "{heads / "one.json"}"\nshapes = "two.npz"\n'
    )
    assert main(["clone", "--quiet", str(tmp_path / "clone.toml")]) == 2
    assert "have no set 'moods', expected some of arkit, visemes, expressions" in capsys.readouterr().err
    with pytest.raises(RetargetError, match="did not bring one"):
        run_clone_job(read_clone_job(tmp_path / "clone.toml"))


# ---- the document -------------------------------------------------------------------------------

DOCUMENT = Path(__file__).resolve().parents[2] / "docs" / "cloning_sets.md"


def block(language: str) -> str:
    """The document's first block in a language."""
    return DOCUMENT.read_text().split(f"```{language}\n")[1].split("```")[0]


def test_the_documents_job_and_table_are_sound(tmp_path: Path) -> None:
    (tmp_path / "clone.toml").write_text(block("toml"))
    job = read_clone_job(tmp_path / "clone.toml")
    assert job.preparation.merge == {"smile": ("mouthSmile_L", "mouthSmile_R")}
    known = {field.name for field in fields(Preparation)}
    assert all(f"{name} = " in block("toml") or f"{name}." in block("toml") for name in known)
    (tmp_path / "table.json").write_text(block("json"))
    assert read_table(tmp_path / "table.json", 5171).names == ("open_jaw", "viseme_PP", "jawOpen")


# ---- going on -----------------------------------------------------------------------------------


def test_a_stopped_clone_goes_on_with_the_next_head(heads: Path, tmp_path: Path, monkeypatch, capsys) -> None:
    both = [*target(heads, "one", tmp_path / "one.npz"), *target(heads, "two", tmp_path / "two"), "--page"]
    assert clone(heads, *both) == 0
    wanted = without_times(tmp_path)
    shutil.rmtree(tmp_path / "two")
    for path in tmp_path.iterdir():
        path.unlink()
    made, do = [], clone_task._clone

    def stopping(job, inputs, head, progress):
        made.append(head.name)
        if made == ["one.obj", "two.obj"]:
            raise KeyboardInterrupt
        return do(job, inputs, head, progress)

    monkeypatch.setattr(clone_task, "_clone", stopping)
    assert clone(heads, *both, "--resume") == 130
    assert "the same command goes on from there" in capsys.readouterr().err
    kept = [".one.report.unfinished.json", ".one.unfinished.html", ".one.unfinished.npz", ".one.unfinished.png"]
    assert sorted(path.name for path in tmp_path.iterdir()) == [*kept, "one.npz.unfinished.json"]

    # Another method cannot go on with it; what a power cut has left half written of the second head is no hindrance.
    assert clone(heads, *both, "--resume", "--method", "feature_points") == 2
    assert "one.npz.unfinished.json keeps a run that was made with another method" in capsys.readouterr().err
    (tmp_path / ".two.unfinished").mkdir()
    (tmp_path / ".two.unfinished" / "half.obj").write_text("v 1")
    made.clear()
    assert clone(heads, *both, "--resume") == 0
    assert made == ["two.obj"]
    assert without_times(tmp_path) == wanted


def test_a_head_that_cannot_be_done_keeps_the_others(heads: Path, tmp_path: Path, monkeypatch, capsys) -> None:
    both = [*target(heads, "one", tmp_path / "one.json"), *target(heads, "two", tmp_path / "two.npz")]
    do = clone_task.add_shapes

    def full(aside, shapes, out, neutral):
        if out.name == "two.npz":
            aside.place(out).write_bytes(b"half")
            raise OSError(errno.ENOSPC, "No space left on device")
        do(aside, shapes, out, neutral)

    with monkeypatch.context() as patched:
        patched.setattr(clone_task, "add_shapes", full)
        assert clone(heads, *both, "--resume") == 2
    assert "two.npz cannot be written: the disk is full" in capsys.readouterr().err
    assert sorted(path.name for path in tmp_path.iterdir()) == [".one.unfinished.json", "one.json.unfinished.json"]
    assert clone(heads, *both) == 0
    # A run without --resume makes all anew, and leaves nothing of what was kept.
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one.json", "two.npz"]


def without_times(folder: Path) -> dict[str, bytes]:
    """What every file of a folder holds, reports without their times, pages left out: they show the times."""
    held = {}
    for path in sorted(folder.rglob("*")):
        if path.is_dir() or path.suffix == ".html":
            held[path.name] = b""
        elif path.name.endswith(".report.json"):
            report = json.loads(path.read_text())
            assert report.pop("seconds")
            held[path.name] = json.dumps(report).encode()
        else:
            held[path.name] = path.read_bytes()
    return held
