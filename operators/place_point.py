"""Place a feature point on the active face, or slide one along it."""

from bpy.props import FloatVectorProperty, StringProperty
from bpy.types import Context, Event, Operator

from ..facial_retarget_addon.core.errors import RetargetError
from ..facial_retarget_addon.translations import told
from .errors import tells_user
from .polls import in_mode


class WithTool:
    """For operators of the feature-point tool: what is wrong with a click is said, and nothing pops up."""

    @classmethod
    def poll(cls, context: Context) -> bool:
        """In Object Mode; what else is missing the operator tells."""
        return in_mode(cls, context)

    def answer(self, error: Exception) -> set[str]:
        """Say in the status bar what is wrong."""
        self.report({"WARNING"}, told(str(error)))
        return {"CANCELLED"}


class FACIAL_RETARGET_OT_place_point(WithTool, Operator):
    """Place the feature point whose turn it is, or slide the one under the mouse along the surface"""

    bl_idname = "facial_retarget.place_point"
    bl_label = "Place Feature Point"
    bl_options = {"REGISTER", "UNDO"}

    name: StringProperty(name="Name", description="The point to place; the one whose turn it is if none is named")
    location: FloatVectorProperty(
        name="Location", size=3, subtype="TRANSLATION", description="Where the surface is closest to it, in world space"
    )

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Take the point, or place it, and follow the mouse while the button is held."""
        from ..facial_retarget_addon.viewport.point_drag import PointDrag

        try:
            self._drag = PointDrag(context, event)
        except RetargetError as error:
            return self.answer(error)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: Context, event: Event) -> set[str]:
        """Slide, put down, or put back."""
        if event.type in {"ESC", "RIGHTMOUSE"}:
            self._drag.put_back()
            return {"CANCELLED"}
        if event.type == "LEFTMOUSE" and event.value == "RELEASE":
            self.name, self.location = self._drag.put_down()
            return {"FINISHED"} if self._drag.changed else {"CANCELLED"}
        if event.type == "MOUSEMOVE":
            self._drag.move(event)
        return {"RUNNING_MODAL"}

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Place it where the surface is closest to the location."""
        from ..facial_retarget_addon.bridge.points.point_moves import put_point_near
        from ..facial_retarget_addon.viewport.state import needed_face

        depsgraph, mirrored = context.evaluated_depsgraph_get(), context.scene.facial_retarget.mirror_points
        self.name = put_point_near(needed_face(context), depsgraph, self.name, self.location, mirrored)
        return {"FINISHED"}
