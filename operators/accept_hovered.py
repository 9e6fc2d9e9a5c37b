"""Accept the proposed feature point under the mouse."""

from bpy.props import StringProperty
from bpy.types import Context, Event, Operator

from ..facial_retarget_addon.core.errors import RetargetError
from .errors import tells_user
from .place_point import WithTool


class FACIAL_RETARGET_OT_accept_hovered(WithTool, Operator):
    """Place the proposed feature point under the mouse where it is proposed, or else the one whose turn it is"""

    bl_idname = "facial_retarget.accept_hovered"
    bl_label = "Accept Hovered Point"
    bl_options = {"REGISTER", "UNDO"}

    name: StringProperty(
        name="Name", description="The proposed point; the one whose turn it is if none is named", options={"SKIP_SAVE"}
    )

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Find the point under the mouse."""
        from ..facial_retarget_addon.viewport.point_drag import proposed_point

        try:
            self.name = proposed_point(context, event)
        except RetargetError as error:
            return self.answer(error)
        return self.execute(context)

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Accept it."""
        from ..facial_retarget_addon.bridge.points.point_moves import accept_point
        from ..facial_retarget_addon.viewport.state import needed_face

        accept_point(needed_face(context), self.name)
        return {"FINISHED"}
