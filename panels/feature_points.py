"""The feature points of the active face, and the base mesh made from them."""

from bpy.types import Context, Panel

from .tab import Step


class FACIAL_RETARGET_PT_points(Step, Panel):
    """Feature points of the active object."""

    bl_label = "2. Feature Points"
    bl_order = 2
    step = "POINTS"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        thing = context.active_object
        if thing is None or thing.type != "MESH":
            layout.label(text="Select a face", icon="INFO")
        else:
            face = thing.facial_retarget
            layout.label(text=f"{thing.name}: {len(face.points)} points")
            row = layout.row()
            row.template_list("UI_UL_list", "facial_retarget_points", face, "points", face, "active_point", rows=4)
            buttons = row.column(align=True)
            buttons.operator("facial_retarget.add_point", text="", icon="ADD")
            buttons.operator("facial_retarget.remove_point", text="", icon="REMOVE")
            files = layout.row(align=True)
            files.operator("facial_retarget.load_points", text="Load")
            files.operator("facial_retarget.save_points", text="Save")
        layout.separator()
        layout.operator("facial_retarget.show_base")
        layout.prop(context.scene.facial_retarget, "base", text="Own base")
