"""A Blender workspace for retargeting: source and target side by side, each from the front."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import numpy as np
from bpy.types import Area, Context, Depsgraph, Object, Region, Window, WorkSpace
from mathutils import Matrix

from ...core.arrays import FloatArray
from ...core.mpeg4.head import gives_axes, head_axes
from ..heads import head_parts
from ..points.point_places import world_places

NAME, MARK = "Retarget", "facial_retarget"
"""What the workspace is called, and the custom property that it is known by under any name."""
TURN = 0.02
"""Seconds that Blender has between two steps."""
TIMELINE = 0.14
"""Share of the window's height."""
MARGIN = 1.5
"""Height and width of what a view shows, in those of the face."""
BARS = {"TOOLS": "toolbar", "UI": "ui"}
"""The bars at the sides of a 3D view -> what Blender's switches call them."""
LENS, SHOWN = 50.0, 1.44
"""Blender's usual lens, and what a 3D view shows with it along its longer side, in view distances."""
BLENDERS_AXES = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
"""To the left, up and forward of a head that faces Blender's front view."""


def open_steps(window: Window) -> Iterator[float]:
    """Open the workspace of retargeting, made if there is none, and aim its two first 3D views at source and target.

    For a timer: yields after how many seconds to go on, as Blender opens workspaces and draws new editors in between.
    An operator would stand in an editor that is closed under it.
    """
    known = next((space for space in bpy.data.workspaces if MARK in space), None)
    space = known or _new_workspace(window)
    window.workspace = space
    while window.workspace != space:
        yield TURN
    if known is None:
        _lay_out(window)
    while not all(area.width for area in window.screen.areas):
        yield TURN
    views = sorted((area for area in window.screen.areas if area.type == "VIEW_3D"), key=lambda area: area.x)
    if known is None:
        for view in views:
            _dress(view, view == views[-1])
        while not _shows_tab(views[-1]):
            yield TURN
    task = window.scene.facial_retarget
    for view, face in zip(views, (task.source, task.target), strict=False):
        with bpy.context.temp_override(window=window, area=view, region=_region(view, "WINDOW")):
            _isolate(bpy.context, view, face)
            _aim(view, face, bpy.context.evaluated_depsgraph_get())


def _new_workspace(window: Window) -> WorkSpace:
    before = set(bpy.data.workspaces)
    with bpy.context.temp_override(window=window):
        bpy.ops.workspace.duplicate()
    (made,) = set(bpy.data.workspaces) - before
    made.name, made[MARK] = NAME, True
    return made


def _lay_out(window: Window) -> None:
    """Two 3D views above a timeline, made out of whatever the window shows."""
    while len(window.screen.areas) > 1:
        smallest = min(window.screen.areas, key=lambda area: area.width * area.height)
        with bpy.context.temp_override(window=window, area=smallest):
            if bpy.ops.screen.area_close() != {"FINISHED"}:
                break
    (area,) = window.screen.areas
    area.type = "VIEW_3D"
    _split(window, area, "HORIZONTAL", TIMELINE).ui_type = "TIMELINE"
    _split(window, area, "VERTICAL", 0.5)


def _dress(view: Area, with_sidebar: bool) -> None:
    """Solid shading with the faces' own colours, nothing in the way, and the sidebar in one of the two."""
    space = view.spaces.active
    space.shading.type, space.shading.color_type = "SOLID", "VERTEX"
    space.overlay.show_floor = space.overlay.show_axis_x = space.overlay.show_axis_y = False
    space.show_region_ui = with_sidebar


def _split(window: Window, area: Area, direction: str, factor: float) -> Area:
    """Split an area; returns the new one, which lies to the left of it or below it."""
    before = set(window.screen.areas)
    with bpy.context.temp_override(window=window, area=area):
        bpy.ops.screen.area_split(direction=direction, factor=factor)
    (made,) = set(window.screen.areas) - before
    return made


def _shows_tab(view: Area) -> bool:
    """Whether the sidebar shows the panels; it can only be told to once it was drawn."""
    sidebar = _region(view, "UI")
    if sidebar.is_property_readonly("active_panel_category"):
        return False
    sidebar.active_panel_category = NAME
    return sidebar.active_panel_category == NAME


def _region(view: Area, kind: str) -> Region:
    return next(region for region in view.regions if region.type == kind)


def _isolate(context: Context, view: Area, face: Object) -> None:
    """Let a view show a face and what belongs to it alone; what is selected stays so."""
    selected, active = context.selected_objects, context.view_layer.objects.active
    if view.spaces.active.local_view is not None:
        bpy.ops.view3d.localview(frame_selected=False)
    alone = {face, *head_parts(face), *face.children_recursive}
    for thing in context.view_layer.objects:
        thing.select_set(thing in alone)
    bpy.ops.view3d.localview(frame_selected=False)
    for thing in context.view_layer.objects:
        thing.select_set(thing in selected)
    context.view_layer.objects.active = active


def _aim(view: Area, face: Object, depsgraph: Depsgraph) -> None:
    """Turn a view to the front of a face and fit the face into what the sidebar leaves free."""
    places, axes = _face_places(face, depsgraph)
    low, high = (places @ axes.T).min(axis=0), (places @ axes.T).max(axis=0)
    whole, left, right = _region(view, "WINDOW"), _covered(view, "TOOLS"), _covered(view, "UI")
    size = MARGIN * (high - low)
    pixel = max(size[0] / max(whole.width - left - right, 1), size[1] / whole.height)
    middle = 0.5 * (low + high) + [0.5 * (right - left) * pixel, 0.0, 0.0]
    shown = view.spaces.active.region_3d
    shown.view_perspective = "ORTHO"
    shown.view_rotation = Matrix(axes.T.tolist()).to_quaternion()
    shown.view_location = middle @ axes
    shown.view_distance = pixel * max(whole.width, whole.height) / SHOWN * view.spaces.active.lens / LENS


def _covered(view: Area, kind: str) -> int:
    """Pixels of a view's width that a bar at its side covers."""
    return _region(view, kind).width if getattr(view.spaces.active, f"show_region_{BARS[kind]}") else 0


def _face_places(face: Object, depsgraph: Depsgraph) -> tuple[FloatArray, FloatArray]:
    """(n, 3) places in the world that a view of a face must hold, and (3, 3) the head's left, up and forward.

    Its feature points if they tell the axes; else the corners of its bounds, in Blender's own front view.
    """
    names, places = world_places(face, depsgraph)
    if gives_axes(names):
        return places, head_axes(names, places)
    matrix = np.array(face.matrix_world)
    return np.array(face.bound_box) @ matrix[:3, :3].T + matrix[:3, 3], BLENDERS_AXES
