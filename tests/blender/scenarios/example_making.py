"""Examples are roughed out of points and cloned from the other face, made stronger, and checked with figures."""

import bpy
import numpy as np
from stage import donor_pair, empty_scene, fitted, grid, key_shape, part, refused

empty_scene()
task = bpy.context.scene.facial_retarget
rough_out, check = bpy.ops.facial_retarget.rough_out, bpy.ops.facial_retarget.check_examples
source, target = task.source, task.target = donor_pair()
bpy.ops.facial_retarget.create_examples()
joy, basis = key_shape(source, "joy"), key_shape(source, "Basis")
with refused("at least one that both faces show"):
    for key in list(source.data.shape_keys.key_blocks)[1:]:
        part("bridge.shape_keys").write_key(key, basis)
    check()

# From the points: what Make Shapes makes, on that face alone.
rough_out(example="surprise", side="TARGET")
shapes = part("core.acting.expression_sets").expression_shapes(fitted(target), ("expressions",))
assert np.array_equal(key_shape(target, "surprise"), shapes["surprise"])
assert np.array_equal(key_shape(target, "joy"), key_shape(target, "Basis"))
assert task.examples["surprise"].target_state == "SCULPTED"

# What is sculpted is kept, unless the artist says otherwise; a whole list is filled around it.
sculpted = key_shape(target, "surprise") + np.float32(0.01)
part("bridge.examples.examples").write_example(target, "surprise", sculpted)
with refused("'target'", "surprise", "Replace"):
    rough_out(example="surprise", side="TARGET")
rough_out(side="TARGET")
assert np.array_equal(key_shape(target, "surprise"), sculpted)
assert np.array_equal(key_shape(target, "fear"), shapes["fear"])
rough_out(example="surprise", side="TARGET", existing="REPLACE")
assert np.array_equal(key_shape(target, "surprise"), shapes["surprise"])

# From the other face: only what it shows.
with refused("'source'", "joy"):
    rough_out(example="joy", side="TARGET", way="CLONE", existing="REPLACE")
part("bridge.examples.examples").write_example(source, "joy", joy)
rough_out(example="joy", side="TARGET", way="CLONE", existing="REPLACE")
cloned = key_shape(target, "joy") - key_shape(target, "Basis")
assert 0.5 < np.abs(cloned).max() / np.abs(joy - basis).max() < 2
rough_out(side="SOURCE", way="CLONE")
assert np.array_equal(key_shape(source, "joy"), joy)
assert all(example.source_state == "SCULPTED" for example in task.examples)

# Free names have no recipe.
for thing in (source, target):
    thing.shape_key_add(name="wart").value = 0
bpy.ops.facial_retarget.add_example(name="wart")
with refused("wart", "expected one that has"):
    rough_out(example="wart", side="TARGET")
task.active_example = len(task.examples) - 1
bpy.ops.facial_retarget.remove_example()

# Figures of each example, as long as it is what was checked.
assert not any(example.checked for example in task.examples)
task.method = "motion_cloning"
assert check() == {"FINISHED"}
for example in task.examples:
    assert example.checked
    assert 0 <= example.fit < example.leave_one_out, (example.name, example.fit, example.leave_one_out)
problem = part("bridge.task").read_problem(bpy.context)
figures = (
    part("core.methods.base")
    .fit("motion_cloning", problem, part("bridge.settings").read_task_settings(task))
    .report["examples"]
)
assert [row["name"] for row in figures] == [example.name for example in task.examples]
np.testing.assert_allclose([row["fit"] for row in figures], [example.fit for example in task.examples], rtol=1e-5)
before = key_shape(target, "fear") - key_shape(target, "Basis")
bpy.ops.facial_retarget.scale_example(example="fear", side="TARGET", factor=0.5)
np.testing.assert_allclose(key_shape(target, "fear") - key_shape(target, "Basis"), 0.5 * before, atol=1e-6)
bpy.context.view_layer.update()
assert not any(example.checked for example in task.examples)
task.method = "feature_points"
with refused("'feature_points'", "learns nothing"):
    check()

# A mesh that both faces share would be changed twice.
twin = bpy.data.objects.new("twin", source.data)
bpy.context.scene.collection.objects.link(twin)
task.target = twin
with refused("mesh", "twin"):
    rough_out(side="TARGET", example="joy")
task.target = grid("bare")
with refused("MPEG-4"):
    rough_out(side="TARGET", example="joy")
with refused("'bare'", "moves nothing"):
    bpy.ops.facial_retarget.scale_example(example="joy", side="TARGET", factor=0.5)
