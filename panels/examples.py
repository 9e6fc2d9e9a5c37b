"""Example expressions."""

from bpy.types import Context, Panel

from .tab import Step


class FACIAL_RETARGET_PT_examples(Step, Panel):
    """Shape keys that both faces have and that show the same expression."""

    bl_label = "3. Examples"
    bl_order = 3
    bl_options = {"DEFAULT_CLOSED"}
    step = "EXAMPLES"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        task = context.scene.facial_retarget
        layout.operator("facial_retarget.create_examples")
        row = layout.row()
        row.template_list("UI_UL_list", "facial_retarget_examples", task, "examples", task, "active_example", rows=4)
        buttons = row.column(align=True)
        buttons.operator("facial_retarget.add_example", text="", icon="ADD")
        buttons.operator("facial_retarget.remove_example", text="", icon="REMOVE")
