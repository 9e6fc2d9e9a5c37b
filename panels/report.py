"""What the figures of a retargeting say."""

from bpy.types import Context, Panel

from .tab import Step


class FACIAL_RETARGET_PT_report(Step, Panel):
    """Where the report goes."""

    bl_label = "6. Report"
    bl_order = 6
    bl_options = {"DEFAULT_CLOSED"}
    step = "REPORT"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        task = context.scene.facial_retarget
        layout.prop(task, "report")
        layout.prop(task, "page")
