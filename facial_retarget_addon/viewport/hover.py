"""Which point is under the mouse. An invisible gizmo hears of every move of the mouse, and never takes a click."""

from __future__ import annotations

from typing import Any, NamedTuple

import bpy
import numpy as np
from bpy.types import Context, Gizmo, GizmoGroup, Object

from ..core.arrays import FloatArray
from ..core.point_sets import FIRST_FIVE
from .faces import face_marks, shown_faces
from .projection import screen_places

REACH = 10.0
"""Pixels, at a UI scale of 1, between the mouse and a point that it is over."""
CLICK_REACH = 4.0
"""The same for a click on a proposal: farther away it places the point whose turn it is, where the artist clicks."""


class Hovered(NamedTuple):
    """A point of an object, by the object's session and the row of the point's mark; object 0 for none."""

    thing: int
    row: int


NOTHING = Hovered(0, -1)
_now = [NOTHING]


def hovered() -> Hovered:
    """The point under the mouse."""
    return _now[0]


def point_at(context: Context, mouse: tuple[float, float], clicked: bool = False) -> Hovered:
    """The point nearest to a place (2,) of the region, within reach and on the side that we see.

    Parameters
    ----------
    clicked : whether the place is clicked: then proposals have a smaller reach, and none while the placed points are
        too few to rely on.
    """
    scale = context.preferences.system.ui_scale
    best, found = REACH * scale, NOTHING
    for thing in shown_faces(context):
        marks = face_marks(context, thing)
        if len(marks.names):
            at, ahead = screen_places(context, marks.places)
            gaps = np.linalg.norm(at - mouse, axis=1)
            gaps[~(ahead & marks.facing(context))] = np.inf
            if clicked:
                reach = CLICK_REACH * scale if marks.placed >= len(FIRST_FIVE) else 0.0
                gaps[marks.placed :][gaps[marks.placed :] > reach] = np.inf
            row = int(gaps.argmin())
            if gaps[row] < best:
                best, found = float(gaps[row]), Hovered(thing.session_uid, row)
    return found


def point_under(context: Context, mouse: FloatArray, clicked: bool = True) -> tuple[Object | None, str]:
    """The face and the name of the point at a place (2,) of the region, as for `point_at`; None and "" without one."""
    if points_are_shown(context):
        found = point_at(context, (float(mouse[0]), float(mouse[1])), clicked)
        for thing in shown_faces(context):
            if thing.session_uid == found.thing:
                return thing, face_marks(context, thing).names[found.row]
    return None, ""


def points_are_shown(context: Context) -> bool:
    """Whether the view shows the marks of points at all."""
    return context.scene.facial_retarget.overlay.show_points and context.space_data.overlay.show_overlays


class FACIAL_RETARGET_GT_hover(Gizmo):
    """Follows the mouse."""

    bl_idname = "FACIAL_RETARGET_GT_hover"

    def draw(self, context: Context) -> None:
        """Nothing: the overlay draws."""

    def test_select(self, context: Context, location: Any) -> int:
        """Note the point under the mouse; -1 leaves the click to others."""
        found = point_at(context, tuple(location))
        if found != _now[0]:
            _now[0] = found
            context.area.tag_redraw()
        return -1


class FACIAL_RETARGET_GGT_hover(GizmoGroup):
    """Holds the gizmo that follows the mouse."""

    bl_idname = "FACIAL_RETARGET_GGT_hover"
    bl_label = "Feature Point Names"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_options = {"PERSISTENT", "SHOW_MODAL_ALL"}

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Only where points are drawn."""
        return points_are_shown(context) and next(shown_faces(context), None) is not None

    def setup(self, context: Context) -> None:
        """Make the gizmo."""
        self.gizmos.new(FACIAL_RETARGET_GT_hover.bl_idname)


_register_classes, _unregister_classes = bpy.utils.register_classes_factory(
    (FACIAL_RETARGET_GT_hover, FACIAL_RETARGET_GGT_hover)
)


def register() -> None:
    """Add the gizmo to all 3D views."""
    _register_classes()


def unregister() -> None:
    """Take it away."""
    _unregister_classes()
