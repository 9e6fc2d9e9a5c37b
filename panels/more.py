"""What lies beside the six steps."""

from bpy.types import Context, Panel

from .tab import RetargetTab


class FACIAL_RETARGET_PT_more(RetargetTab, Panel):
    """Holds the panels of other work: shape keys from head to head, MPEG-4."""

    bl_label = "More"
    bl_order = 7
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """The panels inside draw themselves."""
