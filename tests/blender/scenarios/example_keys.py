"""The seven example shape keys: made, listed, read, and refused where one side is missing."""

import bpy
import numpy as np
from stage import empty_scene, grid, part, refused

empty_scene()
examples = part("bridge.examples")
task = bpy.context.scene.facial_retarget
assert not bpy.ops.facial_retarget.create_examples.poll()
task.source, task.target = grid("source"), grid("target", 8)

bpy.ops.facial_retarget.create_examples()
bpy.ops.facial_retarget.create_examples()  # a second time changes nothing
for thing in (task.source, task.target):
    keys = thing.data.shape_keys.key_blocks
    assert [key.name for key in keys] == ["Basis", *examples.EXPRESSIONS], list(keys)
    assert all(key.value == 0 for key in keys[1:])
assert [example.name for example in task.examples] == list(examples.EXPRESSIONS)

# What nobody has sculpted yet is left out.
assert examples.read_examples(task) == ({}, {})


def sculpt(thing: bpy.types.Object, name: str, size: float) -> np.ndarray:
    """Move every vertex of a shape key; returns the displacement."""
    displacement = np.random.default_rng(len(name)).normal(size=(len(thing.data.vertices), 3)).astype(np.float32) * size
    basis = part("bridge.meshes").read_positions(thing.data)
    examples.write_example(thing, name, basis + displacement)
    return (basis + displacement).astype(np.float64) - basis


on_source, on_target = sculpt(task.source, "joy", 0.1), sculpt(task.target, "joy", 0.2)
source, target = examples.read_examples(task)
assert list(source) == list(target) == ["joy"]
assert np.array_equal(source["joy"], on_source)
assert np.array_equal(target["joy"], on_target)

# A key that is relative to another one counts by what it moves.
keys = task.source.data.shape_keys.key_blocks
keys["joy"].relative_key = keys["anger"]
assert np.array_equal(examples.read_examples(task)[0]["joy"], on_source)
keys["joy"].relative_key = keys["Basis"]

# Any other shape key can be an example.
for thing in (task.source, task.target):
    examples.write_example(thing, "squint", part("bridge.meshes").read_positions(thing.data) * 1.1)
bpy.ops.facial_retarget.add_example(name="squint")
assert set(examples.read_examples(task)[0]) == {"joy", "squint"}
with refused("'squint'", "already"):
    bpy.ops.facial_retarget.add_example(name="squint")
task.active_example = len(task.examples) - 1
bpy.ops.facial_retarget.remove_example()
assert set(examples.read_examples(task)[0]) == {"joy"}

# One side only.
sculpt(task.source, "fear", 0.1)
with refused("'fear'", "'target'"):
    examples.read_examples(task)
task.target.shape_key_remove(task.target.data.shape_keys.key_blocks["fear"])
with refused("'fear'", "'target'", "no shape key"):
    examples.read_examples(task)
