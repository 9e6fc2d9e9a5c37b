"""Save the task as a job for the command line, and load a job into an empty file.

    facial-retarget run job.toml

gives the same frames as the button. Needs the two faces of 02_retarget.py, which it runs first.
"""

import runpy
import tempfile
from pathlib import Path

import bpy

runpy.run_path(str(Path(__file__).with_name("02_retarget.py")))

with tempfile.TemporaryDirectory() as folder:
    # Everything that the job needs lies beside it: faces, frames, points, examples.
    job = str(Path(folder, "job.toml"))
    bpy.ops.facial_retarget.save_job(filepath=job)

    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.facial_retarget.load_job(filepath=job, up="Z")  # these files' faces stand along Z, as Blender's do

task = bpy.context.scene.facial_retarget
print(task.source.name, task.target.name, task.frame_start, task.frame_end, task.hierarchical.levels)
