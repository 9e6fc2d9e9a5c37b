"""Remove a feature point from the active face."""

from bpy.types import Context, Operator

from .errors import tells_user
from .polls import OnFace


class FACIAL_RETARGET_OT_remove_point(OnFace, Operator):
    """Remove the chosen feature point from the active face"""

    bl_idname = "facial_retarget.remove_point"
    bl_label = "Remove Feature Point"
    bl_options = {"REGISTER", "UNDO"}

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Remove the point that is chosen in the list."""
        from ..facial_retarget_addon.bridge.point_prediction import update_predictions
        from ..facial_retarget_addon.bridge.points import remove_point

        face = context.active_object.facial_retarget
        if face.active_point not in range(len(face.points)):
            self.report({"ERROR"}, f"{context.active_object.name} has no feature point to remove")
            return {"CANCELLED"}
        remove_point(context.active_object, face.points[face.active_point].name)
        update_predictions(context.active_object)
        return {"FINISHED"}
