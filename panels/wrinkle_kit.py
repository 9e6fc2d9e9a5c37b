"""The wrinkle kit of the target's shape keys."""

from bpy.types import Context, Panel

from .tab import RetargetTab


class FACIAL_RETARGET_PT_wrinkle_kit(RetargetTab, Panel):
    """Where the wrinkles come from, how their maps are written, and the buttons."""

    bl_label = "Wrinkle Kit"
    bl_parent_id = "FACIAL_RETARGET_PT_export"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        kit = context.scene.facial_retarget.wrinkle_kit
        layout.prop(kit, "detail")
        if kit.detail == "OBJECT":
            layout.prop(kit, "fine")
        else:
            layout.prop(kit, "light")
            if kit.light == "LEVEL":
                layout.prop(kit, "level")
        layout.prop(kit, "folder")
        column = layout.column(align=True)
        column.prop(kit, "pixels")
        column.prop(kit, "margin")
        layout.prop(kit, "least")
        layout.prop(kit, "depth")
        layout.prop(kit, "convention")
        layout.prop(kit, "wire")
        column = layout.column(align=True)
        column.operator("facial_retarget.make_wrinkle_kit", icon="MOD_NOISE")
        column.operator("facial_retarget.remove_wrinkle_kit", icon="X")
