"""Builds the zip, installs it into fresh user folders, and runs scripts there: what ships is what is tested.

FACIAL_RETARGET_BLENDER_PYTHONS lists the interpreters to test (with bpy; separated as in PATH); without it,
the running one is tested.
"""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
SCENARIOS = Path(__file__).parent / "scenarios"
PYTHONS = os.environ.get("FACIAL_RETARGET_BLENDER_PYTHONS", sys.executable).split(os.pathsep)
Run = Callable[..., str]


def run_python(python: str, *arguments: object, **variables: str) -> str:
    """Run Python in its own process; its status and everything that it says count."""
    done = subprocess.run(
        [python, *map(str, arguments)],
        env={**os.environ, **variables},
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=600,
        check=False,
    )
    assert done.returncode == 0, f"{arguments} ended with status {done.returncode}:\n{done.stdout[-6000:]}"
    return done.stdout


@pytest.fixture(scope="session")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The extension as it ships for this platform."""
    out = tmp_path_factory.mktemp("dist")
    run_python(sys.executable, REPOSITORY / "build_extension.py", "--out", out)
    (built,) = out.glob("*.zip")
    return built


@pytest.fixture(scope="session", params=PYTHONS)
def blender(request: pytest.FixtureRequest, archive: Path, tmp_path_factory: pytest.TempPathFactory) -> Run:
    """Runs a script in a Blender that has the extension installed, and nothing else."""
    resources = tmp_path_factory.mktemp("user")
    alone = {"BLENDER_USER_RESOURCES": str(resources), "PYTHONNOUSERSITE": "1"}

    def run(script: Path, *arguments: object) -> str:
        return run_python(request.param, script, *arguments, **alone)

    run(SCENARIOS / "install.py", archive)
    return run


@pytest.fixture(scope="session")
def command_line() -> Run:
    """Runs facial-retarget in a process of its own, in the environment of the tests."""

    def run(*arguments: object) -> str:
        return run_python(sys.executable, "-m", "facial_retarget_addon.cli", *arguments, PYTHONPATH=str(REPOSITORY))

    return run
