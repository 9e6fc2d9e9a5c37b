"""Retarget the performance and bake it."""

from typing import Any

from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import told
from .in_steps import InSteps
from .polls import OnTask


class FACIAL_RETARGET_OT_retarget(OnTask, InSteps, Operator):
    """Retarget the source's performance and bake it on the target as one shape key per frame; Esc stops"""

    bl_idname = "facial_retarget.retarget"
    bl_label = "Retarget"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Retargeting"

    def steps(self, context: Context) -> Any:
        """Read, compute, bake."""
        from ..facial_retarget_addon.bridge.retargeting import retarget_steps

        self._target = context.scene.facial_retarget.target
        return retarget_steps(context)

    def finish(self, result: dict[str, Any]) -> None:
        """Pass on the report's warnings, and how many frames the report lists."""
        for warning in result.get("warnings", ()):
            self.report({"WARNING"}, told(warning))
        self.report({"INFO"}, told(f"Retargeted: {self._target.facial_retarget.findings_text}"))
