"""Shape keys of one face on another: the shapes that core gives, and all that a key is beside its shape."""

import json

import bpy
import numpy as np
from stage import donor_pair, empty_scene, key_shape, part, shown, snapshot

empty_scene()
context = bpy.context
clone = bpy.ops.facial_retarget.clone_shapes
task = context.scene.facial_retarget
cloning = task.cloning
assert not clone.poll()
source, target = donor_pair()
task.source = source
assert not clone.poll()
task.target = target
assert clone.poll()
NAMES = ["joy", "sadness", "anger", "fear", "disgust", "surprise"]

# Traits: a range, a value, a muted key, a mask that the target has no group for, and one that it has.
keys = source.data.shape_keys.key_blocks
keys["joy"].slider_min, keys["joy"].slider_max, keys["joy"].value = -1.5, 3.0, 0.25
keys["anger"].slider_max, keys["anger"].slider_min = 4.0, 2.0
keys["sadness"].mute = True
for name in ("left", "upper"):
    group = source.vertex_groups.new(name=name)
    group.add([v.index for v in source.data.vertices if v.co[0 if name == "left" else 1] > 0], 0.75, "REPLACE")
keys["fear"].vertex_group, keys["disgust"].vertex_group = "left", "upper"
group = target.vertex_groups.new(name="upper")
group.add([v.index for v in target.data.vertices if v.co[1] > 0], 0.75, "REPLACE")
keys["surprise"].relative_key = keys["joy"]

# Drivers: of a property of the source's object, of an own shape key, and of a bone.
armature = bpy.data.objects.new("rig", bpy.data.armatures.new("rig"))
context.scene.collection.objects.link(armature)
source["dial"] = 0.5


def drive(name: str, thing: bpy.types.ID, kind: str, path: str, expression: str) -> None:
    """Let a property drive a shape key of the source."""
    driver = source.data.shape_keys.driver_add(f'key_blocks["{name}"].value').driver
    variable = driver.variables.new()
    variable.targets[0].id_type = kind
    variable.targets[0].id, variable.targets[0].data_path = thing, path
    driver.expression = expression


drive("fear", source, "OBJECT", '["dial"]', "var * 0.5")
drive("disgust", source.data.shape_keys, "KEY", 'key_blocks["joy"].value', "var + 0.1")
drive("surprise", armature, "OBJECT", "location.x", "var")

# Animation, with a curve's handles and modifier.
for frame, value in ((1, 0.0), (10, 0.8), (25, -0.5)):
    keys["joy"].value = value
    keys["joy"].keyframe_insert("value", frame=frame)
bag = part("bridge.curves").find_curves(source.data.shape_keys)
bag.fcurves[0].keyframe_points[1].interpolation = "BOUNCE"
bag.fcurves[0].modifiers.new("CYCLES")

bpy.ops.ed.undo_push(message="before")
before = snapshot()
assert clone() == {"FINISHED"}
bpy.ops.ed.undo_push(message="after")
bpy.ops.ed.undo()
assert snapshot() == before
bpy.ops.ed.redo()
source, target, armature = (bpy.data.objects[name] for name in ("source", "target", "rig"))
task = context.scene.facial_retarget
cloning = task.cloning
keys, made = source.data.shape_keys.key_blocks, target.data.shape_keys.key_blocks
assert [key.name for key in made] == ["Basis", *NAMES], list(made)

# The shapes are those of core, out of what the artist sees.
heads, clones = part("bridge.heads"), part("core.shapes.clone")
ours, theirs = heads.read_head(source), heads.read_head(target)
shapes = part("core.shapes.shape_set").ShapeSet(tuple(NAMES), ours.displacements(NAMES, {"upper"}))
settings = part("core.methods.settings").MotionCloningSettings()
expected = clones.clone_shapes("motion_cloning", part("core.problem").Problem(ours.face, theirs.face), settings, shapes)
for name in NAMES:
    moved = key_shape(target, name) - key_shape(target, made[name].relative_key.name)
    np.testing.assert_allclose(moved, expected.shapes[name], atol=2e-6, err_msg=name)
    assert np.abs(moved).max() > 0.01, name
masked = np.abs(key_shape(target, "fear") - key_shape(target, "Basis"))
assert masked[key_shape(target, "Basis")[:, 0] < -0.5].max() < 0.02 * masked.max(), (
    "the mask of fear is not in its shape"
)

# What a key is beside its shape.
for key in keys[1:]:
    own = made[key.name]
    assert (own.slider_min, own.slider_max, own.mute) == (key.slider_min, key.slider_max, key.mute), key.name
    assert own.relative_key.name == key.relative_key.name
    assert own.vertex_group == ("upper" if key.name == "disgust" else "")
assert made["anger"].value == keys["anger"].value == 2

# Drivers and curves play the same on both.
reads = {
    driver.data_path: driver.driver.variables[0].targets[0].id
    for driver in target.data.shape_keys.animation_data.drivers
}
assert list(reads.values()) == [source, target.data.shape_keys, armature], reads
source["dial"], armature.location.x = 1.0, 0.7
source.update_tag()
for frame in (1, 7, 10, 18, 25, 40):
    context.scene.frame_set(frame)
    assert [key.value for key in made] == [key.value for key in keys], frame
context.scene.frame_set(1)
assert abs(made["fear"].value - 0.5) < 1e-6
assert abs(made["surprise"].value - 0.7) < 1e-6
target.data.shape_keys.animation_data.action = None
made["joy"].value = 0.9
context.view_layer.update()
assert abs(made["disgust"].value - 1.0) < 1e-6, "the target's key does not follow the target's own joy"

# The list and the report name each key, the worst first.
entries = target.facial_retarget.cloned
assert sorted(entry.name for entry in entries) == sorted(NAMES)
report = json.loads(bpy.data.texts["Cloned Shapes"].as_string())
rows = report["target"]["shapes"]
assert [row["name"] for row in rows] == [entry.name for entry in entries]
trouble = part("bridge.cloning.clone_report").trouble
sums = [sum(trouble(row).values()) for row in rows]
assert sums == sorted(sums, reverse=True), sums
bad = {"name": "joy", "torn_edges": 3, "lip_gap_percent": 30.0, "source_lip_gap_percent": 28.0, "lid_gap_percent": None}
assert trouble(bad) == {"torn_edges": 3, "lip_gap_percent": 2}
assert part("bridge.cloning.clone_report").figures_note(bad) == "torn edges 3, lip gap +2 %"

# Existing keys are kept, replaced, or stand beside numbered ones.
sculpted = key_shape(target, "joy") + np.float32(0.1)
write = part("bridge.shape_keys").write_key
still = key_shape(target, "Basis")
write(made["joy"], sculpted)
write(made["anger"], still)
assert clone() == {"FINISHED"}
assert np.array_equal(key_shape(target, "joy"), sculpted)
assert not np.array_equal(key_shape(target, "anger"), still), "an empty key is filled"
cloning.existing = "SUFFIX"
cloning.keep = "joy, sad*"
clone()
assert [key.name for key in made] == ["Basis", *NAMES, "joy.001", "sadness.001"]
clone()
assert [key.name for key in made][-2:] == ["joy.002", "sadness.002"]
np.testing.assert_allclose(key_shape(target, "joy.001") - still, expected.shapes["joy"], atol=2e-6)
assert np.array_equal(key_shape(target, "joy"), sculpted)
cloning.existing, cloning.keep, cloning.drop = "REPLACE", "*", "fear"
write(made["fear"], still)
count = len(target.data.shape_keys.animation_data.drivers)
clone()
np.testing.assert_allclose(key_shape(target, "joy") - still, expected.shapes["joy"], atol=2e-6)
assert np.array_equal(key_shape(target, "fear"), still), "a key that was not wanted has changed"
assert len(target.data.shape_keys.animation_data.drivers) == count, "drivers were doubled"
assert len(made) == 11

# Halves: they add up to the whole, and have its range and driver.
cloning.keep, cloning.drop, cloning.sides = "joy, disgust", "", "SPLIT"
clone()
assert [key.name for key in made][-4:] == ["joy_L", "joy_R", "disgust_L", "disgust_R"], list(made)
both = key_shape(target, "joy_L") + key_shape(target, "joy_R") - still
np.testing.assert_allclose(both, key_shape(target, "joy"), atol=2e-6)
assert made["joy_L"].slider_max == 3
assert 'key_blocks["disgust_R"].value' in {d.data_path for d in target.data.shape_keys.animation_data.drivers}
context.scene.frame_set(10)
assert made["joy_L"].value == made["joy_R"].value == keys["joy"].value

# ARKit's names and wholes: of halves in another spelling.
for name, old in (("browInnerUp_L", "joy"), ("browInnerUp_R", "anger"), ("Jaw_Open", "surprise")):
    part("bridge.examples.examples").write_example(source, name, key_shape(source, old))
cloning.keep, cloning.sides, cloning.arkit_names = "browInnerUp*, Jaw*", "MERGE", True
clone()
assert [key.name for key in made][-2:] == ["browInnerUp", "jawOpen"], list(made)
moved = key_shape(target, "browInnerUp") - still
np.testing.assert_allclose(moved, expected.shapes["joy"] + expected.shapes["anger"], atol=2e-5)
assert [origin.name for origin in target.facial_retarget.cloned["browInnerUp"].origins] == [
    "browInnerUp_L",
    "browInnerUp_R",
]
cloning.keep, cloning.sides, cloning.arkit_names = "joy, disgust", "AS_THEY_ARE", False

# Without drivers and animation.
target.shape_key_clear()
cloning.copy_drivers = cloning.copy_animation = False
clone()
assert target.data.shape_keys.animation_data is None
assert np.isfinite(shown(target)).all()
