"""Remove the feature point under the mouse."""

from bpy.props import StringProperty
from bpy.types import Context, Event, Operator

from ..facial_retarget_addon.core.errors import RetargetError
from .errors import tells_user
from .place_point import WithTool


class FACIAL_RETARGET_OT_drop_point(WithTool, Operator):
    """Remove the feature point under the mouse"""

    bl_idname = "facial_retarget.drop_point"
    bl_label = "Remove Hovered Point"
    bl_options = {"REGISTER", "UNDO"}

    name: StringProperty(name="Name", description="The point to remove", options={"SKIP_SAVE"})

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Find the point under the mouse."""
        from ..facial_retarget_addon.viewport.point_drag import placed_point

        try:
            self.name = placed_point(context, event)
        except RetargetError as error:
            return self.answer(error)
        return self.execute(context)

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Remove it, and its partner with X Mirror."""
        from ..facial_retarget_addon.bridge.points.point_moves import drop_point
        from ..facial_retarget_addon.viewport.state import needed_face

        drop_point(needed_face(context), self.name, context.scene.facial_retarget.mirror_points)
        return {"FINISHED"}
