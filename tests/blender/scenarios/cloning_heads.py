"""Heads of several objects: each part moves as in one mesh, wherever it stands; and several heads at once."""

import bpy
import numpy as np
from mathutils import Euler, Matrix
from stage import demo_object, empty_scene, key_shape, part, shown

empty_scene()
context = bpy.context
task = context.scene.facial_retarget
cloning = task.cloning
demo, heads = part("demo"), part("bridge.heads")
actor, warped = demo.actor(4_500), demo.warped_actor(np.random.default_rng(1), 4_500)
shapes = part("demo.shape_sets").face_shapes(actor, ("arkit",))
WANTED = ("jawOpen", "mouthClose", "eyeBlinkLeft", "eyeLookUpLeft", "browInnerUp")


def head(face: object, name: str, pieces: bool) -> bpy.types.Object:
    """A built-in face; its pieces stand turned, scaled and mirrored where they were."""
    made = demo_object(face, name, pieces)
    made.matrix_world = Matrix.LocRotScale((1, 2, 3), Euler((0.3, 0.2, 0.1)), (2, 2, 2))
    context.view_layer.update()
    for i, entry in enumerate(made.facial_retarget.parts):
        entry.thing.name = f"{name} part {i}"
        own = Matrix.LocRotScale((0.3 * i, 0.1, -0.2), Euler((0.1 * i, 0.4, 0)), (1.5, 1 + 0.2 * i, -0.7))
        entry.thing.data.transform(own.inverted())
        entry.thing.data.flip_normals()  # its object is mirrored: seen from outside it is what it was
        entry.thing.matrix_world = made.matrix_world @ own
    context.view_layer.update()
    return made


def keyed(thing: bpy.types.Object, names: tuple[str, ...]) -> bpy.types.Object:
    """The head with keys of the actor's shapes on every object that they move."""
    read = heads.read_head(thing)
    for name in names:
        moves = shapes[name] - actor.face.mesh.vertices.astype(np.float32)
        for each, own, matrix in read.slices():
            if np.abs(moves[own]).max() > 1e-6:
                part("bridge.key_sets").write_keys(each, {name: moves[own] @ np.linalg.inv(matrix).T}, {})
    return thing


whole, apart = keyed(demo_object(actor, "whole"), WANTED), keyed(head(actor, "apart", True), WANTED)
ours, theirs = heads.read_head(whole), heads.read_head(apart)
assert theirs.key_names() == list(WANTED)
assert len(theirs.things) == 5
np.testing.assert_allclose(theirs.displacements(WANTED), ours.displacements(WANTED), atol=1e-6)
np.testing.assert_allclose(theirs.face.mesh.vertices, ours.face.mesh.vertices, atol=1e-5)
agree = np.einsum("vi,vi->v", theirs.face.mesh.vertex_normals, ours.face.mesh.vertex_normals)
assert agree.min() > 0.9, "a part is inside out"

# From head to head it makes no difference how many objects either has.
one, several = demo_object(warped, "one"), head(warped, "several", True)
several.facial_retarget.parts[2].role = "upper teeth"
task.source, task.target = whole, one
assert bpy.ops.facial_retarget.clone_shapes() == {"FINISHED"}
task.source, task.target = apart, several
assert bpy.ops.facial_retarget.clone_shapes() == {"FINISHED"}
expected, found = heads.read_head(one), heads.read_head(several)
size = expected.face.mesh.size
np.testing.assert_allclose(found.displacements(WANTED), expected.displacements(WANTED), atol=1e-5 * size)

# The face object has all keys, a part those that move it.
names = [
    [key.name for key in thing.data.shape_keys.key_blocks[1:]] if thing.data.shape_keys else []
    for thing in found.things
]
assert names[0] == list(WANTED)
assert sum("eyeLookUpLeft" in keys for keys in names[1:]) == 1, names
assert all("browInnerUp" not in keys for keys in names[1:]), names
assert sum(not keys for keys in names) == 3, names

# What never moves and has no role is named; the upper teeth stay because they are upper teeth.
steps = part("bridge.cloning.cloning").clone_steps(context)
said = [warning for warning in part("bridge.background").finished(steps).warnings if "role" in warning]
assert len(said) == 1, said
assert "'several part 3'" in said[0], said

# Played by its slider a part moves with the face.
eye = next(thing for thing, keys in zip(found.things[1:], names[1:], strict=True) if "eyeLookUpLeft" in keys)
eye.data.shape_keys.key_blocks["eyeLookUpLeft"].value = 1.0
context.view_layer.update()
np.testing.assert_allclose(shown(eye), key_shape(eye, "eyeLookUpLeft"), atol=1e-5)

# Parts get drivers and curves too.
keys = apart.data.shape_keys
keys.key_blocks["eyeLookUpLeft"].value = 1.0
keys.key_blocks["eyeLookUpLeft"].keyframe_insert("value", frame=3)
driver = keys.driver_add('key_blocks["jawOpen"].value').driver
variable = driver.variables.new()
variable.targets[0].id_type = "KEY"
variable.targets[0].id, variable.targets[0].data_path = keys, 'key_blocks["browInnerUp"].value'
driver.expression = "var"
cloning.existing = "REPLACE"
bpy.ops.facial_retarget.clone_shapes()
bag = part("bridge.curves").find_curves(eye.data.shape_keys)
assert [curve.data_path for curve in bag.fcurves] == ['key_blocks["eyeLookUpLeft"].value']
animations = [thing.data.shape_keys.animation_data for thing in (several, eye)]
assert animations[0].action == animations[1].action
assert animations[0].action_slot != animations[1].action_slot
moved = [thing for thing in found.things if thing.data.shape_keys and "jawOpen" in thing.data.shape_keys.key_blocks]
for thing in moved:
    (copied,) = thing.data.shape_keys.animation_data.drivers
    assert copied.driver.variables[0].targets[0].id == several.data.shape_keys, thing.name

# Many heads: every selected object with points, but neither the source nor parts.
others = [head(demo.warped_actor(np.random.default_rng(seed), 4_500), f"other {seed}", seed == 3) for seed in (2, 3)]
for thing in bpy.data.objects:
    thing.select_set(thing.name not in ("one", "several", "whole"))
cloning.targets, cloning.keep = "SELECTED", "jaw*, eyeBlink*"
part("bridge.points.points").add_point_at_vertex(others[1].facial_retarget.parts[2].thing, "9.8", 3)
assert "9.8" in heads.read_head(others[1]).face.points.names
assert bpy.ops.facial_retarget.clone_shapes() == {"FINISHED"}
for thing in others:
    assert [key.name for key in thing.data.shape_keys.key_blocks[1:]] == ["jawOpen", "eyeBlinkLeft"], thing.name
    assert np.abs(key_shape(thing, "jawOpen") - key_shape(thing, "Basis")).max() > 0.02 * size
assert [key.name for key in several.data.shape_keys.key_blocks[1:]] == list(WANTED)
assert '"other 2"' in bpy.data.texts["Cloned Shapes"].as_string()

# Objects are listed as parts with the roles that their names tell.
face = demo_object(actor, "face", True)
roles = {
    "Eye.L": "left eyeball",
    "RightEye": "right eyeball",
    "eyelashes_l": "lashes",
    "eyebrow": "brows",
    "Tongue": "tongue",
    "teeth_upper": "upper teeth",
    "Gums lower": "lower teeth",
    "body": "AUTO",
}
face.facial_retarget.parts.clear()
context.view_layer.objects.active = face
for thing in bpy.data.objects:
    thing.select_set(thing == face)
for name in roles:
    thing = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    context.scene.collection.objects.link(thing)
    thing.select_set(True)
bpy.ops.facial_retarget.add_parts()
bpy.ops.facial_retarget.add_parts()
assert {entry.thing.name: entry.role for entry in face.facial_retarget.parts} == roles
assert set(part("properties.parts").PART_ROLES) == set(part("core.parts.kinds").NAMED_KINDS)
face.facial_retarget.active_part = 2
bpy.ops.facial_retarget.remove_part()
assert "eyelashes_l" not in [entry.thing.name for entry in face.facial_retarget.parts]
