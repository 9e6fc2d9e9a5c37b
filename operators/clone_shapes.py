"""Clone a head's shape keys onto others, and solve them again from what the artist has corrected."""

from typing import Any

from bpy.types import Context, Operator

from .in_steps import InSteps
from .polls import OnCloning


class FACIAL_RETARGET_OT_clone_shapes(OnCloning, InSteps, Operator):
    """Give one or several heads the shape keys of another, all objects of the head in one go; Esc stops"""

    bl_idname = "facial_retarget.clone_shapes"
    bl_label = "Clone Shape Keys"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Cloning"

    def steps(self, context: Context) -> Any:
        """Read, compute, write."""
        from ..facial_retarget_addon.bridge.cloning import clone_steps

        return clone_steps(context)

    def finish(self, result: Any) -> None:
        """Pass on the warnings."""
        for warning in result.warnings:
            self.report({"WARNING"}, warning)
        kept = f", {result.kept} kept" if result.kept else ""
        heads = f" on each of {result.heads} heads" if result.heads > 1 else ""
        self.report({"INFO"}, f"{result.cloned} shape keys cloned{heads}{kept}")
