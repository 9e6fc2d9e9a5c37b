"""The built-in actor lends its shapes: as an object of the scene, or without leaving one behind."""

import bpy
import numpy as np
from stage import demo_object, empty_scene, key_shape, part, snapshot

empty_scene()
context = bpy.context
operators = bpy.ops.facial_retarget
task = context.scene.facial_retarget
sets = part("core.mpeg4.sets").SETS

# As an object: it stands upright, has its points, and is the source.
bpy.ops.ed.undo_push(message="before")
before = snapshot()
assert operators.add_actor(sets={"arkit", "expressions"}) == {"FINISHED"}
bpy.ops.ed.undo_push(message="after")
bpy.ops.ed.undo()
assert snapshot() == before
bpy.ops.ed.redo()
task = context.scene.facial_retarget
actor = task.source
context.view_layer.update()
names = [key.name for key in actor.data.shape_keys.key_blocks[1:]]
assert names == [*sets["arkit"], *sets["expressions"]], names
assert all(key.value == 0 for key in actor.data.shape_keys.key_blocks[1:])
assert len(actor.facial_retarget.points) > 80
named = part("bridge.heads").read_head(actor).face.named_parts
# Weights of a bone, or hair on the skin, that bear a part's name are no part.
beard = actor.vertex_groups.new(name="beard")
beard.add(range(len(actor.data.vertices)), 0.5, "REPLACE")
assert part("bridge.heads").read_head(actor).face.named_parts.keys() == named.keys()
actor.vertex_groups.remove(beard)
built = part("demo").donor().face.named_parts
assert named.keys() == built.keys()
assert all(np.array_equal(np.sort(named[name]), np.sort(built[name])) for name in named)
rows = part("bridge.points.points").point_positions(actor) @ np.array(actor.matrix_world)[:3, :3].T
places = dict(zip([point.name for point in actor.facial_retarget.points], rows, strict=True))
assert places["2.1"][2] < places["9.3"][2], "the chin is not below the nose"
assert places["9.3"][1] < places["2.1"][1] + 0.5, "the face does not look along -Y"

# Straight from the actor: the same shapes, and nothing is left behind but the keys and the report.
warped = part("demo").warped_actor(np.random.default_rng(1), 4_500)
task.target = demo_object(warped, "from object")
operators.clone_shapes()
straight = demo_object(warped, "straight")
task.source, task.target = None, straight
task.cloning.donor, task.cloning.actor_sets = "ACTOR", {"arkit", "expressions"}
before = snapshot()
assert operators.clone_shapes() == {"FINISHED"}
after = snapshot()
assert after["objects"] == before["objects"]
assert after["meshes"] == before["meshes"]
assert [key.name for key in straight.data.shape_keys.key_blocks[1:]] == names
size = np.ptp(key_shape(straight, "Basis"))
for name in names:
    moved = key_shape(straight, name)
    np.testing.assert_allclose(moved, key_shape(bpy.data.objects["from object"], name), atol=1e-5 * size, err_msg=name)
    assert np.abs(moved - key_shape(straight, "Basis")).max() > 1e-3 * size, name
