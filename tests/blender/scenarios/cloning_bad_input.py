"""Whatever is wrong with a cloning: one clear sentence, and the scene as it was; Esc leaves it so too."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import donor_pair, empty_scene, grid, key_shape, part, refused, snapshot

empty_scene()
context = bpy.context
operators = bpy.ops.facial_retarget
clone = operators.clone_shapes
task = context.scene.facial_retarget
cloning = task.cloning

# Nothing to work on: the buttons are grey.
assert not clone.poll()
cloning.donor = "ACTOR"
assert not clone.poll()
cloning.targets = "SELECTED"
assert not clone.poll()
task.source, task.target = donor_pair()
source, target = task.source, task.target
cloning.donor, cloning.targets = "SOURCE", "TARGET"
assert clone.poll()
context.view_layer.objects.active = target
bpy.ops.object.mode_set(mode="EDIT")
assert not clone.poll()
assert not operators.add_actor.poll()
bpy.ops.object.mode_set(mode="OBJECT")

# Esc at every stage leaves the scene as it was.
before = snapshot()
for stop in (lambda share, what: True, lambda share, what: share > 0.3, lambda share, what: what == "Writing"):
    steps = part("bridge.cloning.cloning").clone_steps(context)
    share, what = next((share, what) for share, what in steps if stop(share, what))
    steps.close()
    assert snapshot() == before, f"stopping at {share:.0%}, {what!r}, has changed the scene"

# The faces.
task.target = source
with refused("both", "'source'"):
    clone()
task.target = target
task.source = grid("plain")
with refused("'plain'", "no shape keys"):
    clone()
part("bridge.shape_keys").ensure_basis(task.source)
with refused("'plain'", "no shape keys"):
    clone()
task.source = source
task.target = grid("bare", 9)
with refused("feature points in common"):
    clone()
task.target = target
cloning.targets = "SELECTED"
for thing in bpy.data.objects:
    thing.select_set(thing.name in ("source", "bare"))
with refused("none of the 1", "feature points"):
    clone()
bpy.data.objects["bare"].select_set(False)
for name in ("2.1", "8.3", "8.4"):
    part("bridge.points.points").add_point_at_vertex(bpy.data.objects["bare"], name, 4)
bpy.data.objects["bare"].select_set(True)
target.select_set(True)
with refused("bare: ", "points"):
    clone()
cloning.targets = "TARGET"

# Which keys.
cloning.keep = "nobody*"
with refused("'nobody*'", "joy"):
    clone()
cloning.keep, cloning.drop = "*", "*"
with refused("no shape is left of 6"):
    clone()
cloning.keep, cloning.drop = "*", ""
key = source.data.shape_keys.key_blocks["fear"]
fine = key_shape(source, "fear")
key.points[7].co.z = float("nan")
with refused("'fear'", "'source'", "NaN"):
    clone()
part("bridge.shape_keys").write_key(key, fine)
source.data.shape_keys.use_relative = False
with refused("'source'", "absolute"):
    clone()
source.data.shape_keys.use_relative = True
part("bridge.shape_keys").ensure_basis(target).name = "joy"
with refused("Basis", "'target'", "'joy'"):
    clone()
target.shape_key_clear()

# Objects.
twin = bpy.data.objects.new("twin", target.data)
context.scene.collection.objects.link(twin)
part("bridge.points.points").write_points(twin, part("bridge.points.points").read_points(target))
for thing in bpy.data.objects:
    thing.select_set(thing in (target, twin))
cloning.targets = "SELECTED"
with refused("'target'", "'twin'", "mesh"):
    clone()
cloning.targets = "TARGET"
for thing in (target, twin, twin):
    target.facial_retarget.parts.add().thing = thing
with refused("'target'", "own head"):
    clone()
target.facial_retarget.parts.remove(0)
with refused("'twin'", "twice"):
    clone()
target.facial_retarget.parts.remove(0)
with refused("'target'", "'twin'", "mesh"):
    clone()
target.facial_retarget.parts.clear()
flat = grid("flat")
flat.scale = (1, 1, 0)
context.view_layer.update()
target.facial_retarget.parts.add().thing = flat
with refused("'flat'", "scaled to nothing"):
    clone()
flat.scale = (1, 1, 1)
context.view_layer.update()
target.facial_retarget.parts[0].role = "left eyeball"
loose = bpy.data.objects.new("loose", bpy.data.meshes.new("loose"))
context.scene.collection.objects.link(loose)
target.facial_retarget.parts.add().thing = loose
with refused("'loose'", "surface"):
    clone()
bpy.data.objects.remove(loose)
assert clone() == {"FINISHED"}, "an object that was deleted is no part any more"
target.shape_key_clear()
target.facial_retarget.parts.clear()

# The actor.
cloning.donor, cloning.actor_sets = "ACTOR", set()
with refused("built-in actor", "ARKit"):
    clone()
with refused("built-in actor", "ARKit"):
    operators.add_actor(sets=set())

# A target from another file.
cloning.donor = "SOURCE"
library = Path(sys.argv[1]) / "library.blend"
bpy.data.libraries.write(str(library), {target})
with bpy.data.libraries.load(str(library), link=True) as (_, wanted):
    wanted.objects = ["target"]
(linked,) = wanted.objects
context.scene.collection.objects.link(linked)
task.target = linked
with refused("'target'", "linked"):
    clone()
assert np.isfinite(key_shape(source, "fear")).all()
