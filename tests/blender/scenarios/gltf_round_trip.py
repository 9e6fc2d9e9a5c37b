"""Cloned shape keys through glTF and back: names, counts, shapes, values, and what moves them."""

import sys
from pathlib import Path

import bpy
import numpy as np
from scipy.spatial import cKDTree
from stage import demo_object, empty_scene, key_shape, part

path = str(Path(sys.argv[1]) / "head.glb")
FIRST, LAST = 1, 20


def fresh_scene() -> None:
    """An empty scene in which glTF can be read and written."""
    import addon_utils  # exists once bpy is imported

    empty_scene()
    addon_utils.enable("io_scene_gltf2")
    bpy.context.scene.render.fps = 24


fresh_scene()
context = bpy.context
task = context.scene.facial_retarget
demo = part("demo")

# A source that acts: a key with a curve, one that follows it by a driver, one with a value and a range of its own.
actor = demo.actor(4_500)
task.source = demo_object(actor, "source")
shapes = part("demo.shape_sets").face_shapes(actor, ("arkit", "visemes", "expressions"))
moves = {name: positions - actor.face.mesh.vertices.astype(np.float32) for name, positions in shapes.items()}
part("bridge.key_sets").write_keys(task.source, moves, {})
keys = task.source.data.shape_keys
for frame, value in ((FIRST, 0.0), (10, 0.8), (LAST, 0.1)):
    keys.key_blocks["jawOpen"].value = value
    keys.key_blocks["jawOpen"].keyframe_insert("value", frame=frame)
    keys.key_blocks["eyeLookUpLeft"].value = 1 - value
    keys.key_blocks["eyeLookUpLeft"].keyframe_insert("value", frame=frame)
driver = keys.driver_add('key_blocks["viseme_aa"].value').driver
variable = driver.variables.new()
variable.targets[0].id_type = "KEY"
variable.targets[0].id, variable.targets[0].data_path = keys, 'key_blocks["jawOpen"].value'
driver.expression = "0.5 * var"
keys.key_blocks["browInnerUp"].slider_max, keys.key_blocks["browInnerUp"].value = 2.0, 1.5

# Onto a head of several objects.
task.target = demo_object(demo.warped_actor(np.random.default_rng(1), 4_500), "target", pieces=True)
assert bpy.ops.facial_retarget.clone_shapes() == {"FINISHED"}
things = [thing for thing in part("bridge.heads").read_head(task.target).things if thing.data.shape_keys is not None]
assert [len(thing.data.shape_keys.key_blocks) for thing in things] == [1 + len(shapes), 5, 5], things


def held(thing: bpy.types.Object) -> dict[str, np.ndarray]:
    """(V, 3) positions of each shape key."""
    return {key.name: key_shape(thing, key.name) for key in thing.data.shape_keys.key_blocks}


def played(thing: bpy.types.Object) -> np.ndarray:
    """(F, K) values of the shape keys at each frame."""
    rows = []
    for frame in range(FIRST, LAST + 1):
        bpy.context.scene.frame_set(frame)
        rows.append([key.value for key in thing.data.shape_keys.key_blocks[1:]])
    return np.array(rows)


before = {thing.name: (held(thing), played(thing)) for thing in things}
context.scene.frame_start, context.scene.frame_end = FIRST, LAST
context.scene.frame_set(FIRST)
assert bpy.ops.facial_retarget.export_gltf(filepath=path) == {"FINISHED"}

fresh_scene()
assert bpy.ops.import_scene.gltf(filepath=path) == {"FINISHED"}
assert len(bpy.data.actions) == 1, "the head's objects do not move in one animation"
for name, (shaped, values) in before.items():
    thing = bpy.data.objects[name]
    again, size = held(thing), np.ptp(shaped["Basis"], axis=0).max()
    assert list(again) == list(shaped), name
    # glTF may order and double vertices.
    far, row = cKDTree(shaped["Basis"]).query(again["Basis"])
    assert far.max() < 1e-6 * size, name
    assert set(row.tolist()) == set(range(len(shaped["Basis"]))), name
    for key, positions in shaped.items():
        np.testing.assert_allclose(again[key], positions[row], atol=2e-6 * size, err_msg=f"{name}: {key}")
    np.testing.assert_allclose(played(thing), values, atol=2e-3, err_msg=name)
assert before["target"][1].max() == 1.5
assert np.ptp(before["target"][1][:, list(shapes).index("viseme_aa")]) > 0.3
