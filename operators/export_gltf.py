"""Hand the target's head to Blender's glTF exporter."""

from pathlib import Path

import bpy
from bpy.props import StringProperty
from bpy.types import Context, Operator
from bpy_extras.io_utils import ExportHelper

from ..facial_retarget_addon.translations import told
from .errors import tells_user
from .polls import OnTask


class FACIAL_RETARGET_OT_export_gltf(OnTask, Operator, ExportHelper):
    """Export the target and the parts of its head with their shape keys and animation, by Blender's glTF exporter"""

    bl_idname = "facial_retarget.export_gltf"
    bl_label = "Export glTF"

    filename_ext = ".glb"
    filter_glob: StringProperty(default="*.glb;*.gltf", options={"HIDDEN"})

    @classmethod
    def poll(cls, context: Context) -> bool:
        """As `OnTask`; the exporter must be enabled."""
        if not hasattr(bpy.types, "EXPORT_SCENE_OT_gltf"):
            cls.poll_message_set("Enable the add-on glTF 2.0 Format in the preferences")
            return False
        return super().poll(context)

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Export the head alone."""
        from ..facial_retarget_addon.bridge.scene.selection import head_selected

        with head_selected(context, context.scene.facial_retarget.target):
            bpy.ops.export_scene.gltf(filepath=self.filepath, use_selection=True)
        self.report({"INFO"}, told(f"Exported {Path(self.filepath).name}"))
        return {"FINISHED"}
