"""The feature-point method from the panel: settings, bake, report, and the job saved and loaded again.

Leaves in the folder given: job.toml with its files, and blender.npz with the frames that Blender baked.
"""

import json
import sys
from pathlib import Path

import bpy
import numpy as np
from stage import actor_face, empty_scene, part, shown_frames

folder = Path(sys.argv[1])
empty_scene()
context = bpy.context
meshes, points, bake = part("bridge.meshes"), part("bridge.points.points"), part("bridge.bakes.frames")
demo, settings = part("demo"), part("core.methods.settings")
FIRST, COUNT = 3, 4

# The actor acts; the skull, which has another topology and size, shall.
task = context.scene.facial_retarget
task.source = actor_face(3_000)
acting, skull = demo.actor(3_000), demo.targets()[1]
task.target = meshes.new_face("skull", part("files.mesh_file").MeshFile(skull.face.mesh, skull.counts, skull.corners))
points.write_points(task.target, skull.face.points)
bake.write_frames(task.source, demo.performance(acting)[20 : 20 + 8 * COUNT : 8], FIRST)
task.use_scene_range, task.frame_start, task.frame_end = False, FIRST, FIRST + COUNT - 1
task.report, task.page = str(folder / "report.json"), str(folder / "report.html")

# Every method has its settings in the panel, with the core's names and defaults.
for method, cls in settings.SETTINGS.items():
    task.method = method
    assert part("bridge.settings").read_task_settings(task) == cls(), method
assert task.bl_rna.properties["method"].enum_items["feature_points"].name == "Feature Points"


def baked(thing: bpy.types.Object) -> np.ndarray:
    """(COUNT, V, 3) what the object shows at the frames."""
    return shown_frames(thing, range(task.frame_start, task.frame_end + 1))


task.method = "feature_points"
assert bpy.ops.facial_retarget.retarget() == {"FINISHED"}
assert isinstance(json.loads((folder / "report.json").read_text()), dict)
assert "<html" in (folder / "report.html").read_text()
free = baked(task.target)
neutral = meshes.read_positions(task.target.data)
assert np.abs(free - neutral).max() > 0.01 * np.ptp(neutral), "nothing has moved"
task.feature_points.motion = "faps"
bpy.ops.facial_retarget.retarget()
assert not np.allclose(baked(task.target), free, atol=1e-4 * np.ptp(neutral)), "the setting does nothing"
told = baked(task.target)

bpy.ops.facial_retarget.save_job(filepath=str(folder / "job.toml"))
np.savez(folder / "blender.npz", frames=told)
job = part("files.job").read_job(folder / "job.toml")
assert job.method == "feature_points"
assert job.settings == settings.FeaturePointSettings(motion="faps")
empty_scene()
bpy.ops.facial_retarget.load_job(filepath=str(folder / "job.toml"), up="Z")
task = context.scene.facial_retarget
assert task.method == "feature_points"
assert task.feature_points.motion == "faps"
assert bpy.ops.facial_retarget.retarget() == {"FINISHED"}
np.testing.assert_allclose(baked(task.target), told, rtol=0, atol=1e-6 * np.ptp(neutral))
