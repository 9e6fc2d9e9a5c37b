"""The same job gives the same frames and bakes from Blender and from the command line."""

import csv
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

SCENARIOS = Path(__file__).parent / "scenarios"


@pytest.mark.parametrize("scenario", ["retargeting", "feature_point_method", "wavelet_method"])
def test_blender_and_command_line_give_the_same_frames(
    scenario: str, blender: Callable[..., str], command_line: Callable[..., str], tmp_path: Path
) -> None:
    blender(SCENARIOS / f"{scenario}.py", tmp_path)
    command_line("run", tmp_path / "job.toml")
    by_command_line = np.load(tmp_path / "job_target_frames.npz")["frames"]
    by_blender = np.load(tmp_path / "blender.npz")["frames"]
    size = np.ptp(by_blender[0], axis=0).max()
    np.testing.assert_allclose(by_command_line, by_blender, rtol=0, atol=1e-6 * size)


def test_blender_and_command_line_give_the_same_curves(
    blender: Callable[..., str], command_line: Callable[..., str], tmp_path: Path
) -> None:
    blender(SCENARIOS / "key_curves.py", tmp_path)
    for kind in ("compact", "rig"):
        command_line("run", tmp_path / f"{kind}.toml")
        names, rows = table(tmp_path / f"{kind}_curves.csv")
        in_blender, played = table(tmp_path / f"blender_{kind}.csv")
        assert names == in_blender
        # The command line counts its frames from 1.
        np.testing.assert_allclose(rows[:, 0], played[:, 0] - played[0, 0] + 1)
        np.testing.assert_allclose(rows[:, 1:], played[:, 1:], rtol=0, atol=1e-3)


def table(path: Path) -> tuple[list[str], np.ndarray]:
    """Names and values of a table of curves."""
    with open(path, encoding="utf-8", newline="") as file:
        names, *rows = csv.reader(file)
    return names, np.array(rows, float)
