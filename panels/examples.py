"""Example expressions: how far each one is, and what can be done with it."""

from bpy.types import Context, Panel, PropertyGroup, UILayout, UIList

from .tab import Step, draw_text, filled


class FACIAL_RETARGET_UL_examples(UIList):
    """An example: what it is on source and target, and the buttons to sculpt it there."""

    def draw_item(
        self, context: Context, layout: UILayout, data: PropertyGroup, item: PropertyGroup, icon: int, active: object
    ) -> None:
        """Draw a row."""
        split = layout.split(factor=0.5)
        split.label(text=item.name, icon="ERROR" if item.warning else "SHAPEKEY_DATA")
        row = split.row(align=True)
        for side in ("source", "target"):
            state = getattr(item, f"{side}_state")
            row.label(icon_value=UILayout.enum_item_icon(item, f"{side}_state", state))
            here = data.sculpting.thing is not None and (data.sculpting.example, data.sculpting.side) == (
                item.name,
                side.upper(),
            )
            sculpt = row.operator("facial_retarget.sculpt_example", text="", icon="SCULPTMODE_HLT", depress=here)
            sculpt.example, sculpt.side = item.name, side.upper()


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
        if task.sculpting.thing is not None:
            row = layout.row()
            where = {"example": task.sculpting.example, "face": task.sculpting.thing.name}
            row.label(text=filled("{example} on {face}", **where), icon="SCULPTMODE_HLT", translate=False)
            row.operator("facial_retarget.stop_sculpting", icon="CHECKMARK")
        split = layout.split(factor=0.5)
        split.label(text="Example")
        sides = split.row()
        sides.label(text="Source")
        sides.label(text="Target")
        row = layout.row()
        row.template_list("FACIAL_RETARGET_UL_examples", "", task, "examples", task, "active_example", rows=6)
        buttons = row.column(align=True)
        buttons.operator("facial_retarget.add_example", text="", icon="ADD")
        buttons.operator("facial_retarget.remove_example", text="", icon="REMOVE")
        if task.active_example in range(len(task.examples)):
            _draw_chosen(layout, context, task.examples[task.active_example])


def _draw_chosen(layout: UILayout, context: Context, example: PropertyGroup) -> None:
    """What is wrong with the chosen example."""
    if example.warning:
        draw_text(layout, context, example.warning, "ERROR")
