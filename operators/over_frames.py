"""What the operators that export a range of frames have in common."""

from typing import Any

from bpy.props import IntProperty
from bpy.types import Context, Event

from ..facial_retarget_addon.translations import told


class OverFrames:
    """For operators in steps that export scene frames, and give back `bridge.motion.motion_export.Exported`."""

    frame_start: IntProperty(name="First Frame", default=1, description="First scene frame that is exported")
    frame_end: IntProperty(name="Last Frame", default=250, description="Last scene frame that is exported")

    def invoke(self, context: Context, event: Event) -> set[str]:
        """The scene's range is meant, until the artist says otherwise."""
        self.frame_start, self.frame_end = context.scene.frame_start, context.scene.frame_end
        return super().invoke(context, event)

    def finish(self, result: Any) -> None:
        """Pass on the warnings."""
        for warning in result.warnings:
            self.report({"WARNING"}, told(warning))
        self.report({"INFO"}, told(f"{result.count} frames exported from {result.source}"))
