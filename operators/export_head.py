"""Hand the target's head to Blender's exporters, or prepare it for others."""

from pathlib import Path
from typing import Any

import bpy
from bpy.props import BoolProperty, IntProperty, StringProperty
from bpy.types import Context, Operator
from bpy_extras.io_utils import ExportHelper

from ..facial_retarget_addon.translations import filled, told
from .in_steps import FromBrowser, InSteps
from .polls import OnTarget

SAMPLES = {
    "name": "Samples",
    "min": 0,
    "max": 8,
    "description": "How often each frame is sampled; 0 for as often as the keyframes between frames ask for",
}


class FACIAL_RETARGET_OT_prepare_export(OnTarget, InSteps, Operator):
    """Copy the target's head for any exporter: plain shape keys without drivers, each with a curve; Esc stops"""

    bl_idname = "facial_retarget.prepare_export"
    bl_label = "Prepare for Export"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Preparing"

    samples: IntProperty(**SAMPLES)

    def steps(self, context: Context) -> Any:
        """Read the keys' values, then make the copies."""
        from ..facial_retarget_addon.bridge.export.exporting import prepare_steps

        return prepare_steps(context, context.scene.facial_retarget.target, self.samples)

    def finish(self, result: Any) -> None:
        """Say where the copies are."""
        self.report({"INFO"}, told(f"{len(result)} objects prepared in the collection Export"))


class ExportHead(OnTarget, FromBrowser, ExportHelper, InSteps):
    """For operators that export the target's head: a format, and what it says where Blender has no exporter for it."""

    form, missing = "", ""
    doing = "Exporting"

    samples: IntProperty(**SAMPLES)
    only_lossless: BoolProperty(name="Only Without Loss", description="Write nothing if the format loses something")

    @classmethod
    def has_exporter(cls) -> bool:
        """Whether Blender has an exporter for the format."""
        built = bpy.app.build_options
        return {
            "GLTF": hasattr(bpy.types, "EXPORT_SCENE_OT_gltf"),
            "FBX": hasattr(bpy.types, "EXPORT_SCENE_OT_fbx"),
            "USD": built.usd,
            "ALEMBIC": built.alembic,
        }[cls.form]

    @classmethod
    def poll(cls, context: Context) -> bool:
        """As `OnTarget`; the exporter must be there."""
        if not cls.has_exporter():
            cls.poll_message_set(filled(cls.missing))
            return False
        return super().poll(context)

    def draw(self, context: Context) -> None:
        """Draw what will be lost beside the files, then the settings."""
        from ..panels.bake_export import draw_losses

        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(self, "samples")
        if self.form == "USD":
            layout.prop(self, "points")
        layout.prop(self, "only_lossless")
        draw_losses(layout, context, self.form, getattr(self, "points", False))

    def steps(self, context: Context) -> Any:
        """Say what will be lost, read the keys' values, write."""
        from ..facial_retarget_addon.bridge.export.exporting import ExportWish, export_steps

        points = getattr(self, "points", False)
        wish = ExportWish(self.form, Path(self.filepath), self.samples, points, self.only_lossless)
        target = context.scene.facial_retarget.target
        return export_steps(
            context, target, wish, lambda loss: self.report({"WARNING"}, filled(loss.text, **loss.fields))
        )

    def finish(self, result: Any) -> None:
        """Say what was written."""
        self.report({"INFO"}, told(f"Exported {result.path.name}, frames {result.first} to {result.last}"))


class FACIAL_RETARGET_OT_export_gltf(ExportHead, Operator):
    """Export the target and the parts of its head with their shape keys and animation, by Blender's glTF exporter"""

    bl_idname = "facial_retarget.export_gltf"
    bl_label = "Export glTF"

    form, missing = "GLTF", "Enable the add-on glTF 2.0 Format in the preferences"
    filename_ext = ".glb"
    filter_glob: StringProperty(default="*.glb", options={"HIDDEN"})


class FACIAL_RETARGET_OT_export_fbx(ExportHead, Operator):
    """Export the target and the parts of its head with their shape keys and animation, by Blender's FBX exporter"""

    bl_idname = "facial_retarget.export_fbx"
    bl_label = "Export FBX"

    form, missing = "FBX", "Enable the add-on FBX Format in the preferences"
    filename_ext = ".fbx"
    filter_glob: StringProperty(default="*.fbx", options={"HIDDEN"})


class FACIAL_RETARGET_OT_export_usd(ExportHead, Operator):
    """Export the target and the parts of its head, by Blender's USD exporter"""

    bl_idname = "facial_retarget.export_usd"
    bl_label = "Export USD"

    form, missing = "USD", "This Blender was built without USD"
    filename_ext = ".usdc"
    filter_glob: StringProperty(default="*.usdc;*.usda;*.usd", options={"HIDDEN"})
    points: BoolProperty(
        name="Moving Vertices",
        description="Write where the vertices are at each frame, whatever moves them, instead of shape keys",
    )


class FACIAL_RETARGET_OT_export_alembic(ExportHead, Operator):
    """Export the target and the parts of its head as moving vertices, by Blender's Alembic exporter"""

    bl_idname = "facial_retarget.export_alembic"
    bl_label = "Export Alembic"

    form, missing = "ALEMBIC", "This Blender was built without Alembic"
    filename_ext = ".abc"
    filter_glob: StringProperty(default="*.abc", options={"HIDDEN"})
