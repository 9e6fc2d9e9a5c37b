"""Show what each level of the motion adds."""

from typing import Any

from bpy.types import Context, Operator

from ..facial_retarget_addon.core.methods.settings import LEVELED
from ..facial_retarget_addon.translations import told
from .in_steps import InSteps
from .polls import OnTask


class FACIAL_RETARGET_OT_show_levels(OnTask, InSteps, Operator):
    """Show beside the target what each level adds at the current frame: one slider per level; Esc stops"""

    bl_idname = "facial_retarget.show_levels"
    bl_label = "Show Levels"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Taking the frame apart"

    @classmethod
    def poll(cls, context: Context) -> bool:
        """As `OnTask`; the method must work level by level."""
        if context.scene.facial_retarget.method not in LEVELED:
            cls.poll_message_set(told(f"This method has no levels; {' and '.join(LEVELED)} have"))
            return False
        return super().poll(context)

    def steps(self, context: Context) -> Any:
        """Read the frame, compute, show."""
        from ..facial_retarget_addon.bridge.retargeting import level_steps

        return level_steps(context)

    def finish(self, result: list[str]) -> None:
        """Name the levels."""
        self.report({"INFO"}, told(f"Levels: {', '.join(result)}"))
