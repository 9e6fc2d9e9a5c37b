"""Put two built-in faces into the scene, to try everything with."""

from typing import Any

from bpy.props import BoolProperty, EnumProperty
from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import told
from .in_steps import InSteps
from .polls import in_mode


class FACIAL_RETARGET_OT_add_faces(InSteps, Operator):
    """Add the built-in actor with a performance, and beside it a face that shall get it; Esc stops"""

    bl_idname = "facial_retarget.add_faces"
    bl_label = "Add Built-In Faces"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Making the faces"

    target: EnumProperty(
        name="Target",
        items=[
            ("child", "Child", "Large eyes and a small mouth, 8 000 vertices"),
            ("ape", "Ape", "A muzzle and heavy brows, 24 000 vertices"),
            ("skull", "Skull", "Hollow cheeks and wide sockets, 20 000 vertices"),
        ],
        description="The face that shall get the performance",
    )
    points: BoolProperty(name="With Points", description="Both faces have their feature points already")

    @classmethod
    def poll(cls, context: Context) -> bool:
        """In Object Mode."""
        return in_mode(cls, context)

    def steps(self, context: Context) -> Any:
        """Make them, then write them."""
        from ..facial_retarget_addon.bridge.scene.demo_pair import add_pair_steps

        return add_pair_steps(context, self.target, self.points)

    def finish(self, result: Any) -> None:
        """Name them."""
        source, target = result
        self.report({"INFO"}, told(f"Added {source.name!r}, who acts, and {target.name!r}, the target"))
