"""One line at the top that always says what to do next, with the button that does it."""

from bpy.types import Context, Panel, UILayout

from ..facial_retarget_addon import guide
from ..facial_retarget_addon.time_left import spoken
from ..facial_retarget_addon.translations import filled
from .tab import RetargetTab, draw_text


class FACIAL_RETARGET_PT_next(RetargetTab, Panel):
    """What to do next, or what is being computed."""

    bl_label = "Next"
    bl_options = {"HIDE_HEADER"}
    bl_order = 0

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Always."""
        return True

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        if context.window_manager.facial_retarget.running:
            draw_work(self.layout, context)
            return
        advice = guide.advice(context)
        box = self.layout.box()
        draw_text(box, context, filled(advice.text, **advice.fields), icon="INFO")
        if advice.operator:
            button = box.operator(advice.operator, icon="PLAY")
            for name, value in advice.options.items():
                setattr(button, name, value)


def draw_work(layout: UILayout, context: Context) -> None:
    """How far the work is, how long it still takes where that is known, and the button that stops it."""
    work = context.window_manager.facial_retarget
    layout.progress(factor=work.share, type="BAR", text=f"{filled(work.doing)} {work.share:.0%}", translate=False)
    text, fields = spoken(work.left)
    row = layout.row()
    row.label(text=filled(text, **fields), translate=False)
    row.operator("facial_retarget.stop", icon="CANCEL")
