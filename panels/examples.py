"""Example expressions: how far each one is, and what can be done with it."""

from bpy.types import Context, Panel, PropertyGroup, UILayout, UIList

from ..facial_retarget_addon.translations import OURS, filled, told
from .tab import Step, draw_text


class FACIAL_RETARGET_UL_examples(UIList):
    """An example: what the others would miss of it, what it is on source and target, and the buttons to sculpt it."""

    def draw_item(
        self, context: Context, layout: UILayout, data: PropertyGroup, item: PropertyGroup, icon: int, active: object
    ) -> None:
        """Draw a row."""
        row = layout.row(align=True)
        row.label(text=item.name, icon="ERROR" if item.warning else "NONE", translate=False)
        if item.checked:
            figure = row.row(align=True)
            figure.alignment = "RIGHT"
            missing = item.fit if item.leave_one_out < 0 else item.leave_one_out
            figure.label(text=f"{missing:.0%}", translate=False)
        for side in ("source", "target"):
            _draw_side(row.row(align=True), data.sculpting, item, side)


def _draw_side(row: UILayout, sculpting: PropertyGroup, item: PropertyGroup, side: str) -> None:
    """What an example is on one face, and the button to sculpt it there."""
    row.alignment = "RIGHT"
    row.label(icon_value=UILayout.enum_item_icon(item, f"{side}_state", getattr(item, f"{side}_state")))
    here = sculpting.thing is not None and sculpting.example == item.name and sculpting.side == side.upper()
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
        layout.label(
            text="Neutral: the Basis of both faces"
            if task.source_neutral == "BASIS"
            else "Neutral: the source's frame, the target's Basis"
        )
        row = layout.row()
        row.template_list("FACIAL_RETARGET_UL_examples", "", task, "examples", task, "active_example", rows=6)
        buttons = row.column(align=True)
        buttons.operator("facial_retarget.add_example", text="", icon="ADD")
        buttons.operator("facial_retarget.remove_example", text="", icon="REMOVE")
        if task.active_example in range(len(task.examples)):
            _draw_chosen(layout, context, task.examples[task.active_example])
        layout.operator_menu_enum("facial_retarget.rough_out", "way", text="Rough Out All on Target")
        layout.operator("facial_retarget.check_examples")


def _draw_chosen(layout: UILayout, context: Context, example: PropertyGroup) -> None:
    """What is wrong with the chosen example, how well it is met, and what can be done with it on either face."""
    if example.warning:
        draw_text(layout, context, told(example.warning), "ERROR")
    if example.checked and example.leave_one_out < 0:
        draw_text(layout, context, filled("Met but for {fit:.1%} of its motion", fit=example.fit), "CHECKMARK")
    elif example.checked:
        figures = {"fit": example.fit, "share": example.leave_one_out}
        text = "Met but for {fit:.1%} of its motion; without it {share:.0%} would be missing"
        draw_text(layout, context, filled(text, **figures), "CHECKMARK")
    columns = layout.row()
    for side, label in (("SOURCE", "Source"), ("TARGET", "Target")):
        column = columns.column(align=True)
        column.label(text=label)
        for button in (
            column.operator("facial_retarget.sculpt_example", text="Sculpt", text_ctxt=OURS, icon="SCULPTMODE_HLT"),
            column.operator_menu_enum("facial_retarget.rough_out", "way", icon="OUTLINER_DATA_POINTCLOUD"),
            column.operator_menu_enum("facial_retarget.mirror_example", "way", icon="MOD_MIRROR"),
            column.operator("facial_retarget.scale_example", icon="FULLSCREEN_ENTER"),
        ):
            button.example, button.side = example.name, side
