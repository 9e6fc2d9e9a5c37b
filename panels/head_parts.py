"""The objects that belong to the head of the active face."""

from bpy.types import Context, Panel, PropertyGroup, UILayout, UIList

from .tab import RetargetTab


class FACIAL_RETARGET_UL_parts(UIList):
    """An object and its role in each row."""

    def draw_item(
        self, context: Context, layout: UILayout, data: object, item: PropertyGroup, icon: int, active: object
    ) -> None:
        """Draw a row."""
        row = layout.row(align=True)
        row.prop(item, "thing", text="", emboss=False)
        row.prop(item, "role", text="", emboss=False)


class FACIAL_RETARGET_PT_parts(RetargetTab, Panel):
    """Parts of the head that are objects of their own."""

    bl_label = "Parts of the Head"
    bl_parent_id = "FACIAL_RETARGET_PT_points"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        thing = context.active_object
        if thing is None or thing.type != "MESH":
            layout.label(text="Select a face", icon="INFO")
            return
        face = thing.facial_retarget
        row = layout.row()
        row.template_list("FACIAL_RETARGET_UL_parts", "", face, "parts", face, "active_part", rows=3)
        buttons = row.column(align=True)
        buttons.operator("facial_retarget.add_parts", text="", icon="ADD")
        buttons.operator("facial_retarget.remove_part", text="", icon="REMOVE")
