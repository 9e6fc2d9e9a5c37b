"""Builds the zip, installs it into a fresh user folder of a real Blender, and plays scenarios in its window."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest
import window

PICTURES = os.environ.get("FACIAL_RETARGET_PICTURES")
"""A folder that keeps what the scenarios write, such as their screenshots; a temporary one if none is named."""


@pytest.fixture(scope="session")
def root() -> Path:
    """The folder with the real Blender; the tests are skipped where `make gui-test` has not made it."""
    missing = window.lacks()
    if not missing:
        return window.ROOT
    if os.environ.get("CI"):
        pytest.fail(f"CI always plays in a window, and that needs {missing}")
    pytest.skip(f"playing in a window needs {missing}")


@pytest.fixture(scope="session")
def user(root: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A user folder in which the extension is installed as it ships."""
    made, out = tmp_path_factory.mktemp("user"), tmp_path_factory.mktemp("dist")
    window.install_as_shipped(root, made, out)
    return made


@pytest.fixture(scope="session")
def play(root: Path, user: Path, tmp_path_factory: pytest.TempPathFactory) -> Callable[[Path], None]:
    """Plays a scenario; it fails if the scenario does, or if anything printed a traceback."""

    def play(scenario: Path) -> None:
        out = Path(PICTURES) / scenario.stem if PICTURES else tmp_path_factory.mktemp(scenario.stem)
        status, said = window.play(root, user, out.resolve(), scenario)
        assert status == 0, f"{scenario.stem} ended with status {status}; see {out}\n{said[-6000:]}"

    return play
