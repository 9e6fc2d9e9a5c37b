"""The target follows the source live."""

from typing import Any

from bpy.props import EnumProperty
from bpy.types import Context, Operator

from ..facial_retarget_addon.preview_state import STATE
from ..facial_retarget_addon.properties.methods import METHOD_ITEMS
from ..facial_retarget_addon.translations import filled
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
        from ..facial_retarget_addon.bridge.preview.preview import preview_steps

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
            cls.poll_message_set(filled("The live preview is off"))
            return False
        if context.mode == "EDIT_MESH":
            cls.poll_message_set(filled("Leave Edit Mode"))
            return False
        return True

    def execute(self, context: Context) -> set[str]:
        """Stop."""
        from ..facial_retarget_addon.bridge.preview.preview import stop_preview

        stop_preview()
        return {"FINISHED"}


class FACIAL_RETARGET_OT_compare(OnTask, InSteps, Operator):
    """Fit the chosen methods, measure each on some frames, and let the target follow by the one you pick; Esc stops"""

    bl_idname = "facial_retarget.compare"
    bl_label = "Compare"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Comparing"

    def steps(self, context: Context) -> Any:
        """Fit and measure."""
        from ..facial_retarget_addon.bridge.preview.preview import compare_steps

        return compare_steps(context)

    def finish(self, result: None) -> None:
        """Say what to do."""
        self.report({"INFO"}, "Click a method to see the target follow by it")


class FACIAL_RETARGET_OT_show_method(Operator):
    """Choose this method: the target follows by it at once"""

    bl_idname = "facial_retarget.show_method"
    bl_label = "Show Method"
    bl_options = {"REGISTER", "UNDO"}

    method: EnumProperty(name="Method", items=METHOD_ITEMS, description="The method to choose")

    def execute(self, context: Context) -> set[str]:
        """Choose it."""
        context.scene.facial_retarget.method = self.method
        return {"FINISHED"}
