"""Put shape keys on the list of examples, and take them off it."""

from bpy.props import StringProperty
from bpy.types import Context, Event, Operator

from ..facial_retarget_addon.translations import filled, told
from .polls import OnTask


class FACIAL_RETARGET_OT_add_example(OnTask, Operator):
    """Use a shape key that both faces have as an example"""

    bl_idname = "facial_retarget.add_example"
    bl_label = "Add Example"
    bl_options = {"REGISTER", "UNDO"}

    name: StringProperty(name="Shape Key", description="Its name on source and target")

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Ask for the name."""
        return context.window_manager.invoke_props_dialog(self)

    def execute(self, context: Context) -> set[str]:
        """Put the name on the list."""
        examples = context.scene.facial_retarget.examples
        if not self.name or self.name in examples:
            self.report({"ERROR"}, told(f"example {self.name!r} is listed already, expected another shape key's name"))
            return {"CANCELLED"}
        examples.add().name = self.name
        return {"FINISHED"}


class FACIAL_RETARGET_OT_remove_example(OnTask, Operator):
    """Take the chosen example off the list; its shape keys stay"""

    bl_idname = "facial_retarget.remove_example"
    bl_label = "Remove Example"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: Context) -> bool:
        """As `OnTask`; the list must have a chosen row."""
        task = context.scene.facial_retarget
        if task.active_example not in range(len(task.examples)):
            cls.poll_message_set(filled("Choose an example in the list"))
            return False
        return super().poll(context)

    def execute(self, context: Context) -> set[str]:
        """Take the example off that is chosen in the list."""
        task = context.scene.facial_retarget
        task.examples.remove(task.active_example)
        task.active_example = max(task.active_example - 1, 0)
        return {"FINISHED"}
