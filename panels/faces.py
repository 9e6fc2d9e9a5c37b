"""Which face moves, and which one shall."""

from bpy.types import Context, Panel

from ..facial_retarget_addon.translations import OURS
from .tab import Step


class FACIAL_RETARGET_PT_faces(Step, Panel):
    """Source and target, and how the source looks at rest."""

    bl_label = "1. Faces"
    bl_order = 1
    step = "FACES"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        task = context.scene.facial_retarget
        layout.prop(task, "source")
        layout.prop(task, "source_neutral")
        if task.source_neutral == "FRAME":
            layout.prop(task, "neutral_frame", text="At", text_ctxt=OURS)
        layout.prop(task, "target")
        layout.operator("facial_retarget.set_up_workspace", icon="WORKSPACE")
        layout.operator("facial_retarget.add_faces", icon="ADD")
