"""Which face moves, and which one shall."""

from bpy.types import Context, Panel

from .tab import RetargetTab


class FACIAL_RETARGET_PT_faces(RetargetTab, Panel):
    """Source, target and the performance's frames."""

    bl_label = "Faces"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        task = context.scene.facial_retarget
        layout.prop(task, "source")
        layout.prop(task, "source_neutral")
        if task.source_neutral == "FRAME":
            layout.prop(task, "neutral_frame", text="At")
        layout.prop(task, "target")
        layout.prop(task, "use_scene_range")
        if not task.use_scene_range:
            column = layout.column(align=True)
            column.prop(task, "frame_start", text="Frames")
            column.prop(task, "frame_end", text="to")
