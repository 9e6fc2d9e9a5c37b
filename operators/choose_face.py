"""Make the active object the source or the target."""

from bpy.props import EnumProperty
from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import told
from .polls import OnFace


class FACIAL_RETARGET_OT_choose_face(OnFace, Operator):
    """Make the active object the face that moves, or the face that shall move"""

    bl_idname = "facial_retarget.choose_face"
    bl_label = "Use Active Object"
    bl_options = {"REGISTER", "UNDO"}

    role: EnumProperty(
        name="Role",
        items=[("SOURCE", "Source", "The face that moves"), ("TARGET", "Target", "The face that shall move")],
        description="Which of the two faces the active object becomes",
    )

    def execute(self, context: Context) -> set[str]:
        """Choose it, unless it is the other face already."""
        task, face = context.scene.facial_retarget, context.active_object
        other = "target" if self.role == "SOURCE" else "source"
        if getattr(task, other) == face:
            self.report({"ERROR"}, told(f"{face.name!r} is the {other} already: select another object"))
            return {"CANCELLED"}
        setattr(task, self.role.lower(), face)
        return {"FINISHED"}
