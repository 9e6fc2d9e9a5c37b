"""Sculpt enters Sculpt Mode on one shape key of one object; Done gives back what was before. The list shows states."""

import bpy
import numpy as np
from stage import empty_scene, grid, part, refused

empty_scene()
examples = part("bridge.examples.examples")
task = bpy.context.scene.facial_retarget
task.source, task.target = grid("source"), grid("target", 8)
other = grid("other", 4)
objects = bpy.context.view_layer.objects
objects.active = other
sculpt, done = bpy.ops.facial_retarget.sculpt_example, bpy.ops.facial_retarget.stop_sculpting
assert not done.poll()
bpy.ops.facial_retarget.create_examples()
squint = task.target.shape_key_add(name="squint")
squint.value = 0.5
task.target.active_shape_key_index = task.target.data.shape_keys.key_blocks.find("squint")


def state(name: str) -> tuple[str, str, str]:
    """What the list shows of an example."""
    bpy.context.view_layer.update()
    example = task.examples[name]
    return example.source_state, example.target_state, example.warning


def move(thing: bpy.types.Object, name: str, height: float, vertex: int = 0) -> None:
    """Sculpt a vertex of a shape key, as a brush does."""
    thing.data.shape_keys.key_blocks[name].points[vertex].co.z += height
    thing.data.update()


def held() -> dict[str, list[np.ndarray]]:
    """What all shape keys hold."""
    found = {}
    for thing in (task.source, task.target):
        for key in thing.data.shape_keys.key_blocks:
            flat = np.empty(3 * len(key.points), np.float32)
            key.points.foreach_get("co", flat)
            found[f"{thing.name} {key.name}"] = flat.tolist()
    return found


def setting() -> dict[str, object]:
    """What Sculpt changes and Done must give back."""
    return {
        "mode": bpy.context.mode,
        "active": objects.active,
        "selected": sorted(thing.name for thing in bpy.context.selected_objects),
        "things": [
            (thing.mode, thing.show_only_shape_key, thing.active_shape_key_index, thing.hide_get())
            for thing in bpy.context.view_layer.objects
        ],
        "values": [key.value for key in task.target.data.shape_keys.key_blocks],
    }


assert state("joy") == ("EMPTY", "EMPTY", "")
before, shapes = setting(), held()
assert sculpt(example="joy", side="TARGET") == {"FINISHED"}
assert bpy.context.mode == "SCULPT"
assert objects.active == task.target
assert task.target.active_shape_key.name == "joy"
assert task.target.show_only_shape_key
assert held() == shapes
# Another one, straight from the first; other operators wait.
assert not bpy.ops.facial_retarget.retarget.poll()
sculpt(example="fear", side="SOURCE")
assert objects.active == task.source
assert task.source.active_shape_key.name == "fear"
assert not task.target.show_only_shape_key
assert task.target.mode == "OBJECT"
done()
assert setting() == before, (setting(), before)
assert held() == shapes
assert not done.poll()

# Who leaves Sculpt Mode themselves gets the rest back with Done; what is gone since is left alone.
sculpt(example="joy")
bpy.ops.object.mode_set(mode="OBJECT")
done()
assert setting() == before
sculpt(example="joy", side="SOURCE")
gone = task.source
bpy.data.objects.remove(gone)
assert not done.poll()
task.source = grid("source")
objects.active = other
bpy.ops.facial_retarget.create_examples()

# Sculpt Mode of the artist's own is left to the artist.
objects.active = other
bpy.ops.object.mode_set(mode="SCULPT")
assert not sculpt.poll()
bpy.ops.object.mode_set(mode="OBJECT")

# A part of the head is sculpted if it is active.
piece = grid("piece", 3)
task.target.facial_retarget.parts.add().thing = piece
objects.active = piece
sculpt(example="joy", side="TARGET")
assert objects.active == piece
assert piece.active_shape_key.name == "joy"
done()
assert objects.active == piece
move(piece, "joy", 0.1)
assert state("joy")[1] == "SCULPTED"
task.target.facial_retarget.parts.clear()

# What cannot be sculpted is refused, and nothing has changed.
task.target.hide_set(True)
with refused("'target'", "hidden"):
    sculpt(example="joy")
task.target.hide_set(False)
task.target.data.shape_keys.key_blocks["joy"].lock_shape = True
with refused("'joy'", "locked"):
    sculpt(example="joy")
task.target.data.shape_keys.key_blocks["joy"].lock_shape = False
with refused("'wink'", "list"):
    sculpt(example="wink")

# The states follow the shape keys.
bpy.ops.facial_retarget.create_examples()
move(task.target, "joy", 0.1)
assert state("joy")[:2] == ("EMPTY", "SCULPTED")
assert "source" in state("joy")[2]
move(task.source, "joy", 0.2)
assert state("joy") == ("SCULPTED", "SCULPTED", "")
move(task.source, "anger", 0.2)
move(task.target, "anger", 0.2)
assert "same as joy on source" in state("anger")[2]
assert "same as anger on source" in state("joy")[2]
move(task.source, "anger", 0.1, vertex=3)
assert state("anger") == state("joy") == ("SCULPTED", "SCULPTED", "")
task.target.shape_key_remove(task.target.data.shape_keys.key_blocks["fear"])
assert state("fear")[:2] == ("EMPTY", "MISSING")
assert "No shape key fear on target" in state("fear")[2]
task.source = None
assert state("joy") == ("MISSING", "MISSING", "")
