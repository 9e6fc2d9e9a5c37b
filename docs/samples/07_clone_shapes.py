"""Give a head the shape keys of another: here of the built-in actor, then from Suzanne to a second Suzanne.

Run it in a Blender that has the extension: blender --background --python 07_clone_shapes.py
"""

from pathlib import Path

import bpy

POINTS = str(Path(__file__).with_name("suzanne_points.json"))


def suzanne(name: str) -> bpy.types.Object:
    """Blender's monkey with feature points; subdividing keeps the numbers of its coarse vertices."""
    bpy.ops.mesh.primitive_monkey_add()
    made = bpy.context.object
    made.name = name
    made.modifiers.new("finer", "SUBSURF").levels = 2
    bpy.ops.object.modifier_apply(modifier="finer")
    bpy.ops.facial_retarget.load_points(filepath=POINTS)
    return made


bpy.ops.wm.read_homefile(use_empty=True)
first = suzanne("first")
task = bpy.context.scene.facial_retarget
cloning = task.cloning

# Straight from the built-in actor: no source is needed, and nothing but the shape keys is added to the scene.
# bpy.ops.facial_retarget.add_actor(sets={"arkit"}) puts the actor into the scene instead.
cloning.donor, cloning.actor_sets = "ACTOR", {"arkit", "visemes"}
cloning.keep, cloning.drop = "*", "viseme_nn, viseme_RR"
task.target = first
bpy.ops.facial_retarget.clone_shapes()
print(len(first.data.shape_keys.key_blocks) - 1, "shape keys, the ones with the most trouble first:")
for key in list(first.facial_retarget.cloned)[:3]:
    print(" ", key.name, key.note)

# All figures lie in a text of the .blend.
print(bpy.data.texts["Cloned Shapes"].as_string()[:200])

# Learning from you: sculpt a key, and solve the others again. What you have changed stays as it is.
smile, basis = first.data.shape_keys.key_blocks["mouthSmileLeft"], first.data.shape_keys.reference_key
for place, still in zip(smile.points, basis.points, strict=True):
    place.co = still.co + 1.5 * (place.co - still.co)
bpy.ops.facial_retarget.resolve_shapes()

# From head to head: every key with its range, value, drivers and animation, onto all selected heads.
smile.slider_max = 1.5
for frame, value in ((1, 0.0), (12, 1.2), (24, 0.0)):
    smile.value = value
    smile.keyframe_insert("value", frame=frame)
second = suzanne("second")
cloning.donor, cloning.targets, cloning.existing = "SOURCE", "SELECTED", "REPLACE"
cloning.keep, cloning.drop = "mouth*, jaw*, eye*", "mouthClose"
task.source = first

# Objects of a head: list them on its face; here an eye patch that follows the lids.
bpy.ops.mesh.primitive_plane_add(size=0.1, location=(0.35, -0.95, 0.35), rotation=(1.5, 0, 0))
patch = bpy.context.object
part = second.facial_retarget.parts.add()
part.thing, part.role = patch, "lashes"

for thing in bpy.data.objects:
    thing.select_set(thing == second)
bpy.ops.facial_retarget.clone_shapes()
bpy.context.scene.frame_set(12)
print(second.data.shape_keys.key_blocks["mouthSmileLeft"].value, "on the second Suzanne at frame 12")
