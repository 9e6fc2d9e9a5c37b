"""Re-solve: corrected keys stay as they are and teach the others; marks, changes found, halves, several objects."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import demo_object, donor_pair, empty_scene, key_shape, part, refused, snapshot

empty_scene()
context = bpy.context
operators = bpy.ops.facial_retarget
task = context.scene.facial_retarget
cloning = task.cloning
task.source, task.target = donor_pair()
source, target = task.source, task.target
write = part("bridge.shape_keys").write_key
made = lambda: target.data.shape_keys.key_blocks  # noqa: E731

with refused("'target'", "no cloned shape keys"):
    operators.resolve_shapes()
operators.clone_shapes()
NAMES = [key.name for key in made()][1:]
with refused("none of the 6", "'target'"):
    operators.resolve_shapes()


def kept() -> dict[str, np.ndarray]:
    """Every key's positions."""
    return {name: key_shape(target, name) for name in NAMES}


# The artist makes joy stronger at the mouth: that is seen without a mark, and the others learn from it.
first = kept()
basis = key_shape(target, "Basis")
sculpted = basis + 1.6 * (first["joy"] - basis)
write(made()["joy"], sculpted)
made()["joy"].value, made()["joy"].slider_max = 0.4, 2.0
operators.find_corrected()
assert [entry.name for entry in target.facial_retarget.cloned if entry.corrected] == ["joy"]
bpy.ops.ed.undo_push(message="before")
before = snapshot()
assert operators.resolve_shapes() == {"FINISHED"}
bpy.ops.ed.undo_push(message="after")
bpy.ops.ed.undo()
target, task = bpy.data.objects["target"], bpy.context.scene.facial_retarget
assert snapshot() == before
assert np.array_equal(key_shape(target, "sadness"), first["sadness"])
bpy.ops.ed.redo()
source, target, task = bpy.data.objects["source"], bpy.data.objects["target"], context.scene.facial_retarget
cloning = task.cloning
second = kept()
assert np.array_equal(second["joy"], sculpted.astype(np.float32)), "the corrected key was touched"
assert made()["joy"].value == np.float32(0.4)
assert made()["joy"].slider_max == 2
changed = {name: np.abs(second[name] - first[name]).max() for name in NAMES}
assert max(changed.values()) > 1e-3, changed
assert sorted(entry.name for entry in target.facial_retarget.cloned) == sorted(NAMES)
assert [entry.name for entry in target.facial_retarget.cloned if entry.corrected] == ["joy"]

# It is what core makes of it.
heads, resolve = part("bridge.heads"), part("core.shapes.resolve")
ours, theirs = heads.read_head(source), heads.read_head(target)
shape_set = part("core.shapes.shape_set").ShapeSet
problem = part("core.problem").Problem(ours.face, theirs.face)
settings = part("core.methods.settings").MotionCloningSettings()
corrected = shape_set(("joy",), (sculpted - basis)[None])
wanted = resolve.resolve_shapes(
    "motion_cloning", problem, settings, shape_set(tuple(NAMES), ours.displacements(NAMES)), corrected
)
for name in NAMES:
    np.testing.assert_allclose(second[name] - basis, wanted.shapes[name], atol=2e-6, err_msg=name)

# Solving again without another correction changes nothing; a mark alone makes a key stay.
operators.resolve_shapes()
assert all(np.array_equal(one, other) for one, other in zip(second.values(), kept().values(), strict=True))
target.facial_retarget.cloned["fear"].corrected = True
write(made()["anger"], basis + 0.5 * (second["anger"] - basis))
operators.resolve_shapes()
third = kept()
assert np.array_equal(third["fear"], second["fear"])
assert np.array_equal(third["anger"], (basis + 0.5 * (second["anger"] - basis)).astype(np.float32))
assert sorted(entry.name for entry in target.facial_retarget.cloned if entry.corrected) == ["anger", "fear", "joy"]

# All this is kept in the file, and nothing looks changed after loading it.
bpy.ops.wm.save_as_mainfile(filepath=str(Path(sys.argv[1]) / "corrected.blend"))
bpy.ops.wm.open_mainfile(filepath=str(Path(sys.argv[1]) / "corrected.blend"))
context, task = bpy.context, bpy.context.scene.facial_retarget
source, target, cloning = task.source, task.target, task.cloning
operators.find_corrected()
assert sorted(entry.name for entry in target.facial_retarget.cloned if entry.corrected) == ["anger", "fear", "joy"]

# Cloning anew forgets the corrections.
cloning.existing = "REPLACE"
operators.clone_shapes()
np.testing.assert_allclose(key_shape(target, "joy"), first["joy"], atol=2e-6)
assert not any(entry.corrected for entry in target.facial_retarget.cloned)
for entry in target.facial_retarget.cloned:
    entry.corrected = True
with refused("all 6", "'target'"):
    operators.resolve_shapes()

# A key of the target that is relative to a solved one goes on moving what it moved.
for entry in target.facial_retarget.cloned:
    entry.corrected = entry.name == "joy"
write(made()["joy"], sculpted)
own = part("bridge.shape_keys").ensure_key(target, "own")
own.relative_key = made()["sadness"]
write(own, key_shape(target, "sadness") + np.float32(0.05))
operators.resolve_shapes()
assert not np.array_equal(key_shape(target, "sadness"), first["sadness"])
np.testing.assert_allclose(key_shape(target, "own") - key_shape(target, "sadness"), 0.05, atol=1e-6)

# Halves, and keys that were numbered, know where they come from.
target.shape_key_clear()
cloning.sides, cloning.existing = "SPLIT", "SUFFIX"
operators.clone_shapes()
operators.clone_shapes()
halves = key_shape(target, "joy_L.001")
write(made()["joy_L"], basis + 1.3 * (key_shape(target, "joy_L") - basis))
for name in ("sadness_L", "sadness_R"):
    write(made()[name], basis)
for entry in [entry.name for entry in target.facial_retarget.cloned if entry.name.endswith(".001")][:-2]:
    target.shape_key_remove(made()[entry])
left = len(made()) - 1
assert operators.resolve_shapes() == {"FINISHED"}
assert len(made()) - 1 == left
assert np.array_equal(key_shape(target, "sadness_L"), basis)
sides = np.abs(key_shape(target, "fear_R") - basis)
assert sides[basis[:, 0] > 0.5].max() < 0.05 * sides.max(), "the right half moves the left side"

# The source has lost what a key came from.
source.shape_key_remove(source.data.shape_keys.key_blocks["fear"])
with refused("'target'", "fear"):
    operators.resolve_shapes()

# On a head of several objects a corrected eye teaches, and nothing of it is touched.
empty_scene()
task = bpy.context.scene.facial_retarget
demo = part("demo")
face = demo.warped_actor(np.random.default_rng(1), 4_500)
target = demo_object(face, "target", pieces=True)
task.target, task.cloning.donor = target, "ACTOR"
task.cloning.keep = "eyeLook*Left, jawOpen, mouthClose, mouthSmile*"
operators.clone_shapes()
eye = next(entry.thing for entry in target.facial_retarget.parts if entry.thing.data.shape_keys)
key = eye.data.shape_keys.key_blocks["eyeLookUpLeft"]
write(key, key_shape(eye, "Basis") + 1.2 * (key_shape(eye, "eyeLookUpLeft") - key_shape(eye, "Basis")))
write(
    made()["mouthClose"],
    key_shape(target, "Basis") + 0.9 * (key_shape(target, "mouthClose") - key_shape(target, "Basis")),
)
theirs = key_shape(eye, "eyeLookUpLeft"), key_shape(target, "eyeLookUpLeft"), key_shape(target, "mouthClose")
assert operators.resolve_shapes() == {"FINISHED"}
assert np.array_equal(key_shape(eye, "eyeLookUpLeft"), theirs[0])
assert np.array_equal(key_shape(target, "eyeLookUpLeft"), theirs[1])
assert np.array_equal(key_shape(target, "mouthClose"), theirs[2])
