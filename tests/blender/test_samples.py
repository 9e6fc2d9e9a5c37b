"""The numbered samples are the scripting documentation: each one runs."""

from collections.abc import Callable
from pathlib import Path

import pytest

SCENARIOS = Path(__file__).parent / "scenarios"
SAMPLES = Path(__file__).resolve().parents[2] / "docs" / "samples"
BY_MAKE_DEMO = ("05_demo_scene", "10_figure_11", "13_wrinkle_kit")


@pytest.mark.parametrize("sample", sorted({path.stem for path in SAMPLES.glob("*.py")} - set(BY_MAKE_DEMO)))
def test_sample_runs(sample: str, blender: Callable[..., str]) -> None:
    blender(SCENARIOS / "sample.py", SAMPLES / f"{sample}.py")
