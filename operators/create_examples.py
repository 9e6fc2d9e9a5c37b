"""Create the seven example shape keys."""

from bpy.types import Context, Operator

from .errors import tells_user
from .polls import OnTask


class FACIAL_RETARGET_OT_create_examples(OnTask, Operator):
    """Give both faces the shape keys of the seven examples: the Basis is the neutral one, the others wait for you"""

    bl_idname = "facial_retarget.create_examples"
    bl_label = "Create Example Shape Keys"
    bl_options = {"REGISTER", "UNDO"}

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Add the shape keys that are missing."""
        from ..facial_retarget_addon.bridge.examples.examples import create_examples

        create_examples(context.scene.facial_retarget)
        return {"FINISHED"}
