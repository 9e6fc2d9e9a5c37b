"""Give two heads feature points without placing one: guess, accept, mirror, copy, and change the mesh below them.

Run it in a Blender that has the extension: blender --background --python 09_guess_points.py
"""

import bpy

bpy.ops.wm.read_homefile(use_empty=True)
bpy.ops.facial_retarget.add_faces(target="child", points=False)
task = bpy.context.scene.facial_retarget
source, target = task.source, task.target


def choose(active: bpy.types.Object, *others: bpy.types.Object) -> None:
    """Operators on points work on the active object; copies go to the other selected ones."""
    for thing in bpy.context.view_layer.objects:
        thing.select_set(thing in (active, *others))
    bpy.context.view_layer.objects.active = active


# The face is found by the shape of the head; what is proposed counts once it is accepted.
choose(source)
source.facial_retarget.point_set = "DENSE"
bpy.ops.facial_retarget.guess_points()
print(len(source.facial_retarget.proposals), "points proposed on", source.name)
bpy.ops.facial_retarget.accept_points()

# Points of the subject's left half decide; doubtful ones say why.
bpy.ops.facial_retarget.mirror_points(which="LEFT")
for point in source.facial_retarget.points:
    if point.doubt:
        print(point.title, point.doubt)

# Another topology gets them through a fit of the surfaces, by the points that it has: here those of the least set.
choose(target)
target.facial_retarget.point_set = "MINIMAL"
bpy.ops.facial_retarget.guess_points()
bpy.ops.facial_retarget.accept_points()
choose(source, target)
bpy.ops.facial_retarget.copy_points()
assert len(target.facial_retarget.points) == len(source.facial_retarget.points)

# The mesh may change below its points.
choose(target)
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.select_all(action="SELECT")
bpy.ops.mesh.subdivide()
bpy.ops.object.mode_set(mode="OBJECT")
assert target.facial_retarget.stale_points
bpy.ops.facial_retarget.refresh_points()
print(len(target.facial_retarget.points), "points on", len(target.data.vertices), "vertices")
