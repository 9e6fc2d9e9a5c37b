"""Take one frame of a performance apart into levels, with the wavelet method, and try a level's strength.

Each level is a shape key of a new object: what *Show Levels* in the panel makes.
"""

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


bpy.ops.wm.read_homefile(use_empty=True)
source, target = monkey("source", 2), monkey("target", 1)
source.shape_key_add(name="Basis", from_mix=False)
frown = source.shape_key_add(name="frown", from_mix=False)
for vertex, key in zip(source.data.vertices, frown.points, strict=True):
    if vertex.co.z > 0.3 and vertex.co.y < -0.4:
        key.co.z -= 0.1
frown.value = 1.0

task = bpy.context.scene.facial_retarget
task.source, task.target, task.method = source, target, "wavelet"
task.wavelet.levels = 3
bpy.ops.facial_retarget.show_levels()
levels = bpy.data.objects["target levels"].data.shape_keys.key_blocks
for key in levels[1:]:
    moved = max((a.co - b.co).length for a, b in zip(key.points, levels["Basis"].points, strict=True))
    print(f"{key.name} moves a vertex by up to {moved:.4f}")

# Half the first level, in the view and then in the bake.
levels["level 1"].value = 0.5
task.wavelet.level_gains[0] = 0.5
task.use_scene_range, task.frame_start, task.frame_end = False, 1, 1
bpy.ops.facial_retarget.retarget()
print([key.name for key in target.data.shape_keys.key_blocks])
