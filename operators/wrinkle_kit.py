"""The wrinkle kit of the target's shape keys."""

from typing import Any

from bpy.types import Context, Operator

from ..facial_retarget_addon.core.methods.settings import LEVELED
from ..facial_retarget_addon.translations import filled, told
from .errors import tells_user
from .in_steps import InSteps
from .polls import OnFace, in_mode


class FACIAL_RETARGET_OT_make_wrinkle_kit(InSteps, Operator):
    """Make a map and a mask for each shape key that wrinkles, and let materials blend them by the sliders; Esc stops"""

    bl_idname = "facial_retarget.make_wrinkle_kit"
    bl_label = "Make Wrinkle Kit"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Making the wrinkle kit"

    @classmethod
    def poll(cls, context: Context) -> bool:
        """The target, what its wrinkles come from, and a folder must be chosen, in Object Mode."""
        task = context.scene.facial_retarget
        kit, sculpted = task.wrinkle_kit, task.wrinkle_kit.detail == "OBJECT"
        if task.target is None:
            cls.poll_message_set(filled("Choose a target under Faces"))
        elif sculpted and kit.fine is None:
            cls.poll_message_set(filled("Choose the high-poly object"))
        elif not sculpted and task.method not in LEVELED:
            cls.poll_message_set(told(f"This method has no levels; {' and '.join(LEVELED)} have"))
        elif not sculpted and task.source is None and task.cloning.donor == "SOURCE":
            cls.poll_message_set(filled("Choose a source under Faces, or clone from the built-in actor"))
        elif not kit.folder:
            cls.poll_message_set(filled("Choose a folder for the wrinkle kit"))
        else:
            return in_mode(cls, context)
        return False

    def steps(self, context: Context) -> Any:
        """Read, compute, write."""
        from ..facial_retarget_addon.bridge.maps.wrinkle_kit import wrinkle_kit_steps

        return wrinkle_kit_steps(context)

    def finish(self, result: Any) -> None:
        """Say where it is, which keys have no map, and which materials do not show it."""
        for warning in result.warnings:
            self.report({"WARNING"}, told(warning))
        keys, pictures, name = result.keys, result.pictures, result.thing.name
        self.report({"INFO"}, told(f"Wrinkle kit of {name!r} in {result.folder} (keys: {keys}, pictures: {pictures})"))


class FACIAL_RETARGET_OT_remove_wrinkle_kit(OnFace, Operator):
    """Take the wrinkle kit out of the active object's materials; its shape keys and the files stay"""

    bl_idname = "facial_retarget.remove_wrinkle_kit"
    bl_label = "Remove Wrinkle Kit"
    bl_options = {"REGISTER", "UNDO"}

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Remove nodes, drivers and pictures."""
        from ..facial_retarget_addon.bridge.maps.wrinkle_nodes import remove_kit

        count = remove_kit(context.active_object)
        name = context.active_object.name
        self.report({"INFO"}, told(f"Wrinkle kit taken out of {name!r} (materials: {count})"))
        return {"FINISHED"}
