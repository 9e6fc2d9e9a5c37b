"""Retarget an animated face onto another one and bake the result as shape keys.

Any animation drives the source: shape keys as here, an armature, a cache, modifiers.
"""

from pathlib import Path

import bpy
from mathutils import Vector

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

# The source raises its brows: a shape key with animation.
source.shape_key_add(name="Basis", from_mix=False)
brows = source.shape_key_add(name="brows", from_mix=False)
for vertex, key in zip(source.data.vertices, brows.points, strict=True):
    lift = max(0.0, 1 - (vertex.co - Vector((0.0, -0.8, 0.55))).length / 0.6)
    key.co.z += 0.15 * lift**2
for frame, value in ((1, 0.0), (5, 1.0), (8, 0.2)):
    brows.value = value
    brows.keyframe_insert("value", frame=frame)

# The task: what the panel shows.
task = bpy.context.scene.facial_retarget
task.source, task.target = source, target
task.use_scene_range, task.frame_start, task.frame_end = False, 1, 8
task.hierarchical.levels = 3

bpy.ops.facial_retarget.retarget()
print([key.name for key in target.data.shape_keys.key_blocks])
