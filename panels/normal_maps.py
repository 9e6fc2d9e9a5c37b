"""Normal maps of the performance."""

from bpy.types import Context, Panel

from .tab import RetargetTab


class FACIAL_RETARGET_PT_normal_maps(RetargetTab, Panel):
    """What the maps are for, how they are written, and the button."""

    bl_label = "Normal Maps"
    bl_parent_id = "FACIAL_RETARGET_PT_export"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        maps = context.scene.facial_retarget.normal_maps
        layout.prop(maps, "light")
        if maps.light == "LEVEL":
            layout.prop(maps, "level")
        layout.prop(maps, "folder")
        column = layout.column(align=True)
        column.prop(maps, "pixels")
        column.prop(maps, "margin")
        layout.prop(maps, "depth")
        layout.prop(maps, "convention")
        layout.prop(maps, "wire")
        layout.operator("facial_retarget.make_normal_maps", icon="TEXTURE")
