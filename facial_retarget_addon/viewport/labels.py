"""Names beside points: the one under the mouse in full, or all of them in short, never one over another."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import blf
import gpu
import numpy as np
from bpy.types import Context
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
    taken = np.empty((len(marks) + len(wanted), 4))
    taken[: len(marks)] = np.array(marks).reshape(-1, 4)
    count, tall = len(marks), (SIZE + 7) * scale
    for text, x, y, gap in wanted:
        wide, across = text_width(text, scale) + 8 * scale, 0.7 * gap
        lower_left = np.array(
            [
                (x + gap, y - tall / 2),
                (x - gap - wide, y - tall / 2),
                (x - wide / 2, y + gap),
                (x - wide / 2, y - gap - tall),
                (x + across, y + across),
                (x - across - wide, y + across),
                (x + across, y - across - tall),
                (x - across - wide, y - across - tall),
            ]
        )
        boxes = np.concatenate([lower_left, lower_left + (wide, tall)], axis=1)
        inside = (boxes[:, :2] >= 0).all(axis=1) & (boxes[:, 2:] <= (width, height)).all(axis=1)
        apart = (boxes[:, None, 2:] <= taken[:count, :2]) | (taken[:count, 2:] <= boxes[:, None, :2])
        free = inside & apart.any(axis=2).all(axis=1)
        if free.any():
            taken[count] = boxes[free.argmax()]
            yield tuple(taken[count].tolist()), text
            count += 1


def draw_trouble(context: Context, text: str) -> None:
    """A line at the lower edge of a view that says why something is not drawn; nothing without a text."""
    if text:
        scale = context.preferences.system.ui_scale
        x, y = 70 * scale, 14 * scale
        draw_boxes([(x, y, x + text_width(text, scale) + 8 * scale, y + (SIZE + 7) * scale)])
        draw_text(text, x + 4 * scale, y + 4.5 * scale, scale, colour=(1.0, 0.85, 0.3, 1.0))
