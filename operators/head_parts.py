"""List the objects that belong to the head of the active face."""

from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import told
from .errors import tells_user
from .polls import OnChosen, OnFace


class FACIAL_RETARGET_OT_add_parts(OnFace, Operator):
    """List the selected objects as parts of the active face's head: eyes, teeth, tongue, lashes, brows"""

    bl_idname = "facial_retarget.add_parts"
    bl_label = "Add Selected Parts"
    bl_options = {"REGISTER", "UNDO"}

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Add those that are not listed yet; their names tell their roles."""
        from ..facial_retarget_addon.bridge.part_list import add_parts

        count = add_parts(context.active_object, context.selected_objects)
        self.report({"INFO"}, told(f"{count} parts added"))
        return {"FINISHED"}


class FACIAL_RETARGET_OT_remove_part(OnChosen, Operator):
    """Take the chosen part off the list; its object stays"""

    bl_idname = "facial_retarget.remove_part"
    bl_label = "Remove Part"
    bl_options = {"REGISTER", "UNDO"}
    listed, chosen, missing = "parts", "active_part", "Choose a part in the list"

    def execute(self, context: Context) -> set[str]:
        """Take the part off that is chosen in the list."""
        face = context.active_object.facial_retarget
        face.parts.remove(face.active_part)
        face.active_part = max(face.active_part - 1, 0)
        return {"FINISHED"}
