"""One line at the top that always says what to do next, with the button that does it."""

from bpy.types import Context, Panel

from ..facial_retarget_addon import guide
from .tab import RetargetTab, draw_text, filled


class FACIAL_RETARGET_PT_next(RetargetTab, Panel):
    """What to do next."""

    bl_label = "Next"
    bl_options = {"HIDE_HEADER"}
    bl_order = 0

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        advice = guide.advice(context)
        box = self.layout.box()
        draw_text(box, context, filled(advice.text, **advice.fields), icon="INFO")
        if advice.operator:
            button = box.operator(advice.operator, icon="PLAY")
            for name, value in advice.options.items():
                setattr(button, name, value)
