"""Normal maps of the performance."""

from typing import Any

from bpy.types import Context, Operator

from ..facial_retarget_addon.core.methods.settings import LEVELED
from ..facial_retarget_addon.translations import filled, told
from .in_steps import InSteps
from .polls import OnTask


class FACIAL_RETARGET_OT_make_normal_maps(OnTask, InSteps, Operator):
    """Make a normal map of each frame, which gives a light mesh the wrinkles of the finest level; Esc stops"""

    bl_idname = "facial_retarget.make_normal_maps"
    bl_label = "Make Normal Maps"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Making normal maps"

    @classmethod
    def poll(cls, context: Context) -> bool:
        """As `OnTask`; the method must work level by level, and a folder be chosen."""
        task = context.scene.facial_retarget
        if task.method not in LEVELED:
            cls.poll_message_set(told(f"This method has no levels; {' and '.join(LEVELED)} have"))
            return False
        if not task.normal_maps.folder:
            cls.poll_message_set(filled("Choose a folder for the maps"))
            return False
        return super().poll(context)

    def steps(self, context: Context) -> Any:
        """Read, compute, write."""
        from ..facial_retarget_addon.bridge.maps.normal_maps import normal_map_steps

        return normal_map_steps(context)

    def finish(self, result: Any) -> None:
        """Say where they are, and which materials do not show them."""
        for warning in result.warnings:
            self.report({"WARNING"}, told(warning))
        self.report({"INFO"}, told(f"Normal maps of {result.thing.name!r} in {result.folder}"))
