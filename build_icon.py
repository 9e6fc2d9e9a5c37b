"""The icon of the feature-point tool, in the format that Blender's own tools have: triangles on 256 x 256 places.

    python build_icon.py

Writes facial_retarget_addon/viewport/feature_points.dat: the outline of the diagram's face, and five points on it. The
file is kept beside the tool, so that a checkout has it too; tests/test_icon.py holds it against this script.

A `.dat` is "VCO" and a zero, the highest place across and up, the place where it starts, both ways, then three corners
of two bytes for each triangle, and the same corners' colours of four bytes (Blender, datatoc of icon geometry).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.viewport.face_lines import face_lines

PLACE = Path(__file__).resolve().parent / "facial_retarget_addon" / "viewport" / "feature_points.dat"
GREY, GREEN, DARK = (229, 229, 229, 255), (117, 255, 175, 255), (60, 60, 60, 255)
"""Blender's own tools draw what is there in this grey, and what they make in this green."""
POINTS = ((0.76, 0.0), (-0.76, 0.0), (0.0, -0.60), (0.43, -1.10), (-0.43, -1.10))
"""Where they lie on the diagram: outer corners of the eyes, tip of the nose, corners of the mouth."""
HEIGHT, MIDDLE = 150.0, (128.0, 128.0)
"""Of the face, in places, and where its middle lies."""
LINE, DOT, EDGE, CORNERS = 13.0, 13.0, 4.0, 12
"""Width of the outline, radius of a point, width of the dark ring around it; corners of a point."""

Triangles = list[tuple[FloatArray, tuple[int, int, int, int]]]
"""Corners (3, 2) of each triangle, and its colour."""


def icon() -> bytes:
    """The whole file."""
    outline = face_lines()[0]
    low, high = outline.min(axis=0), outline.max(axis=0)
    scale = HEIGHT / (high[1] - low[1])

    def placed(points: Sequence[Sequence[float]] | FloatArray) -> FloatArray:
        return (np.asarray(points) - 0.5 * (low + high)) * scale + MIDDLE

    triangles = _band(placed(outline), LINE, GREY)
    for middle in placed(POINTS):
        triangles += _disc(middle, DOT + EDGE, DARK) + _disc(middle, DOT, GREEN)
    corners = np.stack([corners for corners, _ in triangles])
    colours = np.repeat([colour for _, colour in triangles], 3, axis=0)
    header = b"VCO\0" + bytes([255, 255, 0, 0])
    return header + np.round(corners).astype(np.uint8).tobytes() + colours.astype(np.uint8).tobytes()


def _band(line: FloatArray, width: float, colour: tuple[int, int, int, int]) -> Triangles:
    """A closed line (n, 2), whose last place is its first, as a band."""
    ends = line[:-1]
    along = np.roll(ends, -1, axis=0) - np.roll(ends, 1, axis=0)
    across = 0.5 * width * np.column_stack([-along[:, 1], along[:, 0]]) / np.linalg.norm(along, axis=1)[:, None]
    inner, outer = ends - across, ends + across
    found: Triangles = []
    for a, b, c, d in zip(inner, outer, np.roll(inner, -1, axis=0), np.roll(outer, -1, axis=0), strict=True):
        found += [(np.stack([a, c, d]), colour), (np.stack([a, d, b]), colour)]
    return found


def _disc(middle: FloatArray, radius: float, colour: tuple[int, int, int, int]) -> Triangles:
    angles = np.linspace(0, 2 * np.pi, CORNERS, endpoint=False)
    rim = middle + radius * np.column_stack([np.cos(angles), np.sin(angles)])
    return [(np.stack([middle, a, b]), colour) for a, b in zip(rim, np.roll(rim, -1, axis=0), strict=True)]


if __name__ == "__main__":
    PLACE.write_bytes(icon())
    print(PLACE)
