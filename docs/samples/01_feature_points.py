"""Give a face its feature points, from a file and by hand.

Run it in a Blender that has the extension: blender --background --python 01_feature_points.py
"""

from pathlib import Path

import bpy

bpy.ops.wm.read_homefile(use_empty=True)
bpy.ops.mesh.primitive_monkey_add()
suzanne = bpy.context.object

# Operators work on the active object. A file holds names and places: vertices, weights, or positions to be snapped.
bpy.ops.facial_retarget.load_points(filepath=str(Path(__file__).with_name("suzanne_points.json")))

# One more point, where the surface is closest to the 3D cursor.
bpy.context.scene.cursor.location = (0.0, -0.6, 0.9)
bpy.ops.facial_retarget.add_point(name="hair_line", place="CURSOR")

# The points live on the object: they are saved with the .blend.
for point in suzanne.facial_retarget.points:
    print(point.name, *point.vertices, *point.weights)
