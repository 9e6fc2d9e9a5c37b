"""Build the base mesh and show it on both faces."""

from typing import Any

from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import told
from .in_steps import InSteps
from .polls import OnTask


class FACIAL_RETARGET_OT_show_base(OnTask, InSteps, Operator):
    """Build the base mesh from the feature points and show it on both faces, as wire objects; Esc stops"""

    bl_idname = "facial_retarget.show_base"
    bl_label = "Show Base Mesh"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Building"

    def steps(self, context: Context) -> Any:
        """Build, then show."""
        from ..facial_retarget_addon.bridge.points.base_steps import show_base_steps

        return show_base_steps(context)

    def finish(self, result: Any) -> None:
        """Pass on the warnings."""
        for warning in result.warnings:
            self.report({"WARNING"}, told(warning))
        self.report({"INFO"}, told(f"Base mesh of {len(result.names)} points and {len(result.faces)} triangles"))
