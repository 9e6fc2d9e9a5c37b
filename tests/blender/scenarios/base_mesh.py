"""The base mesh is built, shown on both faces, and can be changed by hand and used."""

import bpy
import numpy as np
from stage import empty_scene, part

empty_scene()
demo, meshes, points, base_object = (
    part("demo"),
    part("bridge.meshes"),
    part("bridge.points.points"),
    part("bridge.points.base_object"),
)
task = bpy.context.scene.facial_retarget
for role, face in (("source", demo.actor(12_000)), ("target", demo.targets()[1])):
    file = part("files.mesh_file").MeshFile(face.face.mesh, face.counts, face.corners)
    setattr(task, role, meshes.new_face(face.name, file))
    points.write_points(getattr(task, role), face.face.points)
task.target.scale, task.target.location = (3, 3, 3), (9, 0, 0)
bpy.context.view_layer.update()

for _ in range(2):  # the second time replaces the first
    bpy.ops.facial_retarget.show_base()
shown = [bpy.data.objects["actor base"], bpy.data.objects["skull base"]]
assert len(bpy.data.objects) == 4
triangles = [base_object.read_base(thing) for thing in shown]
assert triangles[0] == triangles[1], "both faces use one connectivity"
assert shown[0].display_type == "WIRE"
for thing, face in zip(shown, (task.source, task.target), strict=True):
    assert np.allclose(thing.matrix_world, face.matrix_world)
    places = dict(zip(points.read_points(face).names, points.point_positions(face), strict=True))
    for vertex, name in zip(thing.data.vertices, thing.data.attributes["feature_point"].data, strict=True):
        np.testing.assert_allclose(vertex.co, places[name.value.decode()], atol=1e-6)

# The artist deletes a vertex in Edit Mode: the others keep their names, and the base is used.
own = shown[0]
lost = own.data.attributes["feature_point"].data[0].value.decode()
bpy.context.view_layer.objects.active = own
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.select_all(action="DESELECT")
bpy.ops.object.mode_set(mode="OBJECT")
own.data.vertices[0].select = True
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.delete(type="VERT")
bpy.ops.object.mode_set(mode="OBJECT")
task.base = own
kept = part("bridge.task").read_problem(bpy.context).base


def turned(corners: tuple[str, str, str]) -> tuple[str, ...]:
    """The same triangle with its first name in front."""
    start = corners.index(min(corners))
    return corners[start:] + corners[:start]


assert {turned(c) for c in kept} == {turned(c) for c in triangles[0] if lost not in c}
