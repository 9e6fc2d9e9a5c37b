"""Job files, for the command line."""

from bpy.types import Context, Panel

from .tab import RetargetTab


class FACIAL_RETARGET_PT_job(RetargetTab, Panel):
    """Save the task as a job file, or load one."""

    bl_label = "Job"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(context.scene.facial_retarget, "output")
        row = layout.row(align=True)
        row.operator("facial_retarget.load_job")
        row.operator("facial_retarget.save_job")
