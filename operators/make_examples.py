"""Make examples roughly, make them stronger or weaker, and see how well they are met."""

from typing import Any

from bpy.props import EnumProperty, FloatProperty, StringProperty
from bpy.types import Context, Event, Operator

from ..facial_retarget_addon.translations import OURS, told
from .errors import tells_user
from .in_steps import InSteps
from .polls import OnTask
from .sculpt_example import SIDES


class OnExample(OnTask):
    """For operators on one example, on one face."""

    example: StringProperty(name="Example", description="Its name; all of the list if empty")
    side: EnumProperty(
        name="Face",
        items=SIDES,
        default="TARGET",
        description="Which face's example it is",
        translation_context=OURS,
    )

    def face(self, context: Context) -> Any:
        """The face object."""
        return getattr(context.scene.facial_retarget, self.side.lower())

    def names(self, context: Context) -> list[str]:
        """The example, or all of the list."""
        return [self.example] if self.example else [one.name for one in context.scene.facial_retarget.examples]


class FACIAL_RETARGET_OT_rough_out(OnExample, InSteps, Operator):
    """Make examples to sculpt on, out of the face's feature points or as the other face shows them; Esc stops"""

    bl_idname = "facial_retarget.rough_out"
    bl_label = "Rough Out"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Roughing out"
    asking = False

    way: EnumProperty(
        name="From",
        items=[
            ("POINTS", "Feature Points", "Out of the face's own MPEG-4 feature points"),
            ("CLONE", "Other Face", "As the other face shows it, by the method that clones shape keys"),
        ],
        description="What the examples are made from",
    )
    existing: EnumProperty(
        name="Existing",
        items=[
            ("KEEP", "Keep", "Examples that are sculpted stay as they are"),
            ("REPLACE", "Replace", "Examples that are sculpted are made anew"),
        ],
        options={"SKIP_SAVE"},
        description="What becomes of examples that are sculpted already",
    )

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Ask before a sculpted example is replaced."""
        example = context.scene.facial_retarget.examples.get(self.example)
        if example is None or getattr(example, f"{self.side.lower()}_state") != "SCULPTED":
            return self.start(context)
        self.asking = True
        return context.window_manager.invoke_confirm(
            self,
            event,
            title=told(f"{self.example} is sculpted on {self.face(context).name} already"),
            message="Replace what you have sculpted?",
            confirm_text="Replace",
            icon="WARNING",
        )

    def execute(self, context: Context) -> set[str]:
        """In steps once the artist has agreed, at once in a script."""
        if self.asking:
            self.asking, self.existing = False, "REPLACE"
            return self.start(context)
        return super().execute(context)

    def steps(self, context: Context) -> Any:
        """Read, compute, write."""
        from ..facial_retarget_addon.bridge.examples.example_making import rough_out_steps

        return rough_out_steps(context, self.names(context), self.side, self.way, self.existing == "REPLACE")

    def finish(self, result: Any) -> None:
        """Say what was made and what was not."""
        for warning in result.warnings:
            self.report({"WARNING"}, told(warning))
        if result.unable:
            self.report({"WARNING"}, told(f"{', '.join(result.unable)}: there is nothing to make it from, sculpt it"))
        kept = f"; {len(result.kept)} kept" if result.kept else ""
        self.report({"INFO"}, told(f"Roughed out: {', '.join(result.made)}" + kept))


class FACIAL_RETARGET_OT_mirror_example(OnExample, InSteps, Operator):
    """Mirror this example through the surface: meshes that are not symmetric too; Esc stops"""

    bl_idname = "facial_retarget.mirror_example"
    bl_label = "Mirror"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Mirroring"

    way: EnumProperty(
        name="Way",
        items=[
            ("LEFT_TO_RIGHT", "Left to Right", "The right half shows what the face's left half does"),
            ("RIGHT_TO_LEFT", "Right to Left", "The left half shows what the face's right half does"),
            ("BOTH", "Mean of Both", "Both halves show the mean of what they do"),
            ("FLIP", "Flip", "The halves exchange what they do"),
        ],
        description="Which half becomes what",
    )

    def steps(self, context: Context) -> Any:
        """Find what lies opposite to what, then write."""
        from ..facial_retarget_addon.bridge.examples.example_making import mirror_steps

        return mirror_steps(context, self.names(context), self.side, self.way)

    def finish(self, result: Any) -> None:
        """Say which ones."""
        self.report({"INFO"}, told(f"Mirrored: {', '.join(result)}"))


class FACIAL_RETARGET_OT_scale_example(OnExample, Operator):
    """Make this example stronger or weaker"""

    bl_idname = "facial_retarget.scale_example"
    bl_label = "Strength"
    bl_options = {"REGISTER", "UNDO"}

    factor: FloatProperty(
        name="Strength",
        default=1.0,
        min=0.0,
        soft_max=2.0,
        options={"SKIP_SAVE"},
        description="By how much its motion is multiplied",
    )

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Show the slider, which acts while it is drawn."""
        return context.window_manager.invoke_props_popup(self, event)

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Scale the shape key."""
        from ..facial_retarget_addon.bridge.examples.example_making import scale_example
        from ..facial_retarget_addon.bridge.examples.examples import chosen_example

        scale_example(self.face(context), chosen_example(context.scene.facial_retarget, self.example), self.factor)
        return {"FINISHED"}


class FACIAL_RETARGET_OT_check_examples(OnTask, InSteps, Operator):
    """See how well the method meets each example, and how well the others foretell it; Esc stops"""

    bl_idname = "facial_retarget.check_examples"
    bl_label = "Check Examples"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Checking examples"

    def steps(self, context: Context) -> Any:
        """Fit the method, keep the figures."""
        from ..facial_retarget_addon.bridge.examples.example_checking import check_steps

        return check_steps(context)

    def finish(self, result: str) -> None:
        """Say which example is foretold worst."""
        self.report({"INFO"}, told(result))
