"""Whatever is wrong: one clear sentence, and the scene as it was."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import empty_scene, grid, part, refused, wave

folder = Path(sys.argv[1])
empty_scene()
bake, examples, points = (part(f"bridge.{name}") for name in ("bakes.frames", "examples.examples", "points.points"))
retarget = bpy.ops.facial_retarget.retarget
task = bpy.context.scene.facial_retarget
scene = bpy.context.scene
scene.frame_start, scene.frame_end = 1, 3


def act(frames: np.ndarray) -> None:
    """Give the source a performance."""
    bake.write_frames(task.source, frames, 1)
    scene.frame_set(1)


# Nothing to work on: the button is grey.
assert not retarget.poll()
task.source = grid("source", 9)
assert not retarget.poll()
task.target = task.source
with refused("both", "'source'"):
    retarget()
task.target = grid("target", 12)
assert retarget.poll()
bpy.context.view_layer.objects.active = task.target
bpy.ops.object.mode_set(mode="EDIT")
assert not retarget.poll()
bpy.ops.object.mode_set(mode="OBJECT")

with refused("0 feature points in common"):
    retarget()
names = tuple(f"p{i}" for i in range(40))
for thing, step in ((task.source, 2), (task.target, 3)):
    corners = np.repeat(step * np.arange(40)[:, None], 3, axis=1)
    places = part("core.points").FeaturePoints(names, corners, np.tile([1.0, 0, 0], (40, 1)))
    points.write_points(thing, places)

# Points.
bad = task.target.facial_retarget.points[3]
bad.vertices[0] = 144
with refused("'p3'", "144", "143"):
    retarget()
bad.vertices[0] = 9
bad.weights = (0, 0, 0)
with refused("'p3'", "weights"):
    retarget()
bad.weights = (1, 0, 0)
bad.name = "p4"
with refused("'p4'", "twice"):
    retarget()
bad.name = "p3"

# The performance.
scene.frame_start, scene.frame_end = 3, 1
scene.frame_start = 3
task.use_scene_range, task.frame_start, task.frame_end = False, 5, 4
with refused("before it starts"):
    retarget()
task.frame_start, task.frame_end = 1, 3
basis = part("bridge.meshes").read_positions(task.source.data)
turned = [basis @ np.array([[np.cos(a), np.sin(a), 0], [-np.sin(a), np.cos(a), 0], [0, 0, 1]]) for a in (0.1, 0.2, 0.3)]
act(np.array(turned, np.float32))
with refused("rigidly"):
    retarget()
frames = wave(task.source, 3)
frames[1, 7] = np.nan
act(frames)
with refused("NaN"):
    retarget()
act(wave(task.source, 3))
task.source.hide_set(True)
with refused("'source'", "hidden"):
    retarget()
task.source.hide_set(False)
subdivided = task.source.modifiers.new("finer", "SUBSURF")
with refused("'source'", "'finer'", "81"):
    retarget()
task.source.modifiers.remove(subdivided)

# The faces.
part("bridge.shape_keys").ensure_basis(task.target).points[5].co.z = float("nan")
with refused("'target'", "NaN", "vertex 5"):
    retarget()
task.target.shape_key_clear()
loose = bpy.data.objects.new("no faces", bpy.data.meshes.new("no faces"))
scene.collection.objects.link(loose)
loose.data.vertices.add(3)
whole, task.target = task.target, loose
with refused("'no faces'"):
    retarget()
task.target = whole

# Examples.
task.examples.add().name = "joy"
with refused("'joy'", "no shape key"):
    retarget()
bpy.ops.facial_retarget.create_examples()
examples.write_example(task.source, "joy", basis * 1.1)
with refused("'joy'", "'target'"):
    retarget()
task.examples.clear()

# A base mesh that is none.
task.base = loose
with refused("'no faces'", "feature_point"):
    retarget()
task.base = part("bridge.points.base_object").show_triangles(task.source, (("p0", "p1", "p2"),))
task.base.data.attributes["feature_point"].data[1].value = b""
with refused("'source base'", "vertex 1"):
    retarget()
task.base = None

# Places that cannot be written.
task.report = str(folder / "no" / "folder" / "report.json")
with refused("no folder"):
    retarget()
