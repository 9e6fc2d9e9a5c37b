"""Import motion files onto the active face, and export its motion."""

from pathlib import Path
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy.types import Context, Operator
from bpy_extras.io_utils import ExportHelper, ImportHelper

from ..facial_retarget_addon.translations import OURS, told
from .in_steps import FromBrowser, InSteps
from .over_frames import OverFrames
from .polls import OnFace

SUFFIXES = {"FAP": ".fap", "ARKIT": ".csv"}


class FACIAL_RETARGET_OT_import_motion(OnFace, FromBrowser, ImportHelper, InSteps, Operator):
    """Import FAPs, ARKit weights or optical markers onto the active face; Esc stops"""

    bl_idname = "facial_retarget.import_motion"
    bl_label = "Import Motion"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Importing"

    filename_ext = ".fap"
    filter_glob: StringProperty(default="*.fap;*.csv;*.trc;*.c3d;*.bvh", options={"HIDDEN"})
    way: EnumProperty(
        name="As",
        description="What the motion becomes on the face",
        items=[
            ("CONTROLS", "Controls or Named Shapes", "FAPs and markers as FAP controls, ARKit as its 52 shape keys"),
            ("POINTS", "Feature Points", "Three shape keys per point: any length of motion, and still editable"),
            ("FRAMES", "Frames", "One shape key per frame, as a retargeted performance"),
        ],
    )
    frame_start: IntProperty(name="Start Frame", default=1, description="Scene frame of the file's first frame")
    head: EnumProperty(
        name="Head",
        description="What becomes of the motion of the head as a whole",
        items=[
            ("LEAVE", "Leave", "The head does not turn"),
            ("EMPTY", "Empty", "An empty turns as the head turns: parent the head to it, or let a bone copy it"),
        ],
    )
    missing: EnumProperty(
        name="Unused FAPs",
        translation_context=OURS,
        description="What becomes of a FAP at frames that do not use it",
        items=[
            ("hold", "Hold", "A FAP that a frame does not use stays as it was"),
            ("zero", "Zero", "A FAP that a frame does not use is 0"),
        ],
    )
    gaps: EnumProperty(
        name="Hidden Markers",
        description="What becomes of markers that the cameras have lost for a while",
        items=[
            ("fill", "Fill", "Short gaps are filled with smooth curves"),
            ("refuse", "Refuse", "Markers with gaps are not imported"),
        ],
    )
    marker_map: StringProperty(
        name="Marker Map",
        subtype="FILE_PATH",
        description="Which marker sits on which point (.json); without it the markers' names say so",
    )
    fps: FloatProperty(name="Rate", min=0.0, description="Frames a second of a table that does not tell them, or 0")
    update_scene_fps: BoolProperty(name="Update Scene FPS", description="The scene takes over the file's rate")
    update_scene_duration: BoolProperty(
        name="Update Scene Duration", description="The scene's range becomes that of the motion"
    )

    def steps(self, context: Context) -> Any:
        """Read, compute, write."""
        from ..facial_retarget_addon.bridge.motion.motion_import import ImportOptions, import_motion_steps

        options = ImportOptions(
            path=Path(self.filepath),
            way=self.way,
            start=self.frame_start,
            head=self.head,
            missing=self.missing,
            gaps=self.gaps,
            marker_map=Path(bpy.path.abspath(self.marker_map)) if self.marker_map else None,
            fps=self.fps or None,
            set_rate=self.update_scene_fps,
            set_range=self.update_scene_duration,
        )
        return import_motion_steps(context, context.active_object, options)

    def finish(self, result: Any) -> None:
        """Pass on the warnings."""
        for warning in result.warnings:
            self.report({"WARNING"}, told(warning))
        self.report({"INFO"}, told(f"{result.count} frames imported, up to scene frame {result.last:.0f}"))


class FACIAL_RETARGET_OT_export_motion(OnFace, OverFrames, FromBrowser, ExportHelper, InSteps, Operator):
    """Export the motion of the active face at the scene's rate; Esc stops"""

    bl_idname = "facial_retarget.export_motion"
    bl_label = "Export Motion"
    doing = "Exporting"

    filter_glob: StringProperty(default="*.fap;*.csv", options={"HIDDEN"})
    format: EnumProperty(
        name="Format",
        items=[
            ("FAP", "MPEG-4 FAPs (.fap)", "From the FAP controls, or measured on the mesh"),
            ("ARKIT", "ARKit (.csv)", "From the shape keys with ARKit's names, as Live Link Face writes it"),
        ],
        description="In a script the file's suffix decides",
    )
    source: EnumProperty(
        name="FAPs From",
        description="Where the values are read from",
        items=[
            ("AUTO", "Controls or Mesh", "The FAP controls if the face has them, its feature points otherwise"),
            ("MESH", "Mesh", "The feature points as the mesh moves, even if there are controls"),
            ("MOVING", "Mesh with a Moving Head", "The same where the head moves in the mesh itself, as in a cache"),
        ],
    )

    @property
    def filename_ext(self) -> str:
        """Suffix of the format, for the file browser."""
        return SUFFIXES[self.format]

    def steps(self, context: Context) -> Any:
        """Read frame after frame, then write the file."""
        from ..facial_retarget_addon.bridge.motion.motion_export import export_motion_steps

        frames = range(self.frame_start, self.frame_end + 1)
        return export_motion_steps(context, context.active_object, Path(self.filepath), frames, self.source)
