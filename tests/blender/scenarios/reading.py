"""Any animation drives: the evaluated mesh is read, in face space, and the scene is put back."""

import bpy
import numpy as np
from mathutils import Matrix
from stage import empty_scene, grid, part, refused, wave

empty_scene()
meshes, performance, background = part("bridge.meshes"), part("bridge.performance"), part("bridge.background")
context = bpy.context
face = grid("face")


def read(first: int = 1, last: int = 4) -> np.ndarray:
    """The frames that the bridge reads."""
    return background.finished(performance.read_frames(context, face, range(first, last + 1)))


# Shape keys.
frames = wave(face, 4)
part("bridge.bakes.frames").write_frames(face, frames, 1)
context.scene.frame_set(3, subframe=0.25)
np.testing.assert_allclose(read(), frames, atol=2e-7)
assert (context.scene.frame_current, context.scene.frame_subframe) == (3, 0.25)

# An armature, over the shape keys.
rig = bpy.data.objects.new("rig", bpy.data.armatures.new("rig"))
context.scene.collection.objects.link(rig)
context.view_layer.objects.active = rig
bpy.ops.object.mode_set(mode="EDIT")
rig.data.edit_bones.new("jaw").tail = (0, 0, 1)
bpy.ops.object.mode_set(mode="OBJECT")
face.vertex_groups.new(name="jaw").add(range(6), 1.0, "REPLACE")
modifier = face.modifiers.new("rig", "ARMATURE")
modifier.object = rig
bone = rig.pose.bones["jaw"]
for frame in (1, 4):
    bone.location.x = frame - 1
    bone.keyframe_insert("location", frame=frame)
moved = read() - frames
assert abs(moved[-1, :6]).max() > 2.9
assert abs(moved[:, 6:]).max() < 1e-6
assert abs(moved[0]).max() < 1e-6

# A cache's neutral is how it looks at one frame.
task = context.scene.facial_retarget
task.source, task.target, task.source_neutral, task.neutral_frame = face, grid("other"), "FRAME", 2
assert np.array_equal(part("bridge.task").read_problem(context).source.mesh.vertices, read(2, 2)[0].astype(np.float64))
task.source_neutral = "BASIS"
assert np.array_equal(part("bridge.task").read_problem(context).source.mesh.vertices, meshes.read_positions(face.data))

# Stopping half-way puts the frame back.
steps = performance.read_frames(context, face, range(1, 5))
next(steps)
steps.close()
assert (context.scene.frame_current, context.scene.frame_subframe) == (3, 0.25)

# Rotation, location and even scale stay out; uneven scale and mirroring count.
plain = meshes.read_face(face)
face.matrix_world = Matrix.Translation((3, 2, 1)) @ Matrix.Rotation(0.7, 4, "Y") @ Matrix.Scale(2.5, 4)
context.view_layer.update()
assert np.array_equal(meshes.read_face(face).mesh.vertices, plain.mesh.vertices)
for scale in ((1, 1, 2), (-1, 1, 1), (-2, 3, 0.5)):
    face.matrix_world = Matrix.Rotation(0.7, 4, "Y") @ Matrix.Diagonal((*scale, 1))
    context.view_layer.update()
    seen = meshes.read_face(face).mesh
    world = plain.mesh.vertices @ np.array(face.matrix_world)[:3, :3].T
    # The same distances as in the world, and the same side outside.
    gram = (seen.vertices - seen.vertices[0]) @ (seen.vertices - seen.vertices[0]).T
    np.testing.assert_allclose(gram, (world - world[0]) @ (world - world[0]).T, atol=1e-5)
    outwards = np.cross(seen.vertices[1] - seen.vertices[0], seen.vertices[6] - seen.vertices[0])
    in_world = np.cross(world[1] - world[0], world[6] - world[0])
    turned = np.sign(np.prod(scale))
    corner = seen.vertices[:6].mean(axis=0)
    triple = np.linalg.det([seen.vertices[1] - corner, seen.vertices[6] - corner, seen.vertices[35] - corner])
    triple_in_world = np.linalg.det(
        [world[1] - world[:6].mean(0), world[6] - world[:6].mean(0), world[35] - world[:6].mean(0)]
    )
    np.testing.assert_allclose(triple, triple_in_world, rtol=1e-4)  # a rotation lies between them, no reflection
    assert turned * np.dot(seen.face_normals.mean(axis=0), outwards) > 0
    assert np.linalg.norm(outwards) - np.linalg.norm(in_world) < 1e-5
    back = meshes.from_face_space(face, meshes.to_face_space(face, frames))
    np.testing.assert_allclose(back, frames, atol=1e-6)
face.matrix_world = Matrix.Diagonal((1, 0, 1, 1))
context.view_layer.update()
with refused("'face'", "scaled to nothing"):
    meshes.read_face(face)
face.matrix_world = Matrix.Identity(4)
context.view_layer.update()

# What cannot be read is said.
face.modifiers.new("smoother", "SUBSURF").levels = 1
with refused("'face'", "36", "'smoother'"):
    read()
face.modifiers.remove(face.modifiers["smoother"])
with refused("before it starts"):
    read(4, 3)
face.hide_viewport = True
with refused("'face'", "hidden"):
    read()
face.hide_viewport = False
face.data.shape_keys.reference_key.points[4].co.x = float("nan")
with refused("'face'", "vertex 4", "NaN"):
    meshes.read_face(face)
face.shape_key_clear()
face.data.clear_geometry()
with refused("'face'", "no faces"):
    meshes.read_face(face)
