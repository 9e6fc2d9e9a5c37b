"""Mirror makes an example symmetric or flips it, on all objects of the head; what it lacks is said."""

import bpy
import numpy as np
from stage import demo_object, empty_scene, key_shape, part, refused

empty_scene()
task = bpy.context.scene.facial_retarget
mirror = bpy.ops.facial_retarget.mirror_example
child = part("demo").child()
task.source, task.target = demo_object(child, "source"), demo_object(child, "target", pieces=True)
bpy.ops.facial_retarget.create_examples()
made = part("core.mirroring.mirror").fit_mirror(child.face.mesh, child.counts, child.corners, child.face.points)

rest = key_shape(task.source, "Basis")
moved = np.zeros_like(rest)
moved[:, 1] = np.where(rest[:, 0] > 20, 3.0, 0.0)
for example, way in (
    ("joy", "FLIP"),
    ("anger", "LEFT_TO_RIGHT"),
    ("fear", "RIGHT_TO_LEFT"),
    ("disgust", "BOTH"),
):
    part("bridge.examples.examples").write_example(task.source, example, rest + moved)
    assert mirror(example=example, side="SOURCE", way=way) == {"FINISHED"}
    wanted = made.shape(((rest + moved) - rest).astype(np.float64), way)
    np.testing.assert_allclose(key_shape(task.source, example) - rest, wanted, atol=1e-4)

# The eyes are objects of their own: what the left one does, the right one does then.
eyes = [entry.thing for entry in task.target.facial_retarget.parts]
assert len(eyes) == 4
left = max(eyes, key=lambda thing: part("bridge.meshes").read_positions(thing.data)[:, 0].mean())
right = min(eyes, key=lambda thing: part("bridge.meshes").read_positions(thing.data)[:, 0].mean())
still = part("bridge.meshes").read_positions(left.data)
part("bridge.examples.examples").write_example(left, "joy", still + np.float32([0, 0, 2]))
mirror(example="joy", side="TARGET", way="FLIP")
np.testing.assert_allclose(key_shape(left, "joy"), still, atol=1e-4)
np.testing.assert_allclose(
    key_shape(right, "joy") - key_shape(right, "Basis"), np.tile([0, 0, 2], (len(right.data.vertices), 1)), atol=1e-3
)

with refused("'target'", "fear"):
    mirror(example="fear", side="TARGET")
