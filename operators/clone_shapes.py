"""Clone a head's shape keys onto others, and solve them again from what the artist has corrected."""

from typing import Any

from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import told
from .errors import tells_user
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
        from ..facial_retarget_addon.bridge.cloning.cloning import clone_steps

        return clone_steps(context)

    def finish(self, result: Any) -> None:
        """Pass on the warnings."""
        for warning in result.warnings:
            self.report({"WARNING"}, told(warning))
        kept = f"; {result.kept} kept" if result.kept else ""
        heads = f" onto {result.heads} heads" if result.heads > 1 else ""
        self.report({"INFO"}, told(f"{result.cloned} shape keys cloned{heads}" + kept))


class FACIAL_RETARGET_OT_find_corrected(OnCloning, Operator):
    """Mark the cloned shape keys that you have changed as corrected; Re-solve does it by itself too"""

    bl_idname = "facial_retarget.find_corrected"
    bl_label = "Mark Changed Keys"
    bl_options = {"REGISTER", "UNDO"}

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Compare the keys with what was cloned."""
        from ..facial_retarget_addon.bridge.cloning.resolving import mark_corrected

        self.report({"INFO"}, told(f"{mark_corrected(context)} shape keys are corrected"))
        return {"FINISHED"}


class FACIAL_RETARGET_OT_resolve_shapes(OnCloning, InSteps, Operator):
    """Solve the cloned shape keys again from those that you have corrected, which stay as they are; Esc stops"""

    bl_idname = "facial_retarget.resolve_shapes"
    bl_label = "Re-Solve"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Solving"

    def steps(self, context: Context) -> Any:
        """Read, compute, write."""
        from ..facial_retarget_addon.bridge.cloning.resolving import resolve_steps

        return resolve_steps(context)

    def finish(self, result: Any) -> None:
        """Pass on the warnings."""
        for warning in result.warnings:
            self.report({"WARNING"}, told(warning))
        self.report({"INFO"}, told(f"{result.solved} shape keys solved again, from {result.corrected} corrected ones"))
