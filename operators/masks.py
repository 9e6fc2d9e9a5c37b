"""Painted masks of the target."""

from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import filled
from .polls import has_target


class OnTargetInAnyMode:
    """For operators on the target, while it is painted too."""

    @classmethod
    def poll(cls, context: Context) -> bool:
        """A target must be chosen."""
        return has_target(cls, context)


class FACIAL_RETARGET_OT_add_mask(OnTargetInAnyMode, Operator):
    """Let a vertex group of the target make the motion weaker or stronger; one is made if there is none to take"""

    bl_idname = "facial_retarget.add_mask"
    bl_label = "Add Mask"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: Context) -> set[str]:
        """List it."""
        from ..facial_retarget_addon.bridge.gains import add_mask

        add_mask(context.scene.facial_retarget)
        return {"FINISHED"}


class FACIAL_RETARGET_OT_remove_mask(OnTargetInAnyMode, Operator):
    """Take the mask off the list; its vertex group stays"""

    bl_idname = "facial_retarget.remove_mask"
    bl_label = "Remove Mask"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: Context) -> bool:
        """As `OnTargetInAnyMode`; there must be a mask."""
        if not super().poll(context):
            return False
        if not len(context.scene.facial_retarget.masks):
            cls.poll_message_set(filled("There is no mask"))
            return False
        return True

    def execute(self, context: Context) -> set[str]:
        """Remove it."""
        from ..facial_retarget_addon.bridge.gains import remove_mask

        remove_mask(context.scene.facial_retarget)
        return {"FINISHED"}
