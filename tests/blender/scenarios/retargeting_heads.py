"""The performance of a head of several objects: read with what moves its objects, baked on every part that it moves."""

import sys
from math import cos, sin
from pathlib import Path

import bpy
import numpy as np
from mathutils import Euler, Matrix
from stage import demo_object, empty_scene, part, refused, snapshot

folder = Path(sys.argv[1])
empty_scene()
context = bpy.context
scene, task = context.scene, context.scene.facial_retarget
demo, heads, bake = part("demo"), part("bridge.heads"), part("bridge.bakes.frames")
actor, warped = demo.actor(4_500), demo.warped_actor(np.random.default_rng(1), 4_500)
FIRST, COUNT = 5, 4
performance = demo.performance(actor)[20 : 20 + 12 * COUNT : 12]
task.method, task.use_scene_range = "motion_cloning", False
task.frame_start, task.frame_end = FIRST, FIRST + COUNT - 1


def moved(face: bpy.types.Object, place: Matrix) -> bpy.types.Object:
    """The head somewhere else, each part turned in its own coordinates and standing where it stood."""
    context.view_layer.update()
    face.matrix_world = place
    for i, entry in enumerate(face.facial_retarget.parts):
        own = Matrix.LocRotScale((0.3 * i, 0.1, -0.2), Euler((0.1 * i, 0.4, 0)), (1.5, 1 + 0.2 * i, 0.7))
        entry.thing.data.transform(own.inverted())
        entry.thing.matrix_world = place @ own
    context.view_layer.update()
    return face


def read(face: bpy.types.Object) -> np.ndarray:
    """(COUNT, V, 3) how a head looks at each frame, in its own coordinates."""
    steps = part("bridge.performance").read_frames(context, face, range(FIRST, FIRST + COUNT))
    return part("bridge.background").finished(steps)


# One object, and several: the same performance, and the same result.
whole, one = demo_object(actor, "whole"), demo_object(warped, "one")
bake.write_frames(whole, performance, FIRST)
place = Matrix.LocRotScale((1, 2, 3), Euler((0.3, 0.2, 0.1)), (2, 2, 2))
apart, several = moved(demo_object(actor, "apart", True), place), moved(demo_object(warped, "several", True), place)
bake.write_head_frames(heads.read_head(apart), performance, range(FIRST, FIRST + len(performance)))
np.testing.assert_allclose(read(apart), performance, atol=1e-5)
task.source, task.target = whole, one
assert bpy.ops.facial_retarget.retarget() == {"FINISHED"}
task.source, task.target = apart, several
several.facial_retarget.parts[0].role = "left eyeball"
bpy.ops.ed.undo_push(message="before")
before = snapshot()
assert bpy.ops.facial_retarget.retarget() == {"FINISHED"}
bpy.ops.ed.undo_push(message="after")
bpy.ops.ed.undo()
assert snapshot() == before
bpy.ops.ed.redo()
scene, task = context.scene, context.scene.facial_retarget
whole, one, apart, several = (bpy.data.objects[name] for name in ("whole", "one", "apart", "several"))
size = np.ptp(performance[0], axis=0).max()
np.testing.assert_allclose(read(several), read(one), atol=1e-4 * size)
assert all(entry.thing.data.shape_keys is None for entry in several.facial_retarget.parts), "what is still was baked"

# An eye that turns as an object is part of the performance.
eye = apart.facial_retarget.parts[0].thing
bpy.data.objects.remove(apart.facial_retarget.parts[3].thing)
own = heads.read_head(apart)
frames, rest = read(apart), own.face.mesh.vertices
assert frames.shape[1] == own.starts[-1] < performance.shape[1]
row = own.things.index(eye)
ball = slice(own.starts[row], own.starts[row + 1])
centre = rest[ball].mean(axis=0)
pivot = Matrix.Translation(centre)
stands = eye.matrix_world.copy()
for i in range(COUNT):
    eye.matrix_world = place @ pivot @ Matrix.Rotation(0.2 * i, 4, "Y") @ pivot.inverted() @ place.inverted() @ stands
    for path in ("location", "rotation_euler", "scale"):
        eye.keyframe_insert(path, frame=FIRST + i)
scene.frame_set(FIRST)
turned = read(apart)
still = [part_of for part_of in range(len(rest)) if not ball.start <= part_of < ball.stop]
np.testing.assert_allclose(turned[:, still], frames[:, still], atol=1e-6)
for i in range(COUNT):
    c, s = cos(0.2 * i), sin(0.2 * i)
    expected = (frames[i, ball] - centre) @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]).T + centre
    np.testing.assert_allclose(turned[i, ball], expected, atol=2e-5 * size)
bpy.ops.facial_retarget.retarget()
target_eye = several.facial_retarget.parts[0].thing
moves = np.ptp(read(several), axis=0)
found = heads.read_head(several)
row = found.things.index(target_eye)
assert moves[found.starts[row] : found.starts[row + 1]].max() > 0.05 * size, "the eye of the target does not turn"

animations = [thing.data.shape_keys.animation_data for thing in (several, target_eye)]
assert animations[0].action == animations[1].action
assert animations[0].action_slot != animations[1].action_slot
names = target_eye.data.shape_keys.key_blocks.keys()
assert names == several.data.shape_keys.key_blocks.keys()

# The job has all objects of both heads, and gives the same without Blender.
bpy.ops.facial_retarget.save_job(filepath=str(folder / "heads.toml"))
job = part("files.job").read_job(folder / "heads.toml")
assert job.target.parts is not None
part("files.run").run_job(folder / "heads.toml")
frames = np.load(folder / "heads_target_frames.npz")["frames"]
np.testing.assert_allclose(read(several), frames, atol=2e-4 * size)

# A mesh that two parts of the target share cannot be baked; the source's parts may share theirs.
eyes = [entry.thing for entry in several.facial_retarget.parts][:2]
for thing in [eyes[0], target_eye]:
    thing.shape_key_clear()
kept, eyes[1].data = eyes[1].data, eyes[0].data
with refused("mesh", f"'{eyes[0].name}'", f"'{eyes[1].name}'"):
    bpy.ops.facial_retarget.retarget()
eyes[1].data = kept

# A hidden part is not evaluated.
eye.hide_set(True)
with refused(f"'{eye.name}'", "hidden"):
    bpy.ops.facial_retarget.retarget()

# Loaded again a head is one object, whose vertex groups name the parts.
named = {name: np.sort(held) for name, held in found.face.named_parts.items()}
bpy.ops.facial_retarget.load_job(filepath=str(folder / "heads.toml"))
loaded = heads.read_head(context.scene.facial_retarget.target)
assert len(loaded.things) == 1
assert loaded.face.named_parts.keys() == named.keys() == {"left eyeball"}
labels = loaded.face.mesh.components
assert set(labels[loaded.face.named_parts["left eyeball"]]) == set(labels[named["left eyeball"]])
