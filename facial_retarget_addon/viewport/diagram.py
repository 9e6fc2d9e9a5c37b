"""The diagram in the corner of a view: where on a face the point lies whose turn it is."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import bpy
import gpu
import numpy as np
from bpy.app.translations import pgettext_iface
from bpy.types import Context
from gpu.types import GPUBatch
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix

from ..core.point_sets import DIAGRAM_HIGH, DIAGRAM_LOW, POINT_INFOS, POINT_SETS, PointInfo
from ..translations import filled
from .face_lines import face_lines
from .labels import draw_boxes, draw_text, text_width
from .marks import PLACED, SELECTED, draw_marks, mark_batch
from .state import active_face, tool_is_active

WIDTH, MARGIN, INSET = 168.0, 12.0, 10.0
"""Of the panel; its distance from the region's edges; of its contents from its own edges. Pixels at a UI scale of 1."""
LINES = 3
"""Lines that the meaning may take."""
PAPER, INK, FAINT = (0.07, 0.07, 0.07, 0.88), (0.72, 0.72, 0.72, 1.0), (0.75, 0.75, 0.75, 1.0)
_LEFT, _RIGHT, _LOW, _HIGH = -1.55, 1.55, DIAGRAM_LOW[1] - 0.05, DIAGRAM_HIGH[1] + 0.32


def draw_diagram(context: Context) -> None:
    """Draw it while the tool is chosen, unless all points of the set are placed or the region is too small."""
    thing = active_face(context)
    if thing is None or not tool_is_active(context) or not thing.facial_retarget.turn or not _is_main(context):
        return
    scale = context.preferences.system.ui_scale
    info = POINT_INFOS[thing.facial_retarget.turn]
    lines = wrapped(pgettext_iface(info.meaning), (WIDTH - 2 * INSET) * scale, scale)[:LINES]
    unit = (WIDTH - 2 * INSET) * scale / (_RIGHT - _LEFT)
    words = (INSET + 34 + 13 * len(lines)) * scale
    top = MARGIN * scale + words + unit * (_HIGH - _LOW) + INSET * scale
    right = context.region.width - _covered(context) - MARGIN * scale
    left, bottom = right - WIDTH * scale, MARGIN * scale
    if left < context.region.width / 2 or top > 0.6 * context.region.height:
        return
    draw_boxes([(left, bottom, right, top)], PAPER)
    at = (left + INSET * scale - unit * _LEFT, bottom + words - unit * _LOW)
    wanted = [one.name for one in POINT_SETS[thing.facial_retarget.point_set]]
    placed = [name for name in wanted if name in thing.facial_retarget.points]
    _draw_face(at, unit, scale)
    _draw_points(at, unit, scale, info.name, tuple(placed))
    count = filled("{placed} of {wanted}", placed=len(placed), wanted=len(wanted))
    _draw_words(info, lines, count, (left + INSET * scale, right - INSET * scale, bottom))


def _draw_words(info: PointInfo, lines: Sequence[str], count: str, place: tuple[float, float, float]) -> None:
    """Label, number, how many are placed, and meaning, between left and right of `place` and above its bottom."""
    scale = bpy.context.preferences.system.ui_scale
    left, right, bottom = place
    y = bottom + (INSET + 13 * len(lines)) * scale
    draw_text(pgettext_iface(info.label), left, y + 17 * scale, scale, 12)
    draw_text(info.name if info.name[0].isdigit() else "", left, y + 3 * scale, scale, 10, FAINT)
    draw_text(count, right - text_width(count, scale, 10), y + 3 * scale, scale, 10, FAINT)
    for i, line in enumerate(lines):
        draw_text(line, left, y - (10 + 13 * i) * scale, scale, 10, FAINT)


def wrapped(text: str, width: float, scale: float) -> list[str]:
    """A text in lines that are no wider than this many pixels."""
    lines = [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        if text_width(longer, scale, 10) > width and lines[-1]:
            lines.append(word)
        else:
            lines[-1] = longer
    return [line for line in lines if line]


def _is_main(context: Context) -> bool:
    """Whether the region is the whole view, or the lower right one of a quad view."""
    windows = [region for region in context.area.regions if region.type == "WINDOW"]
    return context.region == max(windows, key=lambda region: region.x - region.y)


def _covered(context: Context) -> float:
    """Pixels at the right edge of the region over which the sidebar lies."""
    if not context.preferences.system.use_region_overlap:
        return 0.0
    right = context.region.x + context.region.width
    sides = [region for region in context.area.regions if region.type == "UI" and region.width > 1]
    return max((right - region.x for region in sides if region.x < right), default=0.0)


@cache
def _lines() -> GPUBatch:
    """The face as pairs of places."""
    pairs = [np.stack([line[:-1], line[1:]], axis=1).reshape(-1, 2) for line in face_lines()]
    flat = np.concatenate(pairs)
    places = np.column_stack([flat, np.zeros(len(flat))]).astype(np.float32)
    return batch_for_shader(gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR"), "LINES", {"pos": places})


def _draw_face(at: Sequence[float], unit: float, scale: float) -> None:
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    gpu.state.blend_set("ALPHA")
    with gpu.matrix.push_pop():
        gpu.matrix.translate(at)
        gpu.matrix.scale_uniform(unit)
        shader.bind()
        shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
        shader.uniform_float("lineWidth", 1.2 * scale)
        shader.uniform_float("color", INK)
        _lines().draw(shader)
    gpu.state.blend_set("NONE")


def _draw_points(at: Sequence[float], unit: float, scale: float, wanted: str, placed: tuple[str, ...]) -> None:
    """Small discs for points that are placed, and a large mark for the one that is wanted."""
    view = gpu.matrix.get_model_view_matrix() @ Matrix.Translation((*at, 0.0)) @ Matrix.Scale(unit, 4)
    projection = gpu.matrix.get_projection_matrix()
    for names, shape, size in ((placed, PLACED, 2.0), ((wanted,), SELECTED, 4.5)):
        if names:
            draw_marks(_points(names, shape), view, projection, size * scale, -1, flat=True)


@cache
def _points(names: tuple[str, ...], shape: int) -> GPUBatch:
    places = np.array([(*POINT_INFOS[name].diagram, 0.0) for name in names])
    return mark_batch(places, [shape] * len(names))
