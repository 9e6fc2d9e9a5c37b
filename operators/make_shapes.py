"""Make the standard's shapes on a face."""

from typing import Any

from bpy.props import EnumProperty
from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import told
from .in_steps import InSteps
from .polls import OnPoints


class FACIAL_RETARGET_OT_make_shapes(OnPoints, InSteps, Operator):
    """Give the active face shape keys out of its MPEG-4 feature points, to be sculpted further; Esc stops"""

    bl_idname = "facial_retarget.make_shapes"
    bl_label = "Make Expression Shapes"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Making shapes"

    sets: EnumProperty(
        name="Sets",
        description="Which of the standard's shapes",
        items=[
            ("expressions", "Expressions", "joy, sadness, anger, fear, disgust, surprise: the examples too"),
            ("visemes", "Visemes", "The mouth in speech: MPEG-4's 14"),
            ("arkit", "ARKit", "The 52 shapes that phones record"),
            ("faps", "FAPs", "One for each of MPEG-4's low-level parameters"),
        ],
        options={"ENUM_FLAG"},
        default={"expressions"},
    )
    existing: EnumProperty(
        name="Existing Keys",
        description="What becomes of shape keys that are there already",
        items=[
            ("KEEP", "Keep", "Shape keys of these names that move something stay as they are"),
            ("REPLACE", "Replace", "Shape keys of these names are made anew"),
        ],
    )

    def steps(self, context: Context) -> Any:
        """Fit the face, then write the keys."""
        from ..facial_retarget_addon.bridge.motion.expression_keys import make_shapes_steps

        return make_shapes_steps(context.active_object, self.sets, self.existing == "REPLACE")

    def finish(self, result: Any) -> None:
        """Say which shapes could not be made."""
        if result.still:
            names = ", ".join(result.still)
            self.report(
                {"WARNING"}, told(f"{len(result.still)} shapes have no points on this face and stay empty: {names}")
            )
        self.report({"INFO"}, told(f"{len(result.made)} shapes made, {len(result.kept)} kept"))
