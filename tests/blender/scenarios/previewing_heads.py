"""The live preview on heads of several objects, with bones, modifiers, Edit Mode, renders: it shows what is baked."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import demo_object, empty_scene, part, shown

folder = Path(sys.argv[1])
empty_scene()
context = bpy.context
scene, task = context.scene, context.scene.facial_retarget
demo, heads, bake = part("demo"), part("bridge.heads"), part("bridge.bakes.frames")
state = part("preview_state").STATE
actor, warped = demo.actor(4_500), demo.warped_actor(np.random.default_rng(1), 4_500)
FIRST, COUNT = 5, 4
performance = demo.performance(actor)[20 : 20 + 12 * COUNT : 12]
task.method, task.use_scene_range = "motion_cloning", False
task.frame_start, task.frame_end = FIRST, FIRST + COUNT - 1
task.source, task.target = demo_object(actor, "source", True), demo_object(warped, "target", True)
source, target = task.source, task.target
target.location, target.rotation_euler, target.scale = (1, 2, 3), (0.3, 0.2, 0.1), (2, 2, 2)
for entry in target.facial_retarget.parts:
    entry.thing.parent = target
bake.write_head_frames(heads.read_head(source), performance, range(FIRST, FIRST + COUNT))
eye = next(entry.thing for entry in source.facial_retarget.parts if len(entry.thing.data.vertices) > 1_000)
for i in range(COUNT):
    eye.rotation_euler.y = 0.02 * i
    eye.keyframe_insert("rotation_euler", frame=FIRST + i)
context.view_layer.update()
things = (target, *(entry.thing for entry in target.facial_retarget.parts))
size = np.ptp(performance[0], axis=0).max()


def seen() -> list[np.ndarray]:
    """How each object of the target looks at each frame."""
    found = []
    for frame in range(FIRST, FIRST + COUNT):
        scene.frame_set(frame)
        found.append([shown(thing) for thing in things])
    return [np.stack(positions) for positions in zip(*found, strict=True)]


def same(one: list[np.ndarray], other: list[np.ndarray]) -> None:
    """Both are alike on all objects."""
    for ours, theirs in zip(one, other, strict=True):
        np.testing.assert_allclose(ours, theirs, atol=1e-5 * size)


# All objects of the head follow; a modifier behind subdivides what they do.
for thing in things:
    thing.modifiers.new("finer", "SUBSURF").levels = 1
rest = seen()
assert bpy.ops.facial_retarget.start_preview() == {"FINISHED"}
live = seen()
moves = [np.abs(a - b).max() / size for a, b in zip(live, rest, strict=True)]
assert moves[0] > 0.01
assert max(moves[1:]) > 0.005, moves
assert bpy.ops.facial_retarget.stop_preview() == {"FINISHED"}
assert all(thing.data.shape_keys is None for thing in things)
same(seen(), rest)
# A bake takes the preview's place.
assert bpy.ops.facial_retarget.start_preview() == {"FINISHED"}
assert bpy.ops.facial_retarget.retarget() == {"FINISHED"}
assert not state.on
assert "facial_retarget_preview" not in target.data.shape_keys.key_blocks
same(seen(), live)
assert len(live[0][0]) > len(target.data.vertices)

# On top of the bake it shows the same, not twice as much.
bpy.ops.facial_retarget.start_preview()
same(seen(), live)
for thing in things:
    thing.modifiers.clear()
plain = seen()

# A cache that plays over it is named.
cache = target.modifiers.new("cache", "MESH_CACHE")
scene.frame_set(FIRST)
assert "cache" in state.trouble
target.modifiers.remove(cache)

# Bones that pose the source.
bones = bpy.data.armatures.new("bones")
rig = bpy.data.objects.new("rig", bones)
scene.collection.objects.link(rig)
context.view_layer.objects.active = rig
bpy.ops.object.mode_set(mode="EDIT")
bone = bones.edit_bones.new("jaw")
bone.head, bone.tail = (0, 0, 0), (0, 0, 0.5 * size)
bpy.ops.object.mode_set(mode="OBJECT")
places = part("bridge.meshes").read_positions(source.data)
low = np.flatnonzero(places[:, 1] < np.quantile(places[:, 1], 0.25)).tolist()
source.vertex_groups.new(name="jaw").add(low, 1.0, "REPLACE")
source.modifiers.new("rig", "ARMATURE").object = rig
scene.frame_set(FIRST)
before = shown(target)
rig.pose.bones["jaw"].location = (0, 0.05 * size, 0)
context.view_layer.update()
assert np.abs(shown(target) - before).max() > 0.01 * size
rig.pose.bones["jaw"].location = (0, 0, 0)
context.view_layer.update()
np.testing.assert_allclose(shown(target), before, atol=1e-5 * size)

# A hidden source is not evaluated: the panel says so, and goes on once it is back.
source.hide_set(True)
scene.frame_set(FIRST + 1)
assert "hidden" in state.trouble
source.hide_set(False)
scene.frame_set(FIRST + 2)
assert not state.trouble
np.testing.assert_allclose(shown(target), plain[0][2], atol=1e-5 * size)

# In Edit Mode the target rests as it was; afterwards it follows again. Other vertices are another target.
context.view_layer.objects.active = target
bpy.ops.object.mode_set(mode="EDIT")
scene.frame_set(FIRST)
assert state.on
assert not bpy.ops.facial_retarget.stop_preview.poll()
bpy.ops.object.mode_set(mode="OBJECT")
scene.frame_set(FIRST + 1)
np.testing.assert_allclose(shown(target), plain[0][1], atol=1e-5 * size)
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.select_all(action="DESELECT")
bpy.ops.object.mode_set(mode="OBJECT")
target.data.vertices[0].select = True
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.delete(type="VERT")
bpy.ops.object.mode_set(mode="OBJECT")
scene.frame_set(FIRST + 2)
assert "vertices" in state.trouble
part("bridge.preview.preview").check_origin()
assert "meshes" in state.stale
bpy.ops.facial_retarget.stop_preview()
assert len(target.data.shape_keys.key_blocks) == COUNT + 1

# A render shows the frame that it is of.
empty_scene()
context, scene, task = bpy.context, bpy.context.scene, bpy.context.scene.facial_retarget
task.source, task.target = demo_object(actor, "source"), demo_object(warped, "target")
task.method = "feature_points"
bake.write_frames(task.source, performance, FIRST)
task.source.location.x = 100 * size
target, high = task.target, task.target.dimensions
scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(scene.camera)
scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 0.6 * max(high)
scene.camera.location = (0, -0.1 * high.y, 2 * max(high))
scene.camera.data.clip_end = 10 * max(high)
scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 4, False
scene.render.resolution_x = scene.render.resolution_y = 48
scene.render.image_settings.file_format = "PNG"
sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.rotation_euler = (0.5, 0.5, 0)
scene.collection.objects.link(sun)


def rendered(frame: int) -> np.ndarray:
    """The pixels of a frame that is rendered as part of an animation."""
    scene.frame_start = scene.frame_end = frame
    scene.render.filepath = str(folder / "frame_")
    bpy.ops.render.render(animation=True)
    image = bpy.data.images.load(str(folder / f"frame_{frame:04d}.png"))
    pixels = np.array(image.pixels[:])
    bpy.data.images.remove(image)
    return pixels


still = rendered(FIRST + 2)
bpy.ops.facial_retarget.start_preview()
scene.frame_set(FIRST)
moving = rendered(FIRST + 2)
bpy.ops.facial_retarget.stop_preview()
assert np.abs(moving - still).max() > 0.05, "the render rests"
task.use_scene_range, task.frame_start, task.frame_end = False, FIRST, FIRST + COUNT - 1
bpy.ops.facial_retarget.retarget()
assert np.abs(rendered(FIRST + 2) - moving).max() < 0.05, "the render is not that of a bake"
