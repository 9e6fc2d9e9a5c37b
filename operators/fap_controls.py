"""Make FAP controls on a face, and take them off again."""

from typing import Any

from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import told
from .in_steps import InSteps
from .polls import OnFace, OnPoints


class FACIAL_RETARGET_OT_make_controls(OnPoints, InSteps, Operator):
    """Give the active face a slider for each FAP: shape keys and drivers that work without this extension"""

    bl_idname = "facial_retarget.make_controls"
    bl_label = "Make FAP Controls"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Making controls"

    def steps(self, context: Context) -> Any:
        """Fit the face, then write properties, keys and drivers."""
        from ..facial_retarget_addon.bridge.motion.controls import make_controls_steps

        return make_controls_steps(context.active_object)

    def finish(self, result: list[str]) -> None:
        """Say which FAPs the face cannot show."""
        if result:
            self.report({"WARNING"}, told(f"{len(result)} FAPs have no points on this face: {', '.join(result)}"))
        self.report({"INFO"}, "Controls made")


class FACIAL_RETARGET_OT_remove_controls(OnFace, Operator):
    """Remove the FAP controls of the active face: sliders, their animation, drivers and shape keys"""

    bl_idname = "facial_retarget.remove_controls"
    bl_label = "Remove FAP Controls"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: Context) -> set[str]:
        """Remove them."""
        from ..facial_retarget_addon.bridge.motion.controls import remove_controls

        remove_controls(context.active_object)
        return {"FINISHED"}
