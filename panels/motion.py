"""The active face as an MPEG-4 face: shapes out of its points, and motion files."""

from bpy.types import Context, Panel

from ..facial_retarget_addon.manual import MPEG4
from .tab import WithManual


class FACIAL_RETARGET_PT_motion(WithManual, Panel):
    """Shapes, and motion in and out."""

    bl_label = "MPEG-4 Face"
    page = MPEG4
    bl_parent_id = "FACIAL_RETARGET_PT_more"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.label(text="Make Shapes")
        sets = layout.row(align=True)
        for name, text in (
            ("expressions", "Expressions"),
            ("visemes", "Visemes"),
            ("arkit", "ARKit"),
            ("faps", "FAPs"),
        ):
            sets.operator("facial_retarget.make_shapes", text=text).sets = {name}
        row = layout.row(align=True)
        row.operator("facial_retarget.load_shapes", text="Load Shapes")
        row.operator("facial_retarget.save_shapes", text="Save Shapes")
        row = layout.row(align=True)
        row.operator("facial_retarget.import_motion", icon="IMPORT")
        row.operator("facial_retarget.export_motion", icon="EXPORT")
