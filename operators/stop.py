"""Stop what is being computed, by a button."""

from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import filled


class FACIAL_RETARGET_OT_stop(Operator):
    """Stop what is being computed; nothing is changed then"""

    bl_idname = "facial_retarget.stop"
    bl_label = "Stop"

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Something must be computed."""
        if not context.window_manager.facial_retarget.running:
            cls.poll_message_set(filled("Nothing is being computed"))
            return False
        return True

    def execute(self, context: Context) -> set[str]:
        """Ask the operator that runs."""
        context.window_manager.facial_retarget.stop = True
        return {"FINISHED"}
