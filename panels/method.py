"""The method, its settings, and the button."""

from bpy.types import Context, Panel

from .tab import RetargetTab


class FACIAL_RETARGET_PT_retarget(RetargetTab, Panel):
    """Retarget and bake."""

    bl_label = "Retarget"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        task = context.scene.facial_retarget
        layout.prop(task, "method")
        layout.prop(task, "report")
        layout.prop(task, "page")
        layout.operator("facial_retarget.retarget", icon="PLAY")
        layout.operator("facial_retarget.show_levels")


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
