"""The feature-point tool in the 3D view's toolbar, and what the status bar says while it is chosen."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
from bpy.app.translations import pgettext_iface
from bpy.types import Context, Header, Object, UILayout, WorkSpaceTool

from ..core.point_sets import POINT_INFOS, point_label
from .state import TOOL, active_face, tool_is_active


class FACIAL_RETARGET_TOOL_points(WorkSpaceTool):
    """Places feature points."""

    bl_space_type = "VIEW_3D"
    bl_context_mode = "OBJECT"
    bl_idname = TOOL
    bl_label = "Feature Points"
    bl_description = (
        "Click on the active face to place the point whose turn it is.\n"
        "Drag a point along the surface, Ctrl-click removes it"
    )
    bl_icon = str(Path(__file__).with_name("feature_points"))  # .dat, made by build_icon.py
    bl_cursor = "CROSSHAIR"
    bl_keymap = (
        ("facial_retarget.place_point", {"type": "LEFTMOUSE", "value": "PRESS"}, None),
        ("facial_retarget.drop_point", {"type": "LEFTMOUSE", "value": "PRESS", "ctrl": True}, None),
        ("facial_retarget.skip_point", {"type": "TAB", "value": "PRESS"}, None),
        (
            "facial_retarget.skip_point",
            {"type": "TAB", "value": "PRESS", "shift": True},
            {"properties": [("back", True)]},
        ),
        ("facial_retarget.accept_hovered", {"type": "RET", "value": "PRESS"}, None),
        ("facial_retarget.accept_hovered", {"type": "NUMPAD_ENTER", "value": "PRESS"}, None),
        ("facial_retarget.accept_points", {"type": "RET", "value": "PRESS", "shift": True}, None),
        ("facial_retarget.accept_points", {"type": "NUMPAD_ENTER", "value": "PRESS", "shift": True}, None),
        (
            "wm.context_toggle",
            {"type": "X", "value": "PRESS"},
            {"properties": [("data_path", "scene.facial_retarget.mirror_points")]},
        ),
    )

    def draw_settings(context: Context, layout: UILayout, tool: Any) -> None:  # noqa: N805 Blender calls it so
        """The tool's settings, and whose turn it is, in the header."""
        thing = active_face(context)
        if thing is None:
            layout.label(text="Select a face", icon="INFO")
            return
        _prepare_soon(thing)
        face, task = thing.facial_retarget, context.scene.facial_retarget
        layout.prop(face, "point_set")
        row = layout.row(align=True)
        row.prop(task, "mirror_points", text="X", icon="MOD_MIRROR", toggle=True)
        row.prop(task.overlay, "show_names", text="", icon="FONT_DATA", toggle=True)
        if len(face.proposals):
            layout.operator("facial_retarget.accept_points")
        elif face.turn:
            layout.operator("facial_retarget.guess_points")
        layout.label(text=_whose_turn(face.turn), icon="DECORATE_KEYFRAME", translate=False)


def _prepare_soon(thing: Object) -> None:
    """Once for each object: have its predictor made, a moment after the header is drawn."""
    if thing.session_uid in _asked:
        return
    _asked.add(thing.session_uid)
    name = thing.name

    def prepare() -> None:
        from ..bridge.points.point_preparation import prepare_predictions  # loads SciPy, which enabling does not

        found = bpy.data.objects.get(name)
        if found is not None and len(found.data.polygons):
            prepare_predictions(found)

    bpy.app.timers.register(prepare, first_interval=0.1)


def _whose_turn(name: str) -> str:
    if not name:
        return pgettext_iface("All points of the set are placed or skipped")
    told = pgettext_iface("Next: {label} – {meaning}")
    return told.format(label=pgettext_iface(point_label(name)), meaning=pgettext_iface(POINT_INFOS[name].meaning))


_asked: set[int] = set()
"""Objects whose predictor was asked for."""

KEYS = (
    (("MOUSE_LMB",), "Place"),
    (("MOUSE_LMB_DRAG",), "Slide"),
    (("EVENT_CTRL", "MOUSE_LMB"), "Remove"),
    (("EVENT_TAB",), "Skip"),
    (("EVENT_SHIFT", "EVENT_TAB"), "Go Back"),
    (("EVENT_X",), "Mirror"),
    (("EVENT_RETURN",), "Accept"),
    (("EVENT_SHIFT", "EVENT_RETURN"), "Accept All"),
)
"""Icons of the keys, and what they do."""


def _draw_keys(header: Header, context: Context) -> None:
    """The keys, in the status bar."""
    if not tool_is_active(context):
        return
    row = header.layout.row(align=True)
    for icons, text in KEYS:
        for icon in icons[:-1]:
            row.label(text="", icon=icon)
        row.label(text=text, icon=icons[-1])


def register() -> None:
    """Put the tool into the toolbar."""
    bpy.utils.register_tool(FACIAL_RETARGET_TOOL_points, separator=True)
    bpy.types.STATUSBAR_HT_header.prepend(_draw_keys)


def unregister() -> None:
    """Take it out again."""
    bpy.types.STATUSBAR_HT_header.remove(_draw_keys)
    bpy.utils.unregister_tool(FACIAL_RETARGET_TOOL_points)
