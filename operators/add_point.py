"""Add a feature point to the active face."""

from bpy.props import EnumProperty, StringProperty
from bpy.types import Context, Event, Operator

from .errors import tells_user
from .polls import OnFace


class FACIAL_RETARGET_OT_add_point(OnFace, Operator):
    """Add a named feature point to the active face"""

    bl_idname = "facial_retarget.add_point"
    bl_label = "Add Feature Point"
    bl_options = {"REGISTER", "UNDO"}
    modes = ("OBJECT", "EDIT_MESH")

    name: StringProperty(name="Name", description="Its MPEG-4 number, such as 2.1, or a name of your own")
    place: EnumProperty(
        name="Place",
        description="Where the point is put",
        items=[
            ("CURSOR", "3D Cursor", "Where the surface is closest to the 3D cursor"),
            ("VERTEX", "Selected Vertex", "On the one vertex that is selected"),
        ],
    )

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Ask for the name; in Edit Mode the selected vertex is meant."""
        self.place = "VERTEX" if context.mode == "EDIT_MESH" else "CURSOR"
        return context.window_manager.invoke_props_dialog(self)

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Add the point."""
        from ..facial_retarget_addon.bridge.points import points
        from ..facial_retarget_addon.bridge.points.point_prediction import update_predictions

        thing = context.active_object
        if self.place == "VERTEX":
            points.add_point_at_vertex(thing, self.name, points.selected_vertex(thing))
        else:
            points.add_point_near(thing, self.name, context.scene.cursor.location)
        update_predictions(thing)
        return {"FINISHED"}
