"""Feature points on an object: files, cursor, selected vertex."""

import json
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix
from stage import empty_scene, enable, grid, part, refused

empty_scene()
folder = Path(sys.argv[1])
points = part("bridge.points.points")
face = grid("face")
bpy.context.view_layer.objects.active = face

# From a file and back, exactly.
document = {
    "format": "facial-retarget/feature-points",
    "version": 1,
    "points": {
        "2.1": {"vertices": [0, 1, 7], "weights": [0.25, 0.5, 0.25]},
        'a "name"': {"vertex": 35},
        "9.3": {"position": [0.1, 0.2, 0.98]},
    },
}
(folder / "in.json").write_text(json.dumps(document))
bpy.ops.facial_retarget.load_points(filepath=str(folder / "in.json"))
bpy.ops.facial_retarget.save_points(filepath=str(folder / "out.json"))
saved = json.loads((folder / "out.json").read_text())["points"]
assert saved["2.1"] == document["points"]["2.1"], saved
assert saved['a "name"'] == {"vertex": 35}, saved
assert json.loads((folder / "out.json").read_text())["mesh_vertices"] == 36
assert list(saved) == ["2.1", 'a "name"', "9.3"], saved
np.testing.assert_allclose(points.point_positions(face)[2, :2], [0.1, 0.2], atol=0.02)

# At the 3D cursor, on a face that stands somewhere else, turned, scaled and mirrored.
face.matrix_world = Matrix.Translation((5, 6, 7)) @ Matrix.Rotation(1, 4, "X") @ Matrix.Diagonal((-2, 3, 0.5, 1))
bpy.context.view_layer.update()
for vertex in (8, 27):
    bpy.context.scene.cursor.location = face.matrix_world @ face.data.vertices[vertex].co
    bpy.ops.facial_retarget.add_point(name=f"at {vertex}", place="CURSOR")
    place = points.point_positions(face)[-1]
    np.testing.assert_allclose(place, face.data.vertices[vertex].co, atol=1e-5)

# On the selected vertex, in Edit Mode.
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.select_all(action="DESELECT")
with refused("0 selected"):
    bpy.ops.facial_retarget.add_point(name="chin", place="VERTEX")
bpy.ops.object.mode_set(mode="OBJECT")
face.data.vertices[13].select = True
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.facial_retarget.add_point(name="chin", place="VERTEX")
bpy.ops.object.mode_set(mode="OBJECT")
assert points.read_points(face).vertices[-1].tolist() == [13, 13, 13]

# Points survive saving.
before = points.read_points(face)
bpy.ops.wm.save_as_mainfile(filepath=str(folder / "points.blend"))
bpy.ops.wm.open_mainfile(filepath=str(folder / "points.blend"))
enable()
face = bpy.data.objects["face"]
after = points.read_points(face)
assert after.names == before.names
assert np.array_equal(after.vertices, before.vertices)
assert np.array_equal(after.weights, before.weights)

# Bad input.
with refused("'chin'", "already"):
    bpy.ops.facial_retarget.add_point(name="chin", place="CURSOR")
with refused("no name"):
    bpy.ops.facial_retarget.add_point(name="", place="CURSOR")
with refused("missing.json"):
    bpy.ops.facial_retarget.load_points(filepath=str(folder / "missing.json"))
document["points"]["2.1"]["vertices"] = [0, 1, 36]
(folder / "bad.json").write_text(json.dumps(document))
with refused("bad.json", "'2.1'", "35"):
    bpy.ops.facial_retarget.load_points(filepath=str(folder / "bad.json"))
other = grid("other", 7)
bpy.context.view_layer.objects.active = other
with refused("out.json", "36 vertices", "49"):
    bpy.ops.facial_retarget.load_points(filepath=str(folder / "out.json"))
bpy.context.view_layer.objects.active = face
face.facial_retarget.points[0].name = "chin"
with refused("'chin'", "twice"):
    bpy.ops.facial_retarget.save_points(filepath=str(folder / "twice.json"))
assert not (folder / "twice.json").exists()
bpy.ops.facial_retarget.remove_point()
assert "chin" in face.facial_retarget.points
bpy.context.view_layer.objects.active = None
assert not bpy.ops.facial_retarget.remove_point.poll()
