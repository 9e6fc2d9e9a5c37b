"""Put the built-in actor into the scene."""

from typing import Any

from bpy.props import EnumProperty
from bpy.types import Context, Operator

from ..facial_retarget_addon.properties.cloning import ACTOR_SETS
from ..facial_retarget_addon.translations import told
from .in_steps import InSteps
from .polls import in_mode


class FACIAL_RETARGET_OT_add_actor(InSteps, Operator):
    """Add the built-in actor with its shape keys and feature points, and make it the source; Esc stops"""

    bl_idname = "facial_retarget.add_actor"
    bl_label = "Add Built-In Actor"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Making the actor"

    sets: EnumProperty(
        name="Sets",
        description="Which of the actor's shapes",
        items=ACTOR_SETS,
        options={"ENUM_FLAG"},
        default={"arkit"},
    )

    @classmethod
    def poll(cls, context: Context) -> bool:
        """In Object Mode."""
        return in_mode(cls, context)

    def steps(self, context: Context) -> Any:
        """Make it, then write it."""
        from ..facial_retarget_addon.bridge.cloning.donors import add_actor_steps

        return add_actor_steps(context, self.sets)

    def finish(self, result: Any) -> None:
        """Say what it brings."""
        self.report(
            {"INFO"}, told(f"{result.name!r} is the source, with {len(result.data.shape_keys.key_blocks) - 1} shapes")
        )
