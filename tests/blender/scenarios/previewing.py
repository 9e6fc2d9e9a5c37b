"""The live preview: the target follows what the artist does, and nothing of it is left anywhere."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import disable, donor_pair, empty_scene, enable, part, shown, shown_frames

folder = Path(sys.argv[1])
HANDLERS = ("frame_change_post", "depsgraph_update_post", "save_pre", "save_post")


def handlers() -> int:
    """How many of the preview's handlers work."""
    return sum(
        one.__module__.endswith("bridge.preview.preview")
        for name in HANDLERS
        for one in getattr(bpy.app.handlers, name)
    )


def scene_of_two() -> tuple[bpy.types.Object, bpy.types.Object]:
    """Source and target, chosen; the source's keys are animated over frames 1 to 9."""
    empty_scene()
    source, target = donor_pair()
    task = bpy.context.scene.facial_retarget
    task.source, task.target, task.method = source, target, "motion_cloning"
    for frame, name in ((3, "joy"), (7, "surprise")):
        key = source.data.shape_keys.key_blocks[name]
        for at, value in ((frame - 2, 0.0), (frame, 1.0), (frame + 2, 0.0)):
            key.value = value
            key.keyframe_insert("value", frame=at)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 9
    bpy.context.scene.frame_set(1)
    return source, target


def positions(thing: bpy.types.Object) -> np.ndarray:
    return part("bridge.meshes").read_positions(thing.data).copy()


def wanted(frame: int) -> np.ndarray:
    """What Retarget bakes at a frame."""
    return baked[frame - 1]


# What a bake gives, to compare with.
source, target = scene_of_two()
rest = positions(target)
bpy.ops.facial_retarget.retarget()
baked = shown_frames(target, range(1, 10))
size = np.ptp(rest)
assert np.abs(wanted(3) - rest).max() > 0.02 * size

# Scrubbing and dragging: with the bake on the target, and on one without any keys.
for bare in (False, True):
    if bare:
        source, target = scene_of_two()
    bpy.context.scene.frame_set(1)
    assert bpy.ops.facial_retarget.start_preview("INVOKE_DEFAULT") == {"FINISHED"}
    assert handlers() == len(HANDLERS)
    for frame in (3, 7, 1, 8):
        bpy.context.scene.frame_set(frame)
        np.testing.assert_allclose(shown(target), wanted(frame), atol=1e-5 * size)
    bpy.context.scene.frame_set(1)
    source.data.shape_keys.animation_data.action, action = None, source.data.shape_keys.animation_data.action
    source.data.shape_keys.key_blocks["joy"].value = 1.0
    bpy.context.view_layer.update()
    np.testing.assert_allclose(shown(target), wanted(3), atol=1e-5 * size)
    source.data.shape_keys.animation_data.action = action
    if not bare:
        assert bpy.ops.facial_retarget.stop_preview() == {"FINISHED"}
        assert handlers() == 0
        assert len(target.data.shape_keys.key_blocks) == 10
        bpy.context.scene.frame_set(7)
        np.testing.assert_allclose(shown(target), wanted(7), atol=1e-5 * size)

# Modifiers act on what is shown: twice as high.
bpy.context.scene.frame_set(3)
displace = target.modifiers.new("up", "DISPLACE")
displace.direction, displace.strength, displace.mid_level = "Z", 1.0, 0.0
bpy.context.view_layer.update()
np.testing.assert_allclose(shown(target), wanted(3) + [0, 0, 1], atol=1e-5 * size)
target.modifiers.remove(displace)

# A saved file holds nothing of it, and it goes on afterwards.
copy, path = folder / "copy.blend", folder / "saved.blend"
bpy.ops.wm.save_as_mainfile(filepath=str(copy), copy=True)
bpy.context.scene.frame_set(7)
np.testing.assert_allclose(shown(target), wanted(7), atol=1e-5 * size)
with bpy.data.libraries.load(str(copy)) as (inside, wanted_here):
    wanted_here.objects = [name for name in inside.objects if name.startswith("target")]
(saved,) = wanted_here.objects
assert saved.data.shape_keys is None
assert np.array_equal(positions(saved), rest)
bpy.data.batch_remove([saved, saved.data])

# Gains act at once, and as they do in a bake.
task = bpy.context.scene.facial_retarget
weights = part("core.face_regions").region_weights(part("bridge.heads").read_head(target).face)
task.regions.mouth, task.regions.brows = 0.5, 1.5
strength = 1 + weights @ [0.5, 0, 0, 0, -0.5, 0]
np.testing.assert_allclose(shown(target), rest + strength[:, None] * (wanted(7) - rest), atol=1e-5 * size)
group = target.vertex_groups.new(name="left")
group.add(np.flatnonzero(rest[:, 0] > 0).tolist(), 1.0, "REPLACE")
assert bpy.ops.facial_retarget.add_mask() == {"FINISHED"}
assert task.masks[0].name == "left"
task.masks[0].gain = 0.25
strength *= np.where(rest[:, 0] > 0, 0.25, 1.0)
np.testing.assert_allclose(shown(target), rest + strength[:, None] * (wanted(7) - rest), atol=1e-5 * size)
group.add(np.flatnonzero(rest[:, 0] > 0).tolist(), 0.0, "REPLACE")
target.data.update()
bpy.context.view_layer.update()
strength = 1 + weights @ [0.5, 0, 0, 0, -0.5, 0]
np.testing.assert_allclose(shown(target), rest + strength[:, None] * (wanted(7) - rest), atol=1e-5 * size)
task.regions.mouth = task.regions.brows = 1.0
assert bpy.ops.facial_retarget.remove_mask() == {"FINISHED"}
np.testing.assert_allclose(shown(target), wanted(7), atol=1e-5 * size)

# So do the strengths of the levels.
task.method = "hierarchical"
bpy.ops.facial_retarget.start_preview()
at_one = shown(target)
task.hierarchical.base_gain, task.hierarchical.detail_scale = 0.5, 0.0
halved = shown(target)
assert np.abs(halved - at_one).max() > 0.01 * size
assert not part("preview_state").STATE.stale
bpy.ops.facial_retarget.start_preview()
np.testing.assert_allclose(shown(target), halved, atol=1e-5 * size)
task.hierarchical.base_gain = task.hierarchical.detail_scale = 1.0
np.testing.assert_allclose(shown(target), at_one, atol=1e-5 * size)
task.method = "motion_cloning"
bpy.ops.facial_retarget.start_preview()

# Methods compared: figures of each, and a click shows the other one at once.
task.compared, task.compared_frames = {"motion_cloning", "feature_points"}, 3
assert bpy.ops.facial_retarget.compare("INVOKE_DEFAULT") == {"FINISHED"}
state = part("preview_state").STATE
assert {row.method: len(row.cells) for row in state.rows} == {"feature_points": 6, "motion_cloning": 6}
assert bpy.context.scene.frame_current == 7
np.testing.assert_allclose(shown(target), wanted(7), atol=1e-5 * size)
assert bpy.ops.facial_retarget.show_method(method="feature_points") == {"FINISHED"}
assert state.on
assert state.method == "feature_points"
assert not state.stale
other = shown(target)
assert np.abs(other - wanted(7)).max() > 0.001 * size
bpy.ops.facial_retarget.show_method(method="hierarchical")
assert "method" in state.stale
bpy.ops.facial_retarget.show_method(method="motion_cloning")
assert not state.stale
np.testing.assert_allclose(shown(target), wanted(7), atol=1e-5 * size)

# Out of date: says so, and a refresh takes it in.
state = part("preview_state").STATE
check = part("bridge.preview.preview").check_origin
check()
assert state.on
assert not state.stale
target.facial_retarget.points[0].weights = (0.2, 0.4, 0.4)
check()
assert "points" in state.stale, state.stale
bpy.context.scene.facial_retarget.motion_cloning.motion = "regional"
assert "settings" in state.stale, state.stale
assert bpy.ops.facial_retarget.start_preview() == {"FINISHED"}
check()
assert not state.stale
assert handlers() == len(HANDLERS)

# Another target: off, and the one before is as it was.
assert bpy.ops.facial_retarget.stop_preview() == {"FINISHED"}
assert target.data.shape_keys is None
assert np.array_equal(positions(target), rest)
assert np.array_equal(shown(target), rest)
bpy.ops.facial_retarget.start_preview()
bpy.context.scene.facial_retarget.target = source
assert not state.on
assert handlers() == 0
assert target.data.shape_keys is None
bpy.context.scene.facial_retarget.target = target

# Keys that the artist makes meanwhile stay, in the file too.
bpy.ops.facial_retarget.start_preview()
target.shape_key_add(name="own", from_mix=False)
bpy.context.view_layer.update()
bpy.ops.wm.save_as_mainfile(filepath=str(path))
bpy.ops.facial_retarget.stop_preview()
assert [key.name for key in target.data.shape_keys.key_blocks] == ["Basis", "own"]
bpy.ops.wm.open_mainfile(filepath=str(path))
assert not state.on
assert handlers() == 0
(target,) = (thing for thing in bpy.data.objects if thing.name.startswith("target"))
assert [key.name for key in target.data.shape_keys.key_blocks] == ["Basis", "own"]
assert np.array_equal(positions(target), rest)

# What Blender saved by itself in the midst of it is cleaned up when it is loaded.
bpy.ops.facial_retarget.start_preview()
for name in ("save_pre", "save_post"):
    getattr(bpy.app.handlers, name).clear()
bpy.ops.wm.save_as_mainfile(filepath=str(path))
bpy.ops.wm.open_mainfile(filepath=str(path))
(target,) = (thing for thing in bpy.data.objects if thing.name.startswith("target"))
assert [key.name for key in target.data.shape_keys.key_blocks] == ["Basis", "own"]

# Undo and redo turn it off and on again with the scene that they bring back.
source, target = scene_of_two()
bpy.ops.ed.undo_push(message="before")
bpy.ops.facial_retarget.start_preview()
bpy.ops.ed.undo_push(message="Live Preview")
bpy.context.scene.frame_set(3)
bpy.ops.ed.undo_push(message="Change Frame")
bpy.ops.facial_retarget.stop_preview()
bpy.ops.ed.undo_push(message="off")


def found() -> bpy.types.Object:
    return bpy.context.scene.facial_retarget.target


bpy.ops.ed.undo()
assert state.on
assert handlers() == len(HANDLERS)
np.testing.assert_allclose(shown(found()), wanted(bpy.context.scene.frame_current), atol=1e-5 * size)
bpy.context.scene.frame_set(7)
np.testing.assert_allclose(shown(found()), wanted(7), atol=1e-5 * size)
bpy.ops.ed.undo()
bpy.ops.ed.undo()
assert not state.on
assert handlers() == 0
assert found().data.shape_keys is None
assert np.array_equal(positions(found()), rest)
bpy.ops.ed.redo()
assert state.on
bpy.ops.ed.redo()
bpy.ops.ed.redo()
assert not state.on
assert found().data.shape_keys is None

# A face that is deleted ends it; undo brings the scene back.
for role in ("source", "target"):
    source, target = scene_of_two()
    bpy.ops.facial_retarget.start_preview()
    bpy.ops.ed.undo_push(message="on")
    bpy.data.objects.remove({"source": source, "target": target}[role])
    bpy.context.view_layer.update()
    bpy.context.scene.frame_set(4)
    assert not state.on
    assert handlers() == 0
    if role == "source":
        assert target.data.shape_keys is None
        assert np.array_equal(positions(target), rest)
    bpy.ops.ed.undo_push(message="deleted")
    bpy.ops.ed.undo()
    bpy.context.scene.frame_set(3)
    assert state.on
    np.testing.assert_allclose(shown(found()), wanted(3), atol=1e-5 * size)
    bpy.ops.facial_retarget.stop_preview()

# Disabled in the midst of it: nothing is left.
source, target = scene_of_two()
bpy.ops.facial_retarget.start_preview()
disable()
assert target.data.shape_keys is None
assert handlers() == 0
assert not [one for one in bpy.app.handlers.undo_post if one.__module__.endswith("bridge.preview.preview")]
enable()
