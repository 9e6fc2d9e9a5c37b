"""Each scenario is a script that runs inside Blender and fails by raising."""

from collections.abc import Callable
from pathlib import Path

import pytest

SCENARIOS = Path(__file__).parent / "scenarios"
NOT_ALONE = ("install", "stage", "retargeting", "feature_point_method", "wavelet_method", "key_curves", "sample")


@pytest.mark.parametrize("scenario", sorted({path.stem for path in SCENARIOS.glob("*.py")} - set(NOT_ALONE)))
def test_scenario(scenario: str, blender: Callable[..., str], tmp_path: Path) -> None:
    blender(SCENARIOS / f"{scenario}.py", tmp_path)
