"""The target's motion as curves: of its shape keys, or of the FAPs that drive it."""

from pathlib import Path
from typing import Any

from bpy.props import EnumProperty, FloatProperty, StringProperty
from bpy.types import Context, Operator
from bpy_extras.io_utils import ExportHelper

from ..facial_retarget_addon.fap_controls import CONTROLS
from ..facial_retarget_addon.translations import filled
from .in_steps import FromBrowser, InSteps
from .over_frames import OverFrames
from .polls import OnTask

SUFFIXES = {"CSV": ".csv", "JSON": ".json"}


class FACIAL_RETARGET_OT_export_curves(OnTask, OverFrames, FromBrowser, ExportHelper, InSteps, Operator):
    """Export the curves of the target's shape keys as a table or a document, frame by frame; Esc stops"""

    bl_idname = "facial_retarget.export_curves"
    bl_label = "Export Curves"
    doing = "Exporting"

    filter_glob: StringProperty(default="*.csv;*.json", options={"HIDDEN"})
    format: EnumProperty(
        name="Format",
        items=[
            ("CSV", "Table (.csv)", "A line for each frame and a column for each shape key, as spreadsheets read it"),
            ("JSON", "Document (.json)", "A list of values for each shape key, with the frames and their rate"),
        ],
        description="In a script the file's suffix decides",
    )
    step: FloatProperty(
        name="Step",
        default=1.0,
        min=0.05,
        soft_max=10.0,
        description="Scene frames from one exported frame to the next; below 1 for sub-frames",
    )

    @property
    def filename_ext(self) -> str:
        """Suffix of the format, for the file browser."""
        return SUFFIXES[self.format]

    @classmethod
    def poll(cls, context: Context) -> bool:
        """As `OnTask`; the target must have shape keys."""
        if not super().poll(context):
            return False
        if getattr(context.scene.facial_retarget.target.data, "shape_keys", None) is None:
            cls.poll_message_set(filled("The target has no shape keys: bake the performance as some"))
            return False
        return True

    def steps(self, context: Context) -> Any:
        """Read frame after frame, then write the file."""
        from ..facial_retarget_addon.bridge.bakes.times import FrameTimes
        from ..facial_retarget_addon.bridge.motion.curve_export import export_curves_steps

        frames = FrameTimes(self.frame_start, self.frame_end, self.step)
        return export_curves_steps(context, context.scene.facial_retarget.target, Path(self.filepath), frames)


class FACIAL_RETARGET_OT_export_faps(OnTask, OverFrames, FromBrowser, ExportHelper, InSteps, Operator):
    """Export the MPEG-4 FAPs that drive the target, as its controls stand frame by frame; Esc stops"""

    bl_idname = "facial_retarget.export_faps"
    bl_label = "Export FAPs"
    doing = "Exporting"

    filename_ext = ".fap"
    filter_glob: StringProperty(default="*.fap", options={"HIDDEN"})

    @classmethod
    def poll(cls, context: Context) -> bool:
        """As `OnTask`; the target must have FAP controls."""
        if not super().poll(context):
            return False
        if not any(control.name in context.scene.facial_retarget.target for control in CONTROLS):
            cls.poll_message_set(
                filled("No FAPs drive the target: Export Motion, under MPEG-4 Face, measures them on its mesh")
            )
            return False
        return True

    def steps(self, context: Context) -> Any:
        """Read frame after frame, then write the file."""
        from ..facial_retarget_addon.bridge.motion.motion_export import export_motion_steps

        frames, target = range(self.frame_start, self.frame_end + 1), context.scene.facial_retarget.target
        return export_motion_steps(context, target, Path(self.filepath), frames, "AUTO")
