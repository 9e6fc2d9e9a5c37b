"""Let a target follow its source live, make its mouth move less, and compare two methods before anything is baked."""

from pathlib import Path

import bpy

POINTS = str(Path(__file__).with_name("suzanne_points.json"))


def monkey(name: str, detail: int) -> bpy.types.Object:
    """Blender's monkey with feature points, subdivided `detail` times."""
    bpy.ops.mesh.primitive_monkey_add()
    made = bpy.context.object
    made.name = name
    made.modifiers.new("finer", "SUBSURF").levels = detail
    bpy.ops.object.modifier_apply(modifier="finer")
    bpy.ops.facial_retarget.load_points(filepath=POINTS)
    return made


def moved() -> float:
    """How far all vertices of the target are from their neutral together."""
    seen = target.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    return sum((a.co - b.co).length for a, b in zip(seen.vertices, target.data.vertices, strict=True))


bpy.ops.wm.read_homefile(use_empty=True)
source, target = monkey("source", 2), monkey("target", 1)
source.shape_key_add(name="Basis", from_mix=False)
pout = source.shape_key_add(name="pout", from_mix=False)
for vertex, key in zip(source.data.vertices, pout.points, strict=True):
    if vertex.co.z < -0.4:
        key.co.y -= 0.1
pout.value = 0.0

# The target follows the slider; nothing is keyed, and no file holds anything of it.
task = bpy.context.scene.facial_retarget
task.source, task.target, task.method = source, target, "motion_cloning"
task.use_scene_range, task.frame_start, task.frame_end = False, 1, 1
bpy.ops.facial_retarget.start_preview()
for value in (0.0, 0.5, 1.0):
    pout.value = value
    bpy.context.view_layer.update()
    print(f"pout at {value}: the target moves by {moved():.2f}")

# A gain acts at once, here as it does in a bake.
task.regions.mouth = task.regions.jaw = 0.5
print(f"half as strong around the mouth: {moved():.2f}")
task.regions.mouth = task.regions.jaw = 1.0

# Both methods are fitted once; the target then follows by one or the other.
task.compared = {"motion_cloning", "hierarchical"}
bpy.ops.facial_retarget.compare()
for method in sorted(task.compared):
    bpy.ops.facial_retarget.show_method(method=method)
    print(f"{method}: {moved():.2f}")

bpy.ops.facial_retarget.stop_preview()
print("shape keys of the target:", target.data.shape_keys)
