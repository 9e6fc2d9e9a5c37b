"""The live preview."""

from bpy.types import Context, Panel

from ..facial_retarget_addon.preview_state import STATE
from .tab import RetargetTab, draw_text, filled


class FACIAL_RETARGET_PT_preview(RetargetTab, Panel):
    """The target follows the source live."""

    bl_label = "Live Preview"
    bl_parent_id = "FACIAL_RETARGET_PT_retarget"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        if not STATE.on:
            layout.operator("facial_retarget.start_preview", icon="HIDE_ON")
            return
        row = layout.row(align=True)
        row.operator("facial_retarget.stop_preview", icon="HIDE_OFF", depress=True)
        row.operator("facial_retarget.start_preview", text="", icon="FILE_REFRESH")
        for text in (STATE.trouble, STATE.stale):
            if text:
                draw_text(layout, context, text, icon="ERROR")
        layout.label(text=filled("{milliseconds:.1f} ms a frame", milliseconds=STATE.milliseconds), icon="TIME")
