"""The same job gives the same frames from Blender and from the command line."""

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
