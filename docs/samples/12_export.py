"""Export a head whose shape keys drivers move, read it back, and refuse an export that would lose something."""

import tempfile
from pathlib import Path

import bpy

bpy.ops.wm.read_homefile(use_empty=True)
for addon in ("io_scene_gltf2", "io_scene_fbx"):
    bpy.ops.preferences.addon_enable(module=addon)
folder, scene = Path(tempfile.mkdtemp()), bpy.context.scene
scene.frame_start, scene.frame_end = 1, 10

# A monkey whose pout follows a slider of its own: exporters alone would write the key at 0.
bpy.ops.mesh.primitive_monkey_add()
head = scene.facial_retarget.target = bpy.context.object
head.shape_key_add(name="Basis", from_mix=False)
pout = head.shape_key_add(name='pout "big"', from_mix=False)
for vertex, key in zip(head.data.vertices, pout.points, strict=True):
    if vertex.co.z < -0.4:
        key.co.y -= 0.1
for frame, value in ((1, 0.0), (5, 1.0), (10, 0.2)):
    head["sulk"] = value
    head.keyframe_insert('["sulk"]', frame=frame)
driver = pout.driver_add("value").driver
driver.type = "SUM"
variable = driver.variables.new()
variable.targets[0].id, variable.targets[0].data_path = head, '["sulk"]'

# What is lost is a warning before anything is written; the head itself stays as it is, drivers and all.
for form, suffix in {"gltf": "glb", "fbx": "fbx", "usd": "usdc", "alembic": "abc"}.items():
    file = folder / f"head.{suffix}"
    getattr(bpy.ops.facial_retarget, f"export_{form}")(filepath=str(file))
    print(f"{file.name}: {file.stat().st_size} bytes")
try:
    bpy.ops.facial_retarget.export_fbx(filepath=str(folder / "never.fbx"), only_lossless=True)
except RuntimeError as refused:
    print(refused)

# A plain copy for exporters of your own: every key has its curve.
bpy.ops.facial_retarget.prepare_export()
(copy,) = bpy.data.collections["Export"].objects
curves = copy.data.shape_keys.animation_data.action.layers[0].strips[0].channelbags[0].fcurves
print(copy.name, [(curve.data_path, len(curve.keyframe_points)) for curve in curves])

# What another program finds in the file.
bpy.ops.wm.read_homefile(use_empty=True)
bpy.ops.import_scene.gltf(filepath=str(folder / "head.glb"))
for frame in (1, 5, 10):
    bpy.context.scene.frame_set(frame)
    values = {key.name: round(key.value, 2) for key in bpy.data.meshes[0].shape_keys.key_blocks[1:]}
    print(f"frame {frame}: {values}")
