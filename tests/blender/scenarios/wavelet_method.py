"""The wavelet method from the panel: settings, bake, job; and the levels of a frame as sliders beside the target.

Leaves in the folder given: job.toml with its files, and blender.npz with the frames that Blender baked.
"""

import json
import sys
from pathlib import Path

import bpy
import numpy as np
from stage import actor_face, empty_scene, key_shape, part, refused, shown, shown_frames

folder = Path(sys.argv[1])
empty_scene()
context, scene = bpy.context, bpy.context.scene
meshes, points, bake = part("bridge.meshes"), part("bridge.points.points"), part("bridge.bakes.frames")
demo, settings = part("demo"), part("core.methods.settings")
FIRST, COUNT = 3, 4

task = scene.facial_retarget
assert not bpy.ops.facial_retarget.show_levels.poll()
task.source = actor_face(3_000)
acting, skull = demo.actor(3_000), demo.targets()[1]
task.target = meshes.new_face("skull", part("files.mesh_file").MeshFile(skull.face.mesh, skull.counts, skull.corners))
points.write_points(task.target, skull.face.points)
task.target.scale, task.target.location = (2, 2, 2), (9, 0, 0)
context.view_layer.update()
bake.write_frames(task.source, demo.performance(acting)[20 : 20 + 8 * COUNT : 8], FIRST)
task.use_scene_range, task.frame_start, task.frame_end = False, FIRST, FIRST + COUNT - 1
task.report, task.page = str(folder / "report.json"), str(folder / "report.html")

# Settings, bake, report, page with levels, job.
task.method = "wavelet"
task.wavelet.levels, task.wavelet.mode = 2, "scaled"
assert bpy.ops.facial_retarget.retarget() == {"FINISHED"}
report = json.loads((folder / "report.json").read_text())
assert report["settings"]["mode"] == "scaled"
assert [row["level"] for row in report["levels"]] == [1, 2]
assert "level upon level" in (folder / "report.html").read_text()
neutral = meshes.read_positions(task.target.data)
np.savez(folder / "blender.npz", frames=shown_frames(task.target, range(FIRST, FIRST + COUNT)))
bpy.ops.facial_retarget.save_job(filepath=str(folder / "job.toml"))
job = part("files.job").read_job(folder / "job.toml")
assert job.settings == settings.WaveletSettings(levels=2, mode="scaled")

# Levels: one slider each, all of them at 1 are the frame that was baked.
for method, last in (("wavelet", FIRST + 2), ("hierarchical", FIRST + 1)):
    task.method = method
    getattr(task, method).levels = 2
    assert bpy.ops.facial_retarget.retarget() == {"FINISHED"}
    scene.frame_set(last)
    baked = shown(task.target)
    for _ in range(2):  # the second time takes the first one's place
        assert bpy.ops.facial_retarget.show_levels() == {"FINISHED"}
    assert scene.frame_current == last
    levels = bpy.data.objects["skull levels"]
    assert len(bpy.data.objects) == 3
    assert len(bpy.data.meshes) == 3
    keys = levels.data.shape_keys.key_blocks
    assert [key.name for key in keys] == ["Basis", "base", "level 1", "level 2", "detail"], list(keys)
    assert all(key.value == 1 and key.slider_max == 4 for key in keys[1:])
    size = np.ptp(neutral)
    np.testing.assert_allclose(shown(levels), baked, rtol=0, atol=1e-5 * size)
    assert np.abs(baked - neutral).max() > 0.01 * size, "nothing moves"
    keys["base"].value = 0
    moved = key_shape(levels, "base") - key_shape(levels, "Basis")
    np.testing.assert_allclose(shown(levels), baked - moved, rtol=0, atol=1e-5 * size)
    assert levels.location.x > task.target.location.x

# A method without levels has none to show, and bad input leaves all as it was.
task.method = "feature_points"
assert not bpy.ops.facial_retarget.show_levels.poll()
task.method = "wavelet"
task.target.facial_retarget.points.clear()
with refused("0 feature points in common"):
    bpy.ops.facial_retarget.show_levels()
