"""Copy the feature points of the active face to the other selected ones."""

from typing import Any

from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import filled, told
from .in_steps import InSteps
from .polls import OnFace


class FACIAL_RETARGET_OT_copy_points(OnFace, InSteps, Operator):
    """Copy the feature points of the active face to the other selected ones: exactly, or by a fit of other topology"""

    bl_idname = "facial_retarget.copy_points"
    bl_label = "Copy Points to Selected"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Copying points"

    @classmethod
    def poll(cls, context: Context) -> bool:
        """The active face must have points, and another mesh object be selected."""
        if not super().poll(context):
            return False
        if not len(context.active_object.facial_retarget.points):
            cls.poll_message_set(filled("The active object has no feature points to copy"))
            return False
        if not any(thing.type == "MESH" and thing != context.active_object for thing in context.selected_objects):
            cls.poll_message_set(filled("Select the faces that shall get the points, and the one that has them last"))
            return False
        return True

    def steps(self, context: Context) -> Any:
        """Find all places, then place the points."""
        from ..facial_retarget_addon.bridge.points.point_copies import copy_steps

        source = context.active_object
        targets = [thing for thing in context.selected_objects if thing.type == "MESH" and thing != source]
        return copy_steps(source, targets)

    def finish(self, result: list[Any]) -> None:
        """Say what became of each."""
        for copied in result:
            how = "exactly" if copied.exact else "through the fit of the surfaces"
            self.report({"INFO"}, told(f"{copied.thing.name}: {len(copied.points)} feature points copied {how}"))
