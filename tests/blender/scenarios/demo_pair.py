"""The built-in faces stand side by side, upright and of one height; the newcomer's buttons go through to glTF."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import empty_scene, part, shown, shown_frames

path = Path(sys.argv[1]) / "child.glb"


def fresh_scene() -> None:
    """An empty scene in which glTF can be read and written."""
    import addon_utils  # exists once bpy is imported

    empty_scene()
    addon_utils.enable("io_scene_gltf2")


fresh_scene()
context = bpy.context
scene = context.scene
task = scene.facial_retarget
guide = part("guide")


def world(thing: bpy.types.Object) -> np.ndarray:
    """(V, 3) places in the scene."""
    matrix = np.array(thing.matrix_world)
    return shown(thing) @ matrix[:3, :3].T + matrix[:3, 3]


assert bpy.ops.facial_retarget.add_faces() == {"FINISHED"}
source, target = task.source, task.target
assert scene.render.fps == 24
assert (scene.frame_start, scene.frame_end) == (1, len(source.data.shape_keys.key_blocks) - 1)
for thing in (source, target):
    low, high = world(thing).min(axis=0), world(thing).max(axis=0)
    assert abs(high[2] - low[2] - 2.0) < 0.02, "not of one height"
    assert abs(low[2]) < 0.02, (thing.name, low)
    assert not len(thing.facial_retarget.points)
assert world(source)[:, 0].max() < world(target)[:, 0].min(), "they overlap"
moves = np.abs(np.diff(shown_frames(source, range(1, 60, 6)), axis=0)).max()
assert moves > 0.02 * np.ptp(shown(source), axis=0).max(), "the actor does not act"
scene.frame_set(1)
assert guide.advice(context).step == "POINTS"

# With points the next thing is the button, and what it bakes is exported.
assert bpy.ops.facial_retarget.add_faces(points=True) == {"FINISHED"}
assert task.source != source
assert guide.advice(context).operator == "facial_retarget.retarget"
task.method = "motion_cloning"
task.use_scene_range, task.frame_start, task.frame_end = False, 20, 23
assert bpy.ops.facial_retarget.retarget() == {"FINISHED"}
assert guide.state(context, "RETARGET") == "DONE"
assert (context.view_layer.objects.active, context.selected_objects) == (task.source, [task.source])
assert bpy.ops.facial_retarget.export_gltf(filepath=str(path)) == {"FINISHED"}
assert context.selected_objects == [task.source], "the selection is another one"
name, count = task.target.name, len(task.target.data.vertices)
fresh_scene()
assert bpy.ops.import_scene.gltf(filepath=str(path)) == {"FINISHED"}
(came,) = [thing for thing in bpy.data.objects if thing.type == "MESH"]
assert came.name == name
assert [key.name for key in came.data.shape_keys.key_blocks[1:]] == [f"frame_{frame:04d}" for frame in range(20, 24)]
assert len(came.data.vertices) >= count
assert len(bpy.data.actions) == 1
