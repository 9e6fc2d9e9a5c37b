"""The button, end to end: bake, report, Esc, the job saved and loaded again.

Leaves in the folder given: job.toml with its files, and blender.npz with the frames that Blender baked.
"""

import json
import sys
from pathlib import Path

import bpy
import numpy as np
from stage import empty_scene, part, shown, snapshot

folder = Path(sys.argv[1])
empty_scene()
context = bpy.context
meshes, points, examples, bake = (
    part(f"bridge.{name}") for name in ("meshes", "points.points", "examples.examples", "bakes.frames")
)
retargeting, background = part("bridge.retargeting"), part("bridge.background")
demo = part("demo")

# The actor and a warped one of another topology on the scene, a few frames of the performance, and two of the examples.
FIRST, COUNT = 11, 4
actor, warped = demo.actor(12_000), demo.warped_actor(np.random.default_rng(1), 9_000)
task = context.scene.facial_retarget
for role, face in (("source", actor), ("target", warped)):
    file = part("files.mesh_file").MeshFile(face.face.mesh, face.counts, face.corners, face.uvs[face.corners])
    thing = meshes.new_face(face.name, file)
    setattr(task, role, thing)
    points.write_points(thing, face.face.points)
    for name in ("joy", "surprise"):
        examples.write_example(thing, name, face.face.examples[name])
performance = demo.performance(actor)[20 : 20 + 8 * COUNT : 8]
bake.write_frames(task.source, performance, FIRST)
for name in ("joy", "surprise"):
    task.examples.add().name = name
task.hierarchical.levels = 2
task.use_scene_range = False
task.frame_start, task.frame_end = FIRST, FIRST + COUNT - 1
task.report, task.page = str(folder / "report.json"), str(folder / "report.html")
context.view_layer.update()


def baked(thing: bpy.types.Object) -> np.ndarray:
    """(COUNT, V, 3) what the baked keys hold."""
    frames = np.empty((COUNT, 3 * len(thing.data.vertices)), np.float32)
    for i, flat in enumerate(frames):
        thing.data.shape_keys.key_blocks[f"frame_{task.frame_start + i:04d}"].points.foreach_get("co", flat)
    return frames.reshape(COUNT, -1, 3)


# Esc at every stage leaves the scene as it was.
context.scene.frame_set(5)
before = snapshot()
stages = set()
for stop_at in ("Reading", "frame", "Writing"):
    steps = retargeting.retarget_steps(context)
    for _, what in steps:
        stages.add(what.partition(" ")[0])
        if what.startswith(stop_at):
            steps.close()
    assert stop_at in stages, stages
    assert snapshot() == before, f"stopping at {stop_at!r} has changed the scene"
    assert not (folder / "report.json").exists()

# In background the modal operator runs through.
assert bpy.ops.facial_retarget.retarget("INVOKE_DEFAULT") == {"FINISHED"}
assert (context.scene.frame_current, context.scene.frame_subframe) == before["frame"]
assert len(json.loads((folder / "report.json").read_text())["levels"]) == 2
assert "<html" in (folder / "report.html").read_text()
result = baked(task.target)
for i in range(COUNT):
    context.scene.frame_set(FIRST + i)
    np.testing.assert_allclose(shown(task.target), result[i], atol=1e-5)
neutral = meshes.read_positions(task.target.data)
assert np.abs(result - neutral).max() > 0.01 * np.ptp(neutral), "nothing has moved"

# Objects that stand turned and scaled elsewhere give the same frames.
task.target.rotation_euler, task.target.scale, task.target.location = (0.3, 0.2, 0.1), (2, 2, 2), (1, 2, 3)
task.source.rotation_euler, task.source.scale = (1.6, 0, 0), (0.1, 0.1, 0.1)
context.view_layer.update()
bpy.ops.facial_retarget.retarget()
assert np.array_equal(baked(task.target), result)

# The job, for the command line, and loaded again.
bpy.ops.facial_retarget.save_job(filepath=str(folder / "job.toml"))
np.savez(folder / "blender.npz", frames=result)
empty_scene()
bpy.ops.facial_retarget.load_job(filepath=str(folder / "job.toml"))
task = context.scene.facial_retarget
assert bpy.ops.facial_retarget.retarget() == {"FINISHED"}
assert np.array_equal(baked(task.target), result)
