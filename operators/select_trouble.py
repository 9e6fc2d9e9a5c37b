"""Select what a finding of the report is about."""

from bpy.props import EnumProperty
from bpy.types import Context, Operator

from ..facial_retarget_addon import guide
from ..facial_retarget_addon.translations import filled, told
from .errors import tells_user
from .polls import in_mode


class FACIAL_RETARGET_OT_select_trouble(Operator):
    """Select the vertices of the chosen frame's or shape key's trouble, in Edit Mode"""

    bl_idname = "facial_retarget.select_trouble"
    bl_label = "Select"
    bl_options = {"REGISTER", "UNDO"}

    kind: EnumProperty(
        name="Trouble",
        items=[
            ("TORN", "Torn Edges", "Vertices of the torn edges"),
            ("TURNED", "Turned Triangles", "Vertices of the triangles that are turned over"),
            ("LIPS", "Lips", "Edges of the lips, where they are open wider than the source's"),
            ("LIDS", "Lids", "Edges of the lids, where they are open wider than the source's"),
        ],
        description="Which of the vertices",
    )

    @classmethod
    def poll(cls, context: Context) -> bool:
        """A row of the report must be chosen."""
        thing = guide.found_face(context)
        if thing is None or not 0 <= thing.facial_retarget.active_finding < len(thing.facial_retarget.findings):
            cls.poll_message_set(filled("Choose a frame or a shape key in the report's list"))
            return False
        return in_mode(cls, context, ("OBJECT", "EDIT_MESH"))

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Select them."""
        from ..facial_retarget_addon.bridge.reports.findings import select_spots

        count = select_spots(guide.found_face(context), self.kind)
        self.report({"INFO"}, told(f"{count} vertices selected"))
        return {"FINISHED"}
