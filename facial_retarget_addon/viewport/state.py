"""What the 3D view knows for the moment, shared by the tool and the drawing: never saved, not undone."""

from __future__ import annotations

from dataclasses import dataclass

from bpy.types import Context, Object

from ..core.point_sets import next_point

TOOL = "facial_retarget.feature_points"
"""The feature-point tool's name."""


@dataclass
class Hand:
    """What the mouse has to do with, as names of feature points of the active face; "" for none."""

    hovered: str = ""
    dragged: str = ""


HAND = Hand()
"""The one mouse there is."""


def tool_is_active(context: Context) -> bool:
    """Whether the feature-point tool is chosen in this workspace."""
    tool = context.workspace.tools.from_space_view3d_mode("OBJECT", create=False)
    return tool is not None and tool.idname == TOOL and context.mode == "OBJECT"


def active_face(context: Context) -> Object | None:
    """The mesh object that the tool works on."""
    thing = context.active_object
    return thing if thing is not None and thing.type == "MESH" else None


def turn(thing: Object) -> str:
    """The name of the point whose turn it is to be placed; "" if none of the set is left."""
    face = thing.facial_retarget
    return next_point(face.point_set, face.points.keys(), face.skipped.keys()) or ""
