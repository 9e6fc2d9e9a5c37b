"""Make Suzanne an MPEG-4 face: shapes out of her points, sliders, motion in and out.

Needs the face of 01_feature_points.py, which it runs first.
"""

import runpy
from pathlib import Path
from tempfile import TemporaryDirectory

import bpy

runpy.run_path(str(Path(__file__).with_name("01_feature_points.py")))
suzanne = bpy.context.object

# Shape keys out of her feature points alone: a start to sculpt on. What you have sculpted is kept.
bpy.ops.facial_retarget.make_shapes(sets={"expressions", "visemes"})

# A slider for each FAP: custom properties that drive shape keys, with Blender's own means.
bpy.ops.facial_retarget.make_controls()
suzanne["fap_close_t_l_eyelid"] = 1024.0
for frame, value in ((1, 0.0), (13, 600.0), (25, 0.0)):
    for name in ("fap_raise_l_cornerlip", "fap_raise_r_cornerlip"):
        suzanne[name] = value
        suzanne.keyframe_insert(f'["{name}"]', frame=frame)

# Motion goes out at the scene's rate and comes in as controls, as three shape keys per point, or as frames.
with TemporaryDirectory() as folder:
    smile = str(Path(folder, "smile.fap"))
    bpy.ops.facial_retarget.export_motion(filepath=smile, frame_start=1, frame_end=25)
    bpy.ops.facial_retarget.remove_controls()
    bpy.ops.facial_retarget.import_motion(filepath=smile, way="POINTS", update_scene_duration=True)
bpy.context.scene.frame_set(13)
