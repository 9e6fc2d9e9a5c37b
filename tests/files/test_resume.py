"""A run that was stopped goes on where it stood, and what comes out is the same."""

from __future__ import annotations

import errno
import json
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.cli import main
from facial_retarget_addon.core import retarget
from facial_retarget_addon.core.methods.settings import BakeSettings, HierarchicalSettings, MapSettings
from facial_retarget_addon.core.normal_maps.frame_maps import FrameMaps
from facial_retarget_addon.files import whole as whole_files
from facial_retarget_addon.files.bake_output import BakeOutput
from facial_retarget_addon.files.frames import write_frames
from facial_retarget_addon.files.job import MapOutput, OutputFiles, write_job
from facial_retarget_addon.files.kept_run import kept_folders
from facial_retarget_addon.files.meshes import read_mesh

from .conftest import bump

COUNT = 70
BLOCKS = -(-COUNT // retarget.BLOCK)
REPOSITORY = Path(__file__).resolve().parents[2]
KILLED = """
import os, signal, sys
from facial_retarget_addon import cli
from facial_retarget_addon.files import kept_run, normal_map_files, run
def killing(*arguments, left=[{after}]):
    write(*arguments)
    left[0] -= 1
    if not left[0]:
        os.kill(os.getpid(), signal.SIGKILL)
write, {module}.{name} = {module}.{name}, killing
sys.exit(cli.main(sys.argv[1:]))
"""


@pytest.fixture
def long_job(job):
    """A job of five blocks of frames with a bake."""
    mesh = read_mesh(job.source.neutral).mesh
    frames = [bump(mesh, 0.2 * np.sin(turn), 0.1 * np.cos(turn)) for turn in np.linspace(0, 6, COUNT)]
    write_frames(np.stack(frames), job.source.frames)
    folder = job.path.parent
    bake = BakeOutput(BakeSettings("compact"), (folder / "curves.csv",), folder / "keys.npz")
    output = replace(job.output, page=None)
    changed = replace(job, examples=(), settings=HierarchicalSettings(levels=1), output=output, bake=bake)
    write_job(changed, changed.path)
    return changed


def killed(job, module: str, name: str, after: int) -> None:
    """Run a job in a process of its own that is killed once it has called a writer so many times."""
    code = KILLED.format(module=module, name=name, after=after)
    command = [sys.executable, "-c", code, "run", str(job.path), "--resume", "--quiet"]
    done = subprocess.run(command, capture_output=True, cwd=REPOSITORY)
    assert done.returncode == -signal.SIGKILL, done.stderr


@pytest.fixture
def computed(monkeypatch) -> list[int]:
    """How many frames each call of the method gets from now on."""
    counts: list[int] = []
    fit = retarget.fit

    def counting(*arguments):
        fitted = fit(*arguments)
        frames = fitted.frames

        def counted(source):
            counts.append(len(source))
            return frames(source)

        monkeypatch.setattr(fitted, "frames", counted, raising=False)
        return fitted

    monkeypatch.setattr(retarget, "fit", counting)
    return counts


def outputs(job) -> dict[str, bytes]:
    """What a job has written, its report without the times."""
    report = json.loads(job.output.report.read_text())
    assert report.pop("seconds")
    found = {"report": json.dumps(report).encode()}
    for path in job.outputs().values():
        for file in sorted(path.iterdir()) if path.is_dir() else [path]:
            if file != job.output.report:
                found[str(file)] = file.read_bytes()
    return found


def whole(job) -> dict[str, bytes]:
    """What a job writes when nothing stops it; taken away again."""
    assert main(["run", str(job.path), "--quiet"]) == 0
    found = outputs(job)
    for path in job.outputs().values():
        for file in path.iterdir() if path.is_dir() else [path]:
            file.unlink()
    return found


def left(job) -> list[str]:
    return sorted(path.name for path in job.path.parent.glob("*.unfinished"))


def test_a_killed_run_goes_on_and_gives_the_same_bytes(long_job, computed):
    wanted = whole(long_job)
    killed(long_job, "kept_run.KeptRun", "keep", 3)
    assert left(long_job) == ["out.npz.unfinished"]
    assert not long_job.output.frames.exists()
    before = {path.name: path.stat().st_mtime_ns for path in kept_folders(long_job)[0].iterdir()}
    assert sorted(before) == ["frames_000001.npz", "frames_000017.npz", "frames_000033.npz", "made_with.json"]
    computed.clear()
    assert main(["run", str(long_job.path), "--resume", "--quiet"]) == 0
    assert computed == [retarget.BLOCK, COUNT - (BLOCKS - 1) * retarget.BLOCK]
    assert outputs(long_job) == wanted
    assert left(long_job) == []


@pytest.mark.parametrize("bakes", [True, False])
def test_a_job_without_frames_goes_on_too(long_job, computed, bakes):
    maps = MapOutput(long_job.path.with_name("maps"), MapSettings(pixels=32))
    job = replace(long_job, output=OutputFiles(), normal_maps=maps, bake=long_job.bake if bakes else None)
    write_frames(np.load(job.source.frames)["frames"][:18], job.source.frames)
    write_job(job, job.path)
    killed(job, "normal_map_files", "write_whole", 17)
    both = ["curves.csv.unfinished", "maps.unfinished"] if bakes else ["maps.pictures.unfinished", "maps.unfinished"]
    assert left(job) == both
    computed.clear()
    assert main(["run", str(job.path), "--resume", "--quiet"]) == 0
    assert computed == [1]
    assert len(list(maps.folder.iterdir())) == 18
    assert left(job) == []


def test_a_run_killed_in_its_last_step_computes_no_frame_again(long_job, computed):
    wanted = whole(long_job)
    killed(long_job, "run", "add_bake", 1)
    computed.clear()
    assert main(["run", str(long_job.path), "--resume", "--quiet"]) == 0
    assert computed == []
    assert outputs(long_job) == wanted
    assert left(long_job) == []


def test_ctrl_c_keeps_what_is_computed_and_says_so(long_job, monkeypatch, capsys, listing):
    before = listing()
    wanted = whole(long_job)
    assert listing() == before

    def stop(done: float, what: str) -> None:
        if what == "frame 33 of 70":
            raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr("facial_retarget_addon.cli._progress", lambda arguments: stop)
        assert main(["run", str(long_job.path), "--resume"]) == 130
    assert "what was computed is kept, and the same command goes on from there" in capsys.readouterr().err
    assert listing().items() >= before.items()
    assert len(list(kept_folders(long_job)[0].glob("frames_*"))) == 2
    assert main(["run", str(long_job.path), "--resume"]) == 0
    said = capsys.readouterr().err
    assert "frame 17 of 70, from an earlier run" in said
    assert "frame 33 of 70\n" in said
    assert outputs(long_job) == wanted


def test_without_resume_nothing_is_kept_and_what_was_kept_goes_once_the_job_is_done(long_job, monkeypatch, listing):
    before = listing()

    def stop(done: float, what: str) -> None:
        if what == "frame 33 of 70":
            raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr("facial_retarget_addon.cli._progress", lambda arguments: stop)
        assert main(["run", str(long_job.path)]) == 130
    assert listing() == before
    killed(long_job, "kept_run.KeptRun", "keep", 1)
    assert left(long_job) == ["out.npz.unfinished"]
    assert main(["run", str(long_job.path), "--quiet"]) == 0
    assert left(long_job) == []


def test_maps_that_are_whole_are_kept(long_job, monkeypatch, computed):
    job = replace(long_job, normal_maps=MapOutput(long_job.path.with_name("maps"), MapSettings(pixels=32)))
    frames = np.load(job.source.frames)["frames"]
    write_frames(frames[:5], job.source.frames)
    write_job(job, job.path)
    wanted = whole(job)
    killed(job, "normal_map_files", "write_whole", 2)
    assert left(job) == ["maps.unfinished", "out.npz.unfinished"]
    maps = kept_folders(job)[1]
    assert sorted(path.name for path in maps.iterdir()) == ["normal.0001.png", "normal.0002.png"]
    (maps / ".normal.0003-0123abcd-partial.png").write_bytes(b"half")
    made, frame = [], FrameMaps.frame
    monkeypatch.setattr(FrameMaps, "frame", lambda self, source: made.append(1) or frame(self, source))
    computed.clear()
    assert main(["run", str(job.path), "--resume", "--quiet"]) == 0
    assert len(made) == 3
    # Each of those three maps has its light mesh from the method.
    assert computed == [1, 1, 1]
    assert outputs(job) == wanted
    assert left(job) == []


def test_maps_survive_outputs_that_cannot_be_written(long_job, monkeypatch, capsys):
    job = replace(long_job, normal_maps=MapOutput(long_job.path.with_name("maps"), MapSettings(pixels=32)))
    write_frames(np.load(job.source.frames)["frames"][:3], job.source.frames)
    write_job(job, job.path)

    put = whole_files._renamed

    def full(start, end):
        if end == job.output.frames:
            raise OSError(errno.ENOSPC, "No space left on device")
        return put(start, end)

    with monkeypatch.context() as patched:
        patched.setattr(whole_files, "_renamed", full)
        assert main(["run", str(job.path), "--resume", "--quiet"]) == 2
    assert "the disk is full" in capsys.readouterr().err
    assert left(job) == ["maps.unfinished", "out.npz.unfinished"]
    assert len(list(kept_folders(job)[1].iterdir())) == 3
    assert not list(job.path.parent.glob(".*"))


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (lambda job: replace(job, settings=HierarchicalSettings(levels=2)), ["another [settings] levels"]),
        (lambda job: (write_frames(np.load(job.source.frames)["frames"][:60], job.source.frames), job)[1],
         ["another [source] frames"]),
        (lambda job: replace(job, fps=30.0, bake=None), []),
    ],
)  # fmt: skip
def test_only_what_was_made_in_the_same_way_goes_on(long_job, capsys, listing, change, expected):
    killed(long_job, "kept_run.KeptRun", "keep", 1)
    job = change(long_job)
    write_job(job, job.path)
    before = listing()
    status = main(["run", str(job.path), "--resume", "--quiet"])
    said = capsys.readouterr().err
    if not expected:
        assert status == 0
        return
    assert status == 2
    assert said.count("\n") == 1
    for text in (*expected, "out.npz.unfinished keeps a run", "remove it to start anew"):
        assert text in said
    assert said.count("another") == len(expected)
    assert listing() == before


def test_a_folder_of_somebody_elses_is_left_alone(long_job, capsys, listing):
    folder = kept_folders(long_job)[0]
    folder.mkdir()
    (folder / "diary.txt").write_text("mine")
    before = listing()
    assert main(["run", str(long_job.path), "--resume", "--quiet"]) == 2
    assert "holds 'diary.txt', which no run has kept" in capsys.readouterr().err
    assert main(["run", str(long_job.path), "--quiet"]) == 0
    assert listing().items() >= before.items()


def test_a_block_that_is_spoilt_is_said(long_job, capsys):
    killed(long_job, "kept_run.KeptRun", "keep", 1)
    (kept_folders(long_job)[0] / "frames_000001.npz").write_bytes(b"PK")
    assert main(["run", str(long_job.path), "--resume", "--quiet"]) == 2
    said = capsys.readouterr().err
    assert "frames_000001.npz is no block of frames" in said
    assert said.count("\n") == 1


def test_bad_input_leaves_no_folder(long_job, listing, capsys):
    long_job.source.points.write_text("{")
    before = listing()
    assert main(["run", str(long_job.path), "--resume", "--quiet"]) == 2
    assert listing() == before
