"""The FAP controls of the active face."""

from bpy.types import Context, Panel

from ..facial_retarget_addon.fap_controls import GROUPS
from .tab import RetargetTab


class FACIAL_RETARGET_PT_faps(RetargetTab, Panel):
    """A slider for each FAP that the face can show, by MPEG-4's groups."""

    bl_label = "FAPs"
    bl_parent_id = "FACIAL_RETARGET_PT_motion"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        row = layout.row(align=True)
        row.operator("facial_retarget.make_controls")
        row.operator("facial_retarget.remove_controls", text="", icon="X")
        thing = context.active_object
        if thing is None or thing.type != "MESH" or thing.data.shape_keys is None:
            return
        keys = thing.data.shape_keys.key_blocks
        for group, controls in GROUPS.items():
            shown = [control for control in controls if control.name in thing and control.key in keys]
            if shown:
                header, body = layout.panel(f"facial_retarget_{group}", default_closed=True)
                header.label(text=group)
                if body is not None:
                    column = body.column(align=True)
                    for control in shown:
                        column.prop(thing, control.path, text=f"{control.fap.number} {control.fap.name}")
