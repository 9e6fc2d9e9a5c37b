"""The tool's icon is what its script makes, in the form that Blender reads."""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import build_icon


def test_the_kept_icon_is_the_one_that_the_script_makes() -> None:
    assert build_icon.PLACE.read_bytes() == build_icon.icon()


def test_the_icon_is_whole_and_within_its_square() -> None:
    made = build_icon.icon()
    assert made[:8] == b"VCO\0\xff\xff\0\0"
    count, rest = divmod(len(made) - 8, 18)  # three corners of two bytes, and of four of colour
    assert (count > 50, rest) == (True, 0)
    corners = np.frombuffer(made[8 : 8 + 6 * count], np.uint8).reshape(count, 3, 2).astype(float)
    assert corners.min() > 40, "Blender's own leave as much room"
    assert corners.max() < 216
    sides = corners[:, 1:] - corners[:, :1]
    assert (np.cross(sides[:, 0], sides[:, 1]) != 0).mean() > 0.95
