"""The method, its settings, the frames, and the button."""

from bpy.types import Context, Panel

from .tab import RetargetTab, Step


class FACIAL_RETARGET_PT_retarget(Step, Panel):
    """Retarget and bake."""

    bl_label = "4. Retarget"
    bl_order = 4
    step = "RETARGET"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        task = context.scene.facial_retarget
        layout.prop(task, "method")
        layout.prop(task, "use_scene_range")
        if not task.use_scene_range:
            column = layout.column(align=True)
            column.prop(task, "frame_start", text="Frames")
            column.prop(task, "frame_end", text="to")
        button = layout.row()
        button.scale_y = 1.5
        button.operator("facial_retarget.retarget", icon="PLAY")


class FACIAL_RETARGET_PT_settings(RetargetTab, Panel):
    """The settings of the chosen method."""

    bl_label = "Settings"
    bl_parent_id = "FACIAL_RETARGET_PT_retarget"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        task = context.scene.facial_retarget
        settings = getattr(task, task.method)
        for name in settings.__annotations__:
            layout.prop(settings, name)
        layout.operator("facial_retarget.show_levels")
