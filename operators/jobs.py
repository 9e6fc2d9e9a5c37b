"""Load a job file into the scene, and save the scene's task as one."""

from pathlib import Path
from typing import Any

from bpy.props import EnumProperty, StringProperty
from bpy.types import Context, Operator
from bpy_extras.io_utils import ExportHelper, ImportHelper

from ..facial_retarget_addon.translations import told
from .in_steps import FromBrowser, InSteps
from .polls import OnCloning, OnTask, in_mode


class FACIAL_RETARGET_OT_load_job(FromBrowser, ImportHelper, InSteps, Operator):
    """Load a job file: its faces become objects, its settings the panel's; Esc stops"""

    bl_idname = "facial_retarget.load_job"
    bl_label = "Load Job"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Loading the job"

    filename_ext = ".toml"
    filter_glob: StringProperty(default="*.toml", options={"HIDDEN"})
    up: EnumProperty(
        name="Up",
        items=[("Y", "Y", "The files' faces stand along Y"), ("Z", "Z", "The files' faces stand along Z")],
        description="Which way is up in the job's files",
    )

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Only in Object Mode."""
        return in_mode(cls, context)

    def steps(self, context: Context) -> Any:
        """Read everything, then make the objects."""
        from ..facial_retarget_addon.bridge.job import load_job_steps

        return load_job_steps(context, Path(self.filepath), self.up)

    def finish(self, result: None) -> None:
        """Name it."""
        self.report({"INFO"}, told(f"Loaded {Path(self.filepath).name}"))


class FACIAL_RETARGET_OT_save_job(OnTask, FromBrowser, ExportHelper, InSteps, Operator):
    """Save the task as a job file, with the faces, frames and points that it needs beside it; Esc stops"""

    bl_idname = "facial_retarget.save_job"
    bl_label = "Save Job"
    doing = "Saving the job"

    filename_ext = ".toml"
    filter_glob: StringProperty(default="*.toml", options={"HIDDEN"})

    def steps(self, context: Context) -> Any:
        """Read frame after frame, then write the files, the job itself last."""
        from ..facial_retarget_addon.bridge.job import save_job_steps

        return save_job_steps(context, Path(self.filepath))

    def finish(self, result: None) -> None:
        """Name it."""
        self.report({"INFO"}, told(f"Saved {self.filepath}"))


class FACIAL_RETARGET_OT_save_clone_job(OnCloning, FromBrowser, ExportHelper, InSteps, Operator):
    """Save the cloning as a job for the command line, with all heads, shapes and corrections beside it; Esc stops"""

    bl_idname = "facial_retarget.save_clone_job"
    bl_label = "Save Clone Job"
    doing = "Saving the job"

    filename_ext = ".toml"
    filter_glob: StringProperty(default="*.toml", options={"HIDDEN"})

    def steps(self, context: Context) -> Any:
        """Read the shapes, then write the files, the job itself last."""
        from ..facial_retarget_addon.bridge.cloning.clone_job import save_clone_job_steps

        return save_clone_job_steps(context, Path(self.filepath))

    def finish(self, result: None) -> None:
        """Name it."""
        self.report({"INFO"}, told(f"Saved {self.filepath}"))
