"""The heat map over the target: a figure of each vertex as colour, and what the colours mean."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import gpu
import numpy as np
from bpy.types import Context, Object
from gpu.types import GPUBatch
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix

from ..core.errors import RetargetError
from ..translations import filled
from .changes import look
from .labels import PAPER, draw_boxes, draw_text, text_width
from .shaders import RAMP, drawing, heat_shader, lens


class Scale(NamedTuple):
    """What a kind of map shows: its title, figures of no and of full colour, and how figures are written."""

    title: str
    low: float
    high: float
    form: str


SCALES = {
    "STRETCH": Scale("Stretch, times the neutral length", 1.0, 3.0, "{:.1f}×"),
    "BEYOND": Scale("Stretch beyond the source's, times", 1.0, 3.0, "{:.1f}×"),
    "MOTION": Scale("Difference from the source's motion, of the head's size", 0.0, 5.0, "{:.1f} %"),
}
"""An edge counts as torn from 3 times its length on, where the source's is calm."""


@dataclass(frozen=True, eq=False)
class Heat:
    """The map of one face: of what it was made, the largest figure, and why it cannot be drawn."""

    state: Any
    batch: GPUBatch | None
    largest: float
    trouble: str


_made: list[Heat] = []
_figures: list[Any] = []


def forget() -> None:
    """Drop everything: another file is open."""
    _made.clear()
    _figures.clear()


def heated(context: Context) -> Object | None:
    """The face that bears the map: the target, or the active face without one; None where it is not to be seen."""
    task = context.scene.facial_retarget
    thing = task.target or context.active_object
    if context.mode != "OBJECT" or thing is None or thing.type != "MESH":
        return None
    return thing if thing.visible_get(viewport=context.space_data) else None


def heat_of(context: Context, thing: Object) -> Heat:
    """The map of a face, made anew only where something has changed."""
    task, face = context.scene.facial_retarget, thing.facial_retarget
    source = face.findings_source
    state = (thing.session_uid, look(thing), 0 if source is None else look(source), task.overlay.heat, face.counterpart)
    if not _made or _made[0].state != state:
        _made[:] = [_make(context, thing, state)]
    return _made[0]


def draw_heat(context: Context, thing: Object, view: Matrix, projection: Matrix) -> None:
    """Draw the map over the surface."""
    heat = heat_of(context, thing)
    if heat.batch is None:
        return
    scale = SCALES[context.scene.facial_retarget.overlay.heat]
    shader = heat_shader()
    shader.bind()
    shader.uniform_float("matrix", projection @ view)
    shader.uniform_float("lens", lens(projection))
    shader.uniform_float("viewport", gpu.state.viewport_get()[2:])
    shader.uniform_float("low", scale.low)
    shader.uniform_float("high", scale.high)
    with drawing("LESS_EQUAL", writes_depth=True):
        heat.batch.draw(shader)


def draw_legend(context: Context, thing: Object) -> str:
    """Draw the bar of colours with its figures; returns why there is no map, "" where all is well."""
    heat = heat_of(context, thing)
    if heat.trouble:
        return heat.trouble
    ui = context.preferences.system.ui_scale
    scale = SCALES[context.scene.facial_retarget.overlay.heat]
    title = f"{filled(scale.title)}; {filled('largest {value}', value=scale.form.format(heat.largest))}"
    left, bottom, wide, tall = 78 * ui, 52 * ui, 190 * ui, 10 * ui
    right = left + max(wide, text_width(title, ui)) + 8 * ui
    draw_boxes([(left - 8 * ui, bottom - 20 * ui, right, bottom + tall + 22 * ui)], PAPER)
    _draw_bar(left, bottom, wide, tall)
    draw_text(title, left, bottom + tall + 7 * ui, ui)
    for share, mark in ((0.0, ""), (0.5, ""), (1.0, "≥ ")):
        text = mark + scale.form.format(scale.low + share * (scale.high - scale.low))
        draw_text(text, left + share * (wide - text_width(text, ui, 10)), bottom - 13 * ui, ui, 10)
    return ""


def _draw_bar(left: float, bottom: float, wide: float, tall: float) -> None:
    """The colours of the scale, clear at its low end as on the face."""
    shares = [0.0, 0.25, *(stop / (len(RAMP) - 1) for stop in range(1, len(RAMP)))]
    corners, colours = [], []
    for share in shares:
        place = share * (len(RAMP) - 1)
        first = min(int(place), len(RAMP) - 2)
        mixed = np.array(RAMP[first]) + (place - first) * (np.array(RAMP[first + 1]) - RAMP[first])
        corners += [(left + share * wide, bottom, 0), (left + share * wide, bottom + tall, 0)]
        colours += [(*mixed.tolist(), min(share / 0.25, 1.0))] * 2
    shader = gpu.shader.from_builtin("SMOOTH_COLOR")
    gpu.state.blend_set("ALPHA")
    shader.bind()
    batch_for_shader(shader, "TRI_STRIP", {"pos": corners, "color": colours}).draw(shader)
    gpu.state.blend_set("NONE")


def _make(context: Context, thing: Object, state: Any) -> Heat:
    from ..bridge.points.point_places import shown_vertices
    from ..bridge.reports.heat import HeatFigures  # loads SciPy, which enabling does not

    if not _figures:
        _figures.append(HeatFigures())
    task, depsgraph = context.scene.facial_retarget, context.view_layer.depsgraph
    try:
        values = _figures[0].values(task, thing, task.overlay.heat, depsgraph)
    except RetargetError as error:
        return Heat(state, None, 0.0, str(error))
    places = shown_vertices(thing, depsgraph)
    largest = float(np.nanmax(values)) if np.isfinite(values).any() else 0.0
    drawn = np.nan_to_num(values, nan=-1.0, posinf=1e6).astype(np.float32)
    corners = {"pos": places.astype(np.float32), "value": drawn}
    batch = batch_for_shader(heat_shader(), "TRIS", corners, indices=_figures[0].triangles(thing))
    return Heat(state, batch, largest, "")
