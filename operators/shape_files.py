"""Load and save the shape keys of the active head."""

from pathlib import Path

from bpy.props import EnumProperty, StringProperty
from bpy.types import Context, Operator
from bpy_extras.io_utils import ExportHelper, ImportHelper

from ..facial_retarget_addon.properties.cloning import EXISTING_KEYS
from .errors import tells_user
from .polls import OnFace


class FACIAL_RETARGET_OT_load_shapes(OnFace, Operator, ImportHelper):
    """Give the active face and its parts the shapes of a facial animation table (.json) or of arrays (.npz)"""

    bl_idname = "facial_retarget.load_shapes"
    bl_label = "Load Shape Keys"
    bl_options = {"REGISTER", "UNDO"}

    filter_glob: StringProperty(default="*.json;*.npz", options={"HIDDEN"})
    existing: EnumProperty(
        name="Existing Keys", items=EXISTING_KEYS, description="What becomes of shape keys that are there already"
    )

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Read, check against the head, then write."""
        from ..facial_retarget_addon.bridge.cloning.shape_tables import load_shapes

        made, kept = load_shapes(context.active_object, Path(self.filepath), self.existing)
        self.report({"INFO"}, f"{made} shape keys loaded, {kept} kept")
        return {"FINISHED"}


class FACIAL_RETARGET_OT_save_shapes(OnFace, Operator, ExportHelper):
    """Save the shape keys of the active face and its parts as a facial animation table (.json) or as arrays (.npz)"""

    bl_idname = "facial_retarget.save_shapes"
    bl_label = "Save Shape Keys"

    filename_ext = ".json"
    check_extension = None  # another suffix is another kind of file
    filter_glob: StringProperty(default="*.json;*.npz", options={"HIDDEN"})

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Write the file, whole or not at all."""
        from ..facial_retarget_addon.bridge.cloning.shape_tables import save_shapes

        self.report({"INFO"}, f"{save_shapes(context.active_object, Path(self.filepath))} shape keys saved")
        return {"FINISHED"}
