"""Names beside points: the one under the mouse in full, or all of them in short, never one over another."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import blf
import gpu
from gpu_extras.batch import batch_for_shader

TEXT, PAPER = (1.0, 1.0, 1.0, 1.0), (0.06, 0.06, 0.06, 0.72)
SIZE = 11.0
"""Of the letters, in points."""
_FONT = 0

Box = tuple[float, float, float, float]
"""Left, bottom, right, top, in pixels."""


class Label(NamedTuple):
    """A text beside a point at (x, y), at least `gap` away; all in pixels."""

    text: str
    x: float
    y: float
    gap: float


def draw_text(text: str, x: float, y: float, scale: float, size: float = SIZE, colour: Sequence[float] = TEXT) -> None:
    """Letters on a line that starts at (x, y)."""
    blf.size(_FONT, size * scale)
    blf.color(_FONT, *colour)
    blf.position(_FONT, x, y, 0.0)
    blf.draw(_FONT, text)


def text_width(text: str, scale: float, size: float = SIZE) -> float:
    """Pixels that letters take."""
    blf.size(_FONT, size * scale)
    return blf.dimensions(_FONT, text)[0]


def draw_boxes(boxes: Sequence[Box], colour: Sequence[float] = PAPER) -> None:
    """Filled rectangles."""
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    corners = [place for a, b, c, d in boxes for place in ((a, b, 0), (c, b, 0), (c, d, 0), (a, d, 0))]
    triangles = [(4 * i + j, 4 * i + k, 4 * i + m) for i in range(len(boxes)) for j, k, m in ((0, 1, 2), (0, 2, 3))]
    gpu.state.blend_set("ALPHA")
    shader.bind()
    shader.uniform_float("color", colour)
    batch_for_shader(shader, "TRIS", {"pos": corners}, indices=triangles).draw(shader)
    gpu.state.blend_set("NONE")


def draw_labels(labels: Sequence[tuple[Box, str]], scale: float) -> None:
    """Texts on their boxes."""
    if labels:
        draw_boxes([box for box, _ in labels])
    for (left, bottom, _, _), text in labels:
        draw_text(text, left + 4 * scale, bottom + 4.5 * scale, scale)


def spread_labels(
    wanted: Sequence[Label], marks: Sequence[Box], scale: float, width: float, height: float
) -> Iterator[tuple[Box, str]]:
    """Boxes of labels in a region of this width and height; the first ones have their choice.

    None lies over another one, over one of the `marks` or out of the region: one without room is left out.
    """
    taken = list(marks)
    tall = (SIZE + 7) * scale
    for text, x, y, gap in wanted:
        wide = text_width(text, scale) + 8 * scale
        across = 0.7 * gap
        for left, bottom in (
            (x + gap, y - tall / 2),
            (x - gap - wide, y - tall / 2),
            (x - wide / 2, y + gap),
            (x - wide / 2, y - gap - tall),
            (x + across, y + across),
            (x - across - wide, y + across),
            (x + across, y - across - tall),
            (x - across - wide, y - across - tall),
        ):
            box = (left, bottom, left + wide, bottom + tall)
            inside = left >= 0 and bottom >= 0 and box[2] <= width and box[3] <= height
            if inside and not any(_touch(box, other) for other in taken):
                taken.append(box)
                yield box, text
                break


def _touch(one: Box, other: Box) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]
