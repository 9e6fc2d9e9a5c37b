"""What is drawn over the 3D views: marks of the points, their names, and the diagram of a face."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import bpy
import gpu
from bpy.app.handlers import persistent
from bpy.app.translations import pgettext_iface
from bpy.types import Context, Object, SpaceView3D
from mathutils import Matrix

from ..core.point_sets import point_label
from ..translations import filled, told
from . import base, heat, trouble
from .base import base_batches
from .diagram import draw_diagram
from .faces import FaceMarks, face_marks, forget, shown_faces
from .heat import draw_heat, draw_legend, heated
from .hover import hovered
from .labels import Box, Label, draw_labels, draw_trouble, spread_labels
from .lines import draw_lines
from .marks import COLOURS, DOUBTFUL, draw_marks
from .projection import screen_places
from .shaders import linear
from .trouble import draw_trouble_spots

LINE, WARNING = linear(0.86, 0.92, 0.98), COLOURS[DOUBTFUL]
"""Of the base mesh, and of its triangles that fold over."""

_handles: list[object] = []
_names: dict[int, tuple[Any, list[tuple[Box, str]]]] = {}
"""Labels by the region's address, and of what they were placed: a view that stands still places none anew."""


def _shows(context: Context) -> bool:
    """Whether the view shows overlays at all."""
    return context.space_data.overlay.show_overlays


def _draw_places() -> None:
    """In the world: the heat map, the base mesh, and the marks over it."""
    context = bpy.context
    wanted = context.scene.facial_retarget.overlay
    if not ((wanted.show_points or wanted.show_base or wanted.show_heat) and _shows(context)):
        return
    view, projection = gpu.matrix.get_model_view_matrix(), gpu.matrix.get_projection_matrix()
    if wanted.show_heat and (hot := heated(context)) is not None:
        draw_heat(context, hot, view, projection)
        draw_trouble_spots(context, hot, view, projection)
    for thing in shown_faces(context):
        if wanted.show_base:
            _draw_base(context, thing, view, projection)
        if wanted.show_points:
            _draw_marks(context, thing, view, projection)


def _draw_marks(context: Context, thing: Object, view: Matrix, projection: Matrix) -> None:
    marks = face_marks(context, thing)
    if len(marks.names):
        hot = hovered().row if hovered().thing == thing.session_uid else -1
        draw_marks(marks.batch, view, projection, marks.mark_size(context, max(thing.dimensions)), hot, flat=False)


def _draw_base(context: Context, thing: Object, view: Matrix, projection: Matrix) -> None:
    batches = base_batches(context, thing)
    if batches is None:
        return
    scale = context.preferences.system.ui_scale
    lines, folded = batches
    draw_lines(lines, view, projection, scale, LINE, 0.75)
    if folded is not None:
        draw_lines(folded, view, projection, 2.5 * scale, WARNING, through=True)


def _draw_pixels() -> None:
    """On the region: names, and the diagram."""
    context = bpy.context
    wanted = context.scene.facial_retarget.overlay
    if not _shows(context):
        return
    scale = context.preferences.system.ui_scale
    if wanted.show_points:
        _draw_names(context, scale, wanted.show_names)
    if wanted.show_diagram:
        draw_diagram(context)
    troubles = [face_marks(context, thing).trouble for thing in shown_faces(context)] if wanted.show_points else []
    troubles += [base.trouble()] if wanted.show_base else []
    if wanted.show_heat and (hot := heated(context)) is not None:
        troubles.append(draw_legend(context, hot))
    draw_trouble(context, told(next(filter(None, troubles), "")))


def _draw_names(context: Context, scale: float, every: bool) -> None:
    """The name of the point under the mouse in full, and the short ones of all that we see if they are wanted."""
    region = context.region
    faces = [(face_marks(context, thing), thing) for thing in shown_faces(context)]
    view = tuple(value for row in context.region_data.perspective_matrix for value in row)
    state = (view, region.width, region.height, scale, every, hovered(), *(marks for marks, _ in faces))
    known = _names.get(region.as_pointer())
    if known is None or known[0] != state:
        known = _names[region.as_pointer()] = (state, _placed_names(context, scale, every, faces))
    draw_labels(known[1], scale)


def _placed_names(
    context: Context, scale: float, every: bool, faces: Sequence[tuple[FaceMarks, Object]]
) -> list[tuple[Box, str]]:
    full, short, boxes = [], [], []
    for marks, thing in faces:
        hot = hovered().row if hovered().thing == thing.session_uid else -1
        if not len(marks.names) or not (every or 0 <= hot < len(marks.names)):
            continue
        at, ahead = screen_places(context, marks.places)
        seen = ahead & marks.facing(context)
        size = marks.mark_size(context, max(thing.dimensions))
        for row in seen.nonzero()[0].tolist():
            x, y = at[row].tolist()
            if row == hot:
                full.append(Label(_full_name(marks, row), x, y, size + 4 * scale))
            elif every:
                short.append(Label(marks.names[row], x, y, size + 4 * scale))
                boxes.append((x - size, y - size, x + size, y + size))
    width, height = context.region.width, context.region.height
    placed = list(spread_labels(full, (), scale, width, height))
    boxes += [box for box, _ in placed]
    return placed + list(spread_labels(short, boxes, scale, width, height))


def _full_name(marks: FaceMarks, row: int) -> str:
    """Number, label, and what is wrong with a point."""
    name = marks.names[row]
    label = point_label(name)
    shown = pgettext_iface(label)
    text = shown if name in (label, "") or not name[0].isdigit() else f"{name} {shown}"
    if name in marks.doubts:
        return f"{text}: {told(marks.doubts[name])}"
    return filled("{label} (proposed)", label=text) if row >= marks.placed else text


@persistent
def _forget(*_: object) -> None:
    forget()
    _names.clear()
    for part in (base, heat, trouble):
        part.forget()


def register() -> None:
    """Draw in all 3D views; `gpu` needs a window."""
    if bpy.app.background:
        return
    add = SpaceView3D.draw_handler_add
    _handles.append(add(_draw_places, (), "WINDOW", "POST_VIEW"))
    _handles.append(add(_draw_pixels, (), "WINDOW", "POST_PIXEL"))
    bpy.app.handlers.load_pre.append(_forget)


def unregister() -> None:
    """Draw no longer."""
    if bpy.app.background:
        return
    bpy.app.handlers.load_pre.remove(_forget)
    while _handles:
        SpaceView3D.draw_handler_remove(_handles.pop(), "WINDOW")
    _forget()
