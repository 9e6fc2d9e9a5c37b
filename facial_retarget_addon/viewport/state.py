"""What the 3D view knows for the moment, shared by the tool and the drawing: never saved, not undone."""

from __future__ import annotations

from bpy.types import Context, Object

from ..core.errors import RetargetError

TOOL = "facial_retarget.feature_points"
"""The feature-point tool's name."""


def tool_is_active(context: Context) -> bool:
    """Whether the feature-point tool is chosen in this workspace."""
    tool = context.workspace.tools.from_space_view3d_mode("OBJECT", create=False)
    return tool is not None and tool.idname == TOOL and context.mode == "OBJECT"


def active_face(context: Context) -> Object | None:
    """The mesh object that the tool works on."""
    thing = context.active_object
    return thing if thing is not None and thing.type == "MESH" else None


def needed_face(context: Context) -> Object:
    """The mesh object that the tool works on; RetargetError without one, or if it must not be changed."""
    thing = active_face(context)
    if thing is None:
        raise RetargetError("no mesh object is active: select the face first")
    if not thing.is_editable:
        raise RetargetError(f"object {thing.name!r} is linked from another file: make it local to give it points")
    return thing
