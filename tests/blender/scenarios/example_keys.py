"""The seven example shape keys: made, listed, read, and refused where one side is missing."""

import bpy
import numpy as np
from stage import empty_scene, grid, part, refused

empty_scene()
examples = part("bridge.examples.examples")
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


def read() -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """The task's examples."""
    heads = (part("bridge.heads").read_head(thing) for thing in (task.source, task.target))
    return examples.read_examples(task, *heads)


# What nobody has sculpted yet is left out.
assert read() == ({}, {})


def sculpt(thing: bpy.types.Object, name: str, size: float) -> np.ndarray:
    """Move every vertex of a shape key; returns the displacement."""
    displacement = np.random.default_rng(len(name)).normal(size=(len(thing.data.vertices), 3)).astype(np.float32) * size
    basis = part("bridge.meshes").read_positions(thing.data)
    examples.write_example(thing, name, basis + displacement)
    return (basis + displacement).astype(np.float64) - basis


on_source, on_target = sculpt(task.source, "joy", 0.1), sculpt(task.target, "joy", 0.2)
source, target = read()
assert list(source) == list(target) == ["joy"]
assert np.array_equal(source["joy"], on_source)
assert np.array_equal(target["joy"], on_target)

# A key that is relative to another one counts by what it moves.
keys = task.source.data.shape_keys.key_blocks
keys["joy"].relative_key = keys["anger"]
assert np.array_equal(read()[0]["joy"], on_source)
keys["joy"].relative_key = keys["Basis"]

# Any other shape key can be an example.
for thing in (task.source, task.target):
    examples.write_example(thing, "squint", part("bridge.meshes").read_positions(thing.data) * 1.1)
bpy.ops.facial_retarget.add_example(name="squint")
assert set(read()[0]) == {"joy", "squint"}
with refused("'squint'", "already"):
    bpy.ops.facial_retarget.add_example(name="squint")
task.active_example = len(task.examples) - 1
bpy.ops.facial_retarget.remove_example()
assert set(read()[0]) == {"joy"}

# One side only.
sculpt(task.source, "fear", 0.1)
with refused("'fear'", "'target'"):
    read()
task.target.shape_key_remove(task.target.data.shape_keys.key_blocks["fear"])
with refused("'fear'", "'target'", "no shape key"):
    read()
