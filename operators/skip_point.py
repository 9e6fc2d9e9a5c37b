"""Skip the feature point whose turn it is."""

from bpy.props import BoolProperty
from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import OURS
from .errors import tells_user
from .place_point import WithTool


class FACIAL_RETARGET_OT_skip_point(WithTool, Operator):
    """Skip the feature point whose turn it is, or go back to the one that was skipped last"""

    bl_idname = "facial_retarget.skip_point"
    bl_label = "Skip Feature Point"
    bl_options = {"REGISTER", "UNDO"}

    back: BoolProperty(
        name="Back",
        description="Go back to the point that was skipped last",
        options={"SKIP_SAVE"},
        translation_context=OURS,
    )

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Skip, or go back."""
        from ..facial_retarget_addon.bridge.points.point_moves import go_back, skip_turn
        from ..facial_retarget_addon.viewport.state import needed_face

        thing = needed_face(context)
        if self.back:
            go_back(thing)
        else:
            skip_turn(thing)
        return {"FINISHED"}
