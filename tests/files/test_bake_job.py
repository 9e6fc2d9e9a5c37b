"""Bakes out of whole jobs, with the real method: frames as few keys, or as curves of the target's own shapes."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.cli import main
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.methods.settings import BakeSettings, HierarchicalSettings
from facial_retarget_addon.core.mpeg4.conversions import low_level, stream_of_values
from facial_retarget_addon.core.mpeg4.faps import FAPS
from facial_retarget_addon.files.bake_output import BakeOutput
from facial_retarget_addon.files.frame_range import FrameRange
from facial_retarget_addon.files.frames import read_frames, write_frames
from facial_retarget_addon.files.job import OutputFiles, read_job, write_job
from facial_retarget_addon.files.meshes import read_mesh
from facial_retarget_addon.files.motion.fap import read_fap, write_fap
from facial_retarget_addon.files.npz import write_arrays
from facial_retarget_addon.files.shape_files import read_shapes

from .conftest import bump
from .test_job import MINIMAL, written

COUNT = 12


@pytest.fixture
def long_job(job):
    """The job with twelve frames of two bumps that come and go."""
    mesh = read_mesh(job.source.neutral).mesh
    rest, (one, other) = mesh.vertices, (bump(mesh, place, 0.1) - mesh.vertices for place in (-0.2, 0.2))
    turns = np.linspace(0, 3, COUNT)
    frames = [rest + abs(np.sin(t)) * one + abs(np.sin(2 * t)) * other for t in turns]
    write_frames(np.stack(frames), job.source.frames)
    return replace(job, examples=(), settings=HierarchicalSettings(levels=1), output=replace(job.output, page=None))


def with_bake(job, shapes: str | None = "keys.npz", curves=("curves.csv", "curves.json"), rig=None, **settings):
    """The job on disk with a bake beside it."""
    folder = job.path.parent
    paths = {"shapes": shapes and folder / shapes, "rig": rig and folder / rig}
    output = BakeOutput(BakeSettings(**settings), tuple(folder / name for name in curves), **paths)
    changed = replace(job, bake=output)
    write_job(changed, changed.path)
    assert read_job(changed.path).bake == output
    return changed


def table(path: Path) -> tuple[list[str], np.ndarray]:
    with open(path, encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    return head, np.array(rows, float)


def test_a_compact_bake_plays_the_frames_within_its_tolerance(long_job):
    job = with_bake(long_job, kind="compact", tolerance=0.01)
    assert main(["run", str(job.path), "--quiet"]) == 0
    target = read_mesh(job.target.neutral).mesh
    keys = read_shapes(job.bake.shapes, target)
    head, rows = table(job.bake.curves[0])
    assert head == ["frame", "time", *keys.names]
    np.testing.assert_array_equal(rows[:, 0], range(1, COUNT + 1))
    np.testing.assert_allclose(rows[:, 1], np.arange(COUNT) / 24, rtol=1e-6)
    frames = read_frames(job.output.frames, len(target.vertices))
    played = target.vertices + np.tensordot(rows[:, 2:], keys.displacements, axes=1)
    off = np.linalg.norm(played - frames, axis=2)
    figures = json.loads(job.output.report.read_text())["bake"]
    assert (figures["kind"], figures["keys"], figures["new_keys"]) == ("compact", len(keys), len(keys))
    assert len(keys) < COUNT / 2
    assert 0 < figures["bytes"] < figures["bytes_as_frames"] == 4 * frames.size
    assert max(figures["per_frame"]["error"]) == figures["error"] <= 0.01 * (1 + 1e-3)
    unit = off.max() / figures["worst"]
    np.testing.assert_allclose(off.max(axis=1) / unit, figures["per_frame"]["worst"], rtol=1e-2, atol=1e-5)
    document = json.loads(job.bake.curves[1].read_text())
    np.testing.assert_allclose(np.array(list(document["curves"].values())).T, rows[:, 2:], rtol=1e-6)
    assert list(document["curves"]) == list(keys.names)


def test_a_job_of_a_bake_alone_writes_no_frames(long_job):
    job = replace(long_job, output=OutputFiles())
    job = with_bake(job, kind="compact")
    before = {path.name for path in job.path.parent.iterdir()}
    assert main(["run", str(job.path), "--quiet"]) == 0
    new = {path.name for path in job.path.parent.iterdir()} - before
    assert new == {"curves.csv", "curves.json", "keys.npz"}


def test_the_same_job_gives_the_same_bytes(long_job):
    job = with_bake(long_job, kind="compact")
    read = []
    for _ in range(2):
        assert main(["run", str(job.path), "--quiet"]) == 0
        read.append([path.read_bytes() for path in (job.output.frames, *job.bake.outputs().values())])
    assert read[0] == read[1]


def rig_of(job, name: str = "rig.npz") -> list[str]:
    """Write shapes of the target that can do much of the motion."""
    mesh = read_mesh(job.target.neutral).mesh
    shapes = {f"at {place}": bump(mesh, place, 0.1) for place in (-0.2, 0.0, 0.2)}
    with open(job.path.with_name(name), "wb") as file:
        write_arrays(file, shapes)
    return list(shapes)


def test_a_rigs_curves_stay_within_its_ranges(long_job):
    names = rig_of(long_job)
    job = with_bake(long_job, None, rig="rig.npz", kind="rig", smoothness=0.0)
    job = replace(job, bake=replace(job.bake, ranges={names[0]: (0.0, 0.25)}))
    write_job(job, job.path)
    assert read_job(job.path) == job
    assert main(["run", str(job.path), "--quiet"]) == 0
    head, rows = table(job.bake.curves[0])
    assert head == ["frame", "time", *names]
    assert rows[:, 2].max() == 0.25
    assert 0.25 < rows[:, 4].max() <= 1
    assert rows[:, 2:].min() >= 0
    figures = json.loads(job.output.report.read_text())["bake"]
    assert (figures["keys"], figures["new_keys"]) == (3, 0)


def test_residual_keys_are_new_shapes_beside_the_rigs(long_job):
    names = rig_of(long_job)
    worst = []
    for residual, shapes in ((0, None), (6, "residual")):
        job = with_bake(long_job, shapes, ("curves.csv",), "rig.npz", kind="rig", residual=residual)
        assert main(["run", str(job.path), "--quiet"]) == 0
        worst.append(json.loads(job.output.report.read_text())["bake"]["error"])
    head, rows = table(job.bake.curves[0])
    new = ["retargeted_residual_1", "retargeted_residual_2"]
    assert head == ["frame", "time", *names, *new]
    assert sorted(file.stem for file in job.bake.shapes.iterdir()) == new
    assert not rows[6:, 5].any()
    assert not rows[:6, 6].any()
    assert worst[1] < worst[0]


def test_a_part_of_the_frames_keeps_their_numbers_and_their_time(long_job):
    job = replace(long_job, chosen=FrameRange(3, 11, 4), fps=30.0)
    job = with_bake(job, kind="compact")
    job = replace(job, output=replace(job.output, frames=job.path.with_name("out.mdd")))
    write_job(job, job.path)
    assert read_job(job.path) == job
    assert main(["run", str(job.path), "--quiet"]) == 0
    _, rows = table(job.bake.curves[0])
    np.testing.assert_array_equal(rows[:, 0], [3, 7, 11])
    np.testing.assert_allclose(rows[:, 1], [0, 4 / 30, 8 / 30], rtol=1e-6)
    times = np.frombuffer(job.output.frames.read_bytes()[8:20], ">f4")
    np.testing.assert_allclose(times, [0, 4 / 30, 8 / 30], rtol=1e-6)
    some = read_frames(job.output.frames, 256)
    every = replace(job, chosen=FrameRange())
    write_job(every, every.path)
    assert main(["run", str(job.path), "--quiet"]) == 0
    # All of them go through the method in other blocks: the same to the last digits.
    np.testing.assert_allclose(some, read_frames(job.output.frames, 256)[2:11:4], atol=1e-6)


def test_the_page_shows_the_figures_without_those_of_each_frame(long_job):
    job = with_bake(
        replace(long_job, output=replace(long_job.output, page=long_job.path.with_name("a.html"))), kind="compact"
    )
    assert main(["run", str(job.path), "--quiet"]) == 0
    page = job.output.page.read_text()
    assert "<h2>Bake</h2>" in page
    assert "bytes as frames" in page
    assert "per frame</th>" not in page


def test_a_rig_of_faps_gives_faps_back(face, tmp_path):
    """The built-in face plays a take; the same face's FAP shapes are fitted to it, and say the take again."""
    shown = {"open_jaw": 600.0, "stretch_l_cornerlip": 180.0, "raise_l_i_eyebrow": 200.0, "squeeze_r_eyebrow": -80.0}
    numbers = {fap.name: fap.number for fap in FAPS}
    values = np.zeros((COUNT, len(FAPS)))
    for name, most in shown.items():
        values[:, numbers[name] - 1] = most * np.sin(np.linspace(0, 3, COUNT)).round(2)
    write_fap(stream_of_values("take", 25.0, values), tmp_path / "take.fap")
    for command in (
        ["fap", str(tmp_path / "take.fap"), "--out", str(tmp_path / "frames.npz")],
        ["shapes", "--set", "faps", "--out", str(tmp_path / "faps.json")],
    ):
        assert main([*command, *face.arguments, "--quiet"]) == 0
    files = f'neutral = "{face.neutral.as_posix()}"\npoints = "{face.points.as_posix()}"\n'
    (tmp_path / "job.toml").write_text(
        f'version = 1\nmethod = "motion_cloning"\n[source]\n{files}frames = "frames.npz"\nfps = 25.0\n[target]\n{files}'
        '[bake]\nkind = "rig"\nrig = "faps.json"\ncurves = ["back.fap"]\nsmoothness = 0.0\nsparsity = 0.0\n'
    )
    assert main(["run", str(tmp_path / "job.toml"), "--quiet"]) == 0
    stream = read_fap(tmp_path / "back.fap")
    back = low_level(stream)
    assert stream.fps == 25.0
    np.testing.assert_allclose(back, values, atol=1)
    assert set(np.flatnonzero(np.ptp(back, axis=0) > 2) + 1) == {numbers[name] for name in shown}


BAKE = '[bake]\nkind = "compact"\nshapes = "keys.npz"\ncurves = ["c.csv"]'


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ('"compact"', '"frames"', "[bake] can be of kind compact or rig; the frames themselves are [output] frames"),
        ('kind = "compact"\n', "", "[bake] kind is missing"),
        ('\ncurves = ["c.csv"]', "", "[bake] curves names no files"),
        ('["c.csv"]', "[]", "[bake] curves names no files"),
        ('["c.csv"]', "[3]", "expected a list of texts"),
        ('["c.csv"]', '["c.csv", "c.csv"]', "[bake] curves 2 and [bake] curves 1 are one file"),
        ('shapes = "keys.npz"\n', "", "[bake] shapes is missing, expected a path for the new keys"),
        ('"compact"', '"rig"', "[bake] rig is missing, expected the target's own shapes where kind = 'rig'"),
        ("[bake]\n", '[bake]\nrig = "rig.npz"\n', "[bake] rig says nothing where kind = 'compact'"),
        ('"compact"', '"rig"\nrig = "r"', "[bake] shapes would hold nothing"),
        ('"c.csv"', '"c.fap"', "[bake] curves has 'c.fap', but kind = 'compact' has no FAPs"),
        (
            'kind = "compact"\nshapes = "keys.npz"\ncurves = ["c.csv"]',
            'kind = "rig"\nrig = "r"\nresidual = 3\nshapes = "keys.npz"\ncurves = ["c.fap"]',
            "[bake] curves is FAPs alone, which leave out the new keys; expected a .csv or .json as well",
        ),
        ("[bake]\n", "[bake]\ntolerance = 2\n", "[bake] tolerance = 2: expected a number from 0.0001 to 0.5"),
        ("[bake]\n", "[bake]\ncolour = 2\n", "[bake] has no setting 'colour'"),
        ("[bake]\n", "[bake]\nranges = {a = [1, 0]}\n", "[bake] ranges 'a' = [1, 0], expected a lowest and a greater"),
        ('"keys.npz"', '"source.obj"', "[bake] shapes and [source] neutral are one file"),
        ("[bake]", '[source]\nrange = "9:2"\n[bake]', "[source] range: frames are '9:2', expected a first one from 1"),
        ("[bake]", "[source]\nfps = 0\n[bake]", "[source] fps = 0, expected a number above 0, at most 10000"),
    ],
)
def test_a_bake_that_is_wrong(tmp_path, old, new, expected):
    assert old in BAKE
    text = BAKE.replace(old, new, 1)
    if text.startswith("[source]"):
        line, text = text.split("\n")[1], text.split("\n", 2)[2]
        minimal = MINIMAL.replace("[source]", f"[source]\n{line}")
    else:
        minimal = MINIMAL
    with pytest.raises(RetargetError) as error:
        read_job(written(tmp_path, minimal + text))
    assert expected in str(error.value)


def still(folder: Path) -> Path:
    """A set with a shape that is the target's neutral."""
    with open(folder / "still.npz", "wb") as file:
        write_arrays(file, {"nothing": read_mesh(folder / "target.obj").mesh.vertices})
    return folder / "still.npz"


@pytest.mark.parametrize("command", ["run", "check"])
@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (lambda bake, folder: replace(bake, rig=folder / "none.npz"), "none.npz cannot be read"),
        (lambda bake, folder: replace(bake, rig=folder / "source_joy.obj"), "is no set of shapes"),
        (lambda bake, folder: replace(bake, rig=still(folder)), "still.npz: none of the rig's 1 shapes moves a vertex"),
        (lambda bake, folder: replace(bake, ranges={"jaw": (0.0, 2.0)}), "[bake] ranges has a shape 'jaw', which"),
        (
            lambda bake, folder: replace(bake, curves=(folder / "c.txt",)),
            "c.txt would be a .txt, expected .csv or .json",
        ),
        (lambda bake, folder: replace(bake, curves=(folder / "no" / "c.csv",)), "there is no folder"),
    ],
)
def test_what_a_bake_lacks_is_said_before_anything_is_computed(long_job, listing, capsys, command, change, expected):
    rig_of(long_job)
    job = with_bake(long_job, None, ("c.csv",), "rig.npz", kind="rig")
    job = replace(job, bake=change(job.bake, job.path.parent))
    write_job(job, job.path)
    before = listing()
    assert main([command, str(job.path), "--quiet"]) == 2
    said = capsys.readouterr().err
    assert expected in said
    assert said.count("\n") == 1
    assert listing() == before


def test_frames_that_the_source_does_not_have(long_job, listing, capsys):
    job = replace(long_job, chosen=FrameRange(1, 20))
    write_job(job, job.path)
    before = listing()
    assert main(["run", str(job.path), "--quiet"]) == 2
    assert "frames 1 to 20 are wanted, but the take has 12" in capsys.readouterr().err
    assert listing() == before
