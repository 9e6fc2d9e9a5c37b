"""Sculpt an example, and be back where you were."""

from bpy.props import EnumProperty, StringProperty
from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import OURS, filled, told
from .errors import tells_user
from .polls import OnTask, in_mode

SIDES = [("SOURCE", "Source", "The face that moves"), ("TARGET", "Target", "The face that shall move")]


class FACIAL_RETARGET_OT_sculpt_example(OnTask, Operator):
    """Sculpt this example: Sculpt Mode on its shape key, which alone is shown; Done brings back what was before"""

    bl_idname = "facial_retarget.sculpt_example"
    bl_label = "Sculpt Example"
    bl_options = {"REGISTER", "UNDO"}
    modes = ("OBJECT", "SCULPT")

    example: StringProperty(name="Example", description="Its name; the chosen one of the list if empty")
    side: EnumProperty(
        name="Face",
        items=SIDES,
        default="TARGET",
        description="Which face is sculpted",
        translation_context=OURS,
    )

    @classmethod
    def poll(cls, context: Context) -> bool:
        """As `OnTask`; of Sculpt Mode only that of another example."""
        if context.mode == "SCULPT" and context.scene.facial_retarget.sculpting.thing != context.active_object:
            cls.poll_message_set(filled("Switch to Object Mode"))
            return False
        return super().poll(context)

    @classmethod
    def description(cls, context: Context, properties: "FACIAL_RETARGET_OT_sculpt_example") -> str:
        """The tooltip names the face."""
        face = getattr(context.scene.facial_retarget, properties.side.lower())
        if face is None:
            return filled(cls.__doc__)
        text = (
            "Sculpt {example} on {face}: Sculpt Mode on its shape key, which alone is shown; "
            "Done brings back what was before"
        )
        return filled(text, example=properties.example, face=face.name)

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Enter Sculpt Mode."""
        from ..facial_retarget_addon.bridge.examples.example_sculpting import start_sculpting
        from ..facial_retarget_addon.bridge.examples.examples import chosen_example

        thing = start_sculpting(context, chosen_example(context.scene.facial_retarget, self.example), self.side)
        self.report({"INFO"}, told(f"Sculpting {thing.active_shape_key.name} on {thing.name}"))
        return {"FINISHED"}


class FACIAL_RETARGET_OT_stop_sculpting(Operator):
    """Leave Sculpt Mode, and bring back what was before: the active object, its active shape key, and the pin"""

    bl_idname = "facial_retarget.stop_sculpting"
    bl_label = "Done"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: Context) -> bool:
        """An example must be in work."""
        if context.scene.facial_retarget.sculpting.thing is None:
            cls.poll_message_set(filled("No example is being sculpted"))
            return False
        return in_mode(cls, context, ("OBJECT", "SCULPT"))

    def execute(self, context: Context) -> set[str]:
        """Leave Sculpt Mode."""
        from ..facial_retarget_addon.bridge.examples.example_sculpting import stop_sculpting

        stop_sculpting(context)
        return {"FINISHED"}
