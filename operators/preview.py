"""The target follows the source live."""

from typing import Any

from bpy.types import Context, Operator

from ..facial_retarget_addon.preview_state import STATE
from .in_steps import InSteps
from .polls import OnTask


class FACIAL_RETARGET_OT_start_preview(OnTask, InSteps, Operator):
    """Fit the method, and let the target follow while you scrub, play, or drag sliders of the source; Esc stops"""

    bl_idname = "facial_retarget.start_preview"
    bl_label = "Live Preview"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Fitting"

    def steps(self, context: Context) -> Any:
        """Fit, then follow."""
        from ..facial_retarget_addon.bridge.preview import preview_steps

        return preview_steps(context)

    def finish(self, result: None) -> None:
        """Say what to do."""
        self.report({"INFO"}, "The target follows the source")


class FACIAL_RETARGET_OT_stop_preview(Operator):
    """Turn the preview off: the target is as it was before, and no file holds anything of it"""

    bl_idname = "facial_retarget.stop_preview"
    bl_label = "Live Preview"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: Context) -> bool:
        """The preview must be on, and its shape key within reach."""
        if not STATE.on:
            cls.poll_message_set("The live preview is off")
            return False
        if context.mode == "EDIT_MESH":
            cls.poll_message_set("Leave Edit Mode")
            return False
        return True

    def execute(self, context: Context) -> set[str]:
        """Stop."""
        from ..facial_retarget_addon.bridge.preview import stop_preview

        stop_preview()
        return {"FINISHED"}
