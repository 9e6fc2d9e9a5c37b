"""What becomes of the baked performance, and the task as a job file."""

from bpy.types import Context, Panel

from .tab import RetargetTab, Step


class FACIAL_RETARGET_PT_export(Step, Panel):
    """What was baked, and the way out of Blender."""

    bl_label = "5. Bake and Export"
    bl_order = 5
    bl_options = {"DEFAULT_CLOSED"}
    step = "EXPORT"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        self.layout.operator("facial_retarget.export_gltf", icon="EXPORT")
        row = self.layout.row(align=True)
        row.operator("facial_retarget.export_curves", icon="FCURVE")
        row.operator("facial_retarget.export_faps")


class FACIAL_RETARGET_PT_job(RetargetTab, Panel):
    """Save the task as a job file, or load one."""

    bl_label = "Job for the Command Line"
    bl_parent_id = "FACIAL_RETARGET_PT_export"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(context.scene.facial_retarget, "output")
        row = layout.row(align=True)
        row.operator("facial_retarget.load_job")
        row.operator("facial_retarget.save_job")
