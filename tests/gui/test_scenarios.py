"""Each scenario is what an artist does in Blender's window; it asserts the scene that comes of it."""

from collections.abc import Callable
from pathlib import Path

import pytest

SCENARIOS = sorted((Path(__file__).parent / "scenarios").glob("*.py"))


@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda path: path.stem)
def test_scenario(scenario: Path, play: Callable[[Path], None]) -> None:
    play(scenario)
