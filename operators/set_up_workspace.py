"""A workspace with source and target side by side."""

import bpy
from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import filled
from .polls import OnTask


class FACIAL_RETARGET_OT_set_up_workspace(OnTask, Operator):
    """Show source and target side by side in a workspace of their own, each from the front; deleting it undoes this"""

    bl_idname = "facial_retarget.set_up_workspace"
    bl_label = "Set Up Workspace"

    @classmethod
    def poll(cls, context: Context) -> bool:
        """As `OnTask`; there must be a window."""
        if bpy.app.background:
            cls.poll_message_set(filled("Workspaces need a window"))
            return False
        return super().poll(context)

    def execute(self, context: Context) -> set[str]:
        """Begin: the rest is done by a timer."""
        from ..facial_retarget_addon.bridge.scene.workspace import open_steps

        steps = open_steps(context.window)
        bpy.app.timers.register(lambda: next(steps, None))
        return {"FINISHED"}
