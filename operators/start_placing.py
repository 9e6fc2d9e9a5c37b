"""Take the feature-point tool and a face in hand."""

import bpy
from bpy.props import EnumProperty
from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import filled
from ..facial_retarget_addon.viewport.state import TOOL
from .polls import OnTask


class FACIAL_RETARGET_OT_start_placing(OnTask, Operator):
    """Make the source or the target the active object, and choose the feature-point tool"""

    bl_idname = "facial_retarget.start_placing"
    bl_label = "Place Points"
    bl_options = {"REGISTER", "UNDO"}

    role: EnumProperty(
        name="Role",
        items=[("SOURCE", "Source", "The face that moves"), ("TARGET", "Target", "The face that shall move")],
        description="Which of the two faces gets points",
    )

    @classmethod
    def poll(cls, context: Context) -> bool:
        """As `OnTask`; the tool stands in 3D views."""
        if context.area is None or context.area.type != "VIEW_3D":
            cls.poll_message_set(filled("Points are placed in a 3D view"))
            return False
        return super().poll(context)

    def execute(self, context: Context) -> set[str]:
        """Select the face alone, then change the tool."""
        face = getattr(context.scene.facial_retarget, self.role.lower())
        for thing in context.view_layer.objects:
            thing.select_set(thing == face)
        context.view_layer.objects.active = face
        bpy.ops.wm.tool_set_by_id(name=TOOL)
        return {"FINISHED"}
