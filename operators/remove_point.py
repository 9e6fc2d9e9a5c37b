"""Remove a feature point from the active face."""

from bpy.types import Context, Operator

from .errors import tells_user
from .polls import OnChosen


class FACIAL_RETARGET_OT_remove_point(OnChosen, Operator):
    """Remove the chosen feature point from the active face"""

    bl_idname = "facial_retarget.remove_point"
    bl_label = "Remove Feature Point"
    bl_options = {"REGISTER", "UNDO"}

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Remove the point that is chosen in the list."""
        from ..facial_retarget_addon.bridge.points.point_prediction import update_predictions
        from ..facial_retarget_addon.bridge.points.points import remove_point

        face = context.active_object.facial_retarget
        remove_point(context.active_object, face.points[face.active_point].name)
        update_predictions(context.active_object)
        return {"FINISHED"}
