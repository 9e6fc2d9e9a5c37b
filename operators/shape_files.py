"""Load and save the shape keys of the active head."""

from pathlib import Path
from typing import Any

from bpy.props import EnumProperty, StringProperty
from bpy.types import Context, Operator
from bpy_extras.io_utils import ExportHelper, ImportHelper

from ..facial_retarget_addon.properties.cloning import EXISTING_KEYS
from ..facial_retarget_addon.translations import told
from .in_steps import FromBrowser, InSteps
from .polls import OnFace


class FACIAL_RETARGET_OT_load_shapes(OnFace, FromBrowser, ImportHelper, InSteps, Operator):
    """Give the active face and its parts the shapes of a facial animation table (.json) or arrays (.npz); Esc stops"""

    bl_idname = "facial_retarget.load_shapes"
    bl_label = "Load Shape Keys"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Loading the shapes"

    filter_glob: StringProperty(default="*.json;*.npz", options={"HIDDEN"})
    existing: EnumProperty(
        name="Existing Keys", items=EXISTING_KEYS, description="What becomes of shape keys that are there already"
    )

    def steps(self, context: Context) -> Any:
        """Read, check against the head, then write."""
        from ..facial_retarget_addon.bridge.cloning.shape_tables import load_shapes_steps

        return load_shapes_steps(context.active_object, Path(self.filepath), self.existing)

    def finish(self, result: Any) -> None:
        """Count them."""
        self.report({"INFO"}, told(f"{result.made} shape keys loaded, {result.kept} kept"))


class FACIAL_RETARGET_OT_save_shapes(OnFace, FromBrowser, ExportHelper, InSteps, Operator):
    """Save the shape keys of the active face and its parts: an animation table (.json) or arrays (.npz); Esc stops"""

    bl_idname = "facial_retarget.save_shapes"
    bl_label = "Save Shape Keys"
    doing = "Saving the shapes"

    filename_ext = ".json"
    check_extension = None  # another suffix is another kind of file
    filter_glob: StringProperty(default="*.json;*.npz", options={"HIDDEN"})

    def steps(self, context: Context) -> Any:
        """Read the keys, then write the file, whole or not at all."""
        from ..facial_retarget_addon.bridge.cloning.shape_tables import save_shapes_steps

        return save_shapes_steps(context.active_object, Path(self.filepath))

    def finish(self, result: int) -> None:
        """Count them."""
        self.report({"INFO"}, told(f"{result} shape keys saved"))
