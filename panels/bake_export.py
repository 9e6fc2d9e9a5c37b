"""What becomes of the baked performance, and the task as a job file."""

from bpy.types import Context, Panel, UILayout

from ..facial_retarget_addon.export_losses import export_losses
from ..facial_retarget_addon.translations import filled
from .tab import RetargetTab, Step, draw_text


class FACIAL_RETARGET_PT_export(Step, Panel):
    """The way out of Blender, and what it costs."""

    bl_label = "5. Bake and Export"
    bl_order = 5
    bl_options = {"DEFAULT_CLOSED"}
    step = "EXPORT"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        task = context.scene.facial_retarget
        export = task.export
        layout.row(align=True).prop(export, "form", expand=True)
        if export.form == "USD":
            layout.prop(export, "points")
        if task.target is not None:
            draw_losses(layout, context, export.form, export.form == "USD" and export.points)
        column = layout.column(align=True)
        button = column.operator(f"facial_retarget.export_{export.form.lower()}", icon="EXPORT")
        if export.form == "USD":
            button.points = export.points
        column.operator("facial_retarget.prepare_export", icon="DUPLICATE")
        row = layout.row(align=True)
        row.operator("facial_retarget.export_curves", icon="FCURVE")
        row.operator("facial_retarget.export_faps")


def draw_losses(layout: UILayout, context: Context, form: str, points: bool) -> None:
    """What an export of the target will lose."""
    scene = context.scene
    for loss in export_losses(form, scene.facial_retarget.target, scene, points):
        draw_text(layout, context, filled(loss.text, **loss.fields), icon="ERROR")


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
