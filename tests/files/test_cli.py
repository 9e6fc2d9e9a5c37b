"""The command line itself: help at once, progress, exit status."""

from __future__ import annotations

import io
import subprocess
import sys
from pathlib import Path

import pytest

from facial_retarget_addon.cli import main
from facial_retarget_addon.core.errors import Cancelled
from facial_retarget_addon.terminal import progress_on

REPOSITORY = Path(__file__).resolve().parents[2]


def test_help_loads_nothing_heavy():
    code = (
        "import sys\n"
        "from facial_retarget_addon.cli import main\n"
        "try: main(['--help'])\n"
        "except SystemExit as leaving: assert leaving.code == 0\n"
        "heavy = {'scipy', 'embreex', 'facial_retarget_addon.core.mesh'} & set(sys.modules)\n"
        "assert not heavy, heavy\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=REPOSITORY)
    assert done.returncode == 0, done.stderr
    for word in ("run", "check", "fap", "shapes", "demo", "--quiet"):
        assert word in done.stdout


def test_the_module_is_a_command(tmp_path):
    command = [sys.executable, "-m", "facial_retarget_addon.cli", "run", str(tmp_path / "none.toml")]
    done = subprocess.run(command, capture_output=True, text=True, cwd=REPOSITORY)
    assert done.returncode == 2
    assert done.stderr.startswith("facial-retarget: ")
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize(
    "arguments", [[], ["sing"], ["run"], ["run", "a", "b"], ["fap", "a"], ["shapes", "--out", "a"]]
)
def test_a_command_line_that_is_wrong(arguments, capsys):
    with pytest.raises(SystemExit) as leaving:
        main(arguments)
    assert leaving.value.code == 2
    assert "usage: facial-retarget" in capsys.readouterr().err


def test_cancelled_is_not_an_error(monkeypatch, capsys):
    def cancel(path: Path, progress: object, resume: bool) -> None:
        raise Cancelled

    monkeypatch.setattr("facial_retarget_addon.files.run.run_job", cancel)
    assert main(["run", "job.toml"]) == 130
    assert "every file is as it was" in capsys.readouterr().err


def test_a_bug_keeps_its_traceback(monkeypatch):
    def fail(path: Path, progress: object, resume: bool) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr("facial_retarget_addon.files.run.run_job", fail)
    with pytest.raises(ZeroDivisionError):
        main(["run", "job.toml"])


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


def test_a_bar_on_a_terminal():
    terminal = Terminal()
    show = progress_on(terminal)
    show(0.5, "frame 3 of 6")
    assert terminal.getvalue().endswith("[###############...............]  50% frame 3 of 6")
    show(1.0, "Done")
    assert terminal.getvalue().endswith("\r\x1b[K")
    assert "\n" not in terminal.getvalue()


def test_lines_elsewhere_and_not_one_for_every_frame():
    stream = io.StringIO()
    show = progress_on(stream)
    show(0.0, "Reading")
    for frame in range(1000):
        show(0.1 + 0.8 * frame / 1000, f"frame {frame} of 1000")
    show(1.0, "Done")
    lines = stream.getvalue().splitlines()
    assert lines[0] == "  0% Reading"
    assert lines[-1] == "100% Done"
    assert 10 < len(lines) < 25


def test_the_demonstration_is_a_set_of_sound_jobs(tmp_path, monkeypatch, capsys, no_method):
    """Its files are written and its jobs have no fault; retargeting itself is the method's own test."""
    from facial_retarget_addon import demonstration
    from facial_retarget_addon.demo import performance_table
    from facial_retarget_addon.files import run
    from facial_retarget_addon.files.clone_job import read_clone_job
    from facial_retarget_addon.files.meshes import read_mesh
    from facial_retarget_addon.files.parts import read_parts
    from facial_retarget_addon.files.shape_files import read_shapes

    monkeypatch.setattr(run, "report_page", lambda *arguments: b"a page")
    monkeypatch.setattr(demonstration, "performance", lambda face: face.frames(performance_table()[25:28]))
    assert main(["demo", str(tmp_path / "new" / "demo"), "--quiet"]) == 0
    assert (tmp_path / "new" / "demo" / "ape" / "expressions.html").is_file()
    job = read_clone_job(tmp_path / "new" / "demo" / "ape_shapes.toml")
    donor = read_mesh(job.source.face.neutral).mesh
    assert "tongueOut" in read_shapes(job.source.shapes, donor).names
    assert "tongue" in read_parts(job.source.face.parts, donor)
    for target in ("ape", "skull"):
        names = {path.name for path in (tmp_path / "new" / "demo" / target).iterdir()}
        assert {"neutral.obj", "points.json", "joy.npz", "frames.npz", "report.json", "report.html"} <= names


def test_a_demonstration_where_there_is_a_file(tmp_path, capsys):
    (tmp_path / "demo").write_text("taken")
    assert main(["demo", str(tmp_path / "demo"), "--quiet"]) == 2
    assert "cannot be made" in capsys.readouterr().err
