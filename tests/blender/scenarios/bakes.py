"""Every kind of bake plays back the frames, replaces the one before, and survives saving."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import donor_pair, empty_scene, enable, key_shape, part, refused, shown

FOLDER = Path(sys.argv[-1])
FIRST, COUNT = 11, 6
CACHES = {"pc2": "MESH_CACHE", "mdd": "MESH_CACHE", "alembic": "MESH_SEQUENCE_CACHE", "usd": "MESH_SEQUENCE_CACHE"}
KINDS = ("frames", "absolute", *CACHES, "usd", "alembic", "alembic", "compact", "absolute", "frames")
"""One after the other, some over what they were themselves."""


def pair() -> bpy.types.PropertyGroup:
    """The built-in actor with animated expressions, and a warped one, as the task's faces."""
    empty_scene()
    source, target = donor_pair()
    task, scene = bpy.context.scene.facial_retarget, bpy.context.scene
    task.source, task.target, task.method = source, target, "motion_cloning"
    scene.frame_start, scene.frame_end = FIRST, FIRST + COUNT - 1
    for number, name in enumerate(("joy", "surprise")):
        key = source.data.shape_keys.key_blocks[name]
        for frame, value in ((FIRST, 0.0), (FIRST + 2 + number, 1.0), (FIRST + COUNT - 1, 0.2)):
            key.value = value
            key.keyframe_insert("value", frame=frame)
    scene.frame_set(FIRST)
    return task


def wanted(task: bpy.types.PropertyGroup, times: list[float]) -> np.ndarray:
    """(F, V, 3) what the core makes of the source's frames, in the target's own coordinates."""
    source = part("bridge.background").finished(part("bridge.performance").read_frames(bpy.context, task.source, times))
    problem = part("bridge.task").read_problem(bpy.context)
    settings = part("bridge.settings").read_task_settings(task)
    return part("core.retarget").retarget(task.method, problem, settings, source).frames


def played(thing: bpy.types.Object, times: list[float]) -> np.ndarray:
    """(F, V, 3) of an object at scene frames, sub-frames too."""
    found = []
    for time in times:
        bpy.context.scene.frame_set(int(time // 1), subframe=time % 1)
        found.append(shown(thing))
    return np.array(found)


def unit(task: bpy.types.PropertyGroup) -> float:
    problem = part("bridge.task").read_problem(bpy.context)
    return part("core.base.regions").eye_separation(problem.target.mesh, problem.target.points)


def bake(task: bpy.types.PropertyGroup, kind: str) -> None:
    task.bake.how.kind = kind
    assert bpy.ops.facial_retarget.retarget() == {"FINISHED"}
    assert task.target.facial_retarget.bake == kind


def every_kind_plays_the_frames() -> None:
    """One after the other on the same face: each replaces the one before."""
    task = pair()
    times = list(range(FIRST, FIRST + COUNT))
    frames = wanted(task, times)
    task.bake.how.tolerance = 0.002
    for kind in KINDS:
        task.bake.cache = str(FOLDER / f"performance.{kind}")
        bake(task, kind)
        off = np.linalg.norm(played(task.target, times) - frames, axis=2)
        keys = [] if task.target.data.shape_keys is None else task.target.data.shape_keys.key_blocks.keys()[1:]
        modifiers = [modifier.type for modifier in task.target.modifiers]
        if kind == "compact":
            assert np.sqrt((off**2).mean(axis=1)).max() <= 0.0021 * unit(task), off.max()
            assert 1 <= len(keys) < COUNT, keys
            assert all(key.startswith("retargeted_") for key in keys), keys
        else:
            assert off.max() < 1e-5 * unit(task), (kind, off.max())
            assert keys == ([] if kind in CACHES else [f"frame_{time:04d}" for time in times]), (kind, keys)
        assert modifiers == ([CACHES[kind]] if kind in CACHES else []), (kind, modifiers)
        saved = FOLDER / f"{kind}.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(saved))
        bpy.ops.wm.open_mainfile(filepath=str(saved))
        enable()
        task = bpy.context.scene.facial_retarget
        again = np.linalg.norm(played(task.target, times) - frames, axis=2)
        np.testing.assert_allclose(again, off, atol=1e-6)


def sub_frames_are_baked_where_they_lie() -> None:
    """Half frames: names, curves, playback."""
    task = pair()
    task.bake.step, task.bake.pattern = 0.5, 'k "###"'
    times = [FIRST + 0.5 * i for i in range(2 * COUNT - 1)]
    frames = wanted(task, times)
    for kind in ("frames", "absolute"):
        bake(task, kind)
        np.testing.assert_allclose(played(task.target, times), frames, atol=1e-5 * unit(task))
        names = task.target.data.shape_keys.key_blocks.keys()[1:]
        assert names[:2] == [f'k "0{FIRST}"', f'k "0{FIRST}.5"'], names
        assert len(names) == len(times)


def a_rig_plays_it_with_its_own_keys() -> None:
    """Fitted to the target's keys: nothing new but curves; with a residual, one key more for each range."""
    task = pair()
    assert bpy.ops.facial_retarget.clone_shapes() == {"FINISHED"}
    names = task.target.data.shape_keys.key_blocks.keys()
    shapes = {name: key_shape(task.target, name).copy() for name in names}
    times = list(range(FIRST, FIRST + COUNT))
    frames = wanted(task, times)
    task.bake.how.smoothness = 0.0
    bake(task, "rig")
    assert task.target.data.shape_keys.key_blocks.keys() == names
    off = np.linalg.norm(played(task.target, times) - frames, axis=2)
    assert off.max() < 0.02 * unit(task), off.max() / unit(task)
    for name, shape in shapes.items():
        np.testing.assert_array_equal(key_shape(task.target, name), shape)
    bpy.context.scene.frame_set(FIRST + 2)
    assert abs(task.target.data.shape_keys.key_blocks["joy"].value - 1) < 0.02
    task.bake.how.residual = 3
    bake(task, "rig")
    added = [block.name for block in task.target.data.shape_keys.key_blocks if block.name not in names]
    assert added == ["retargeted_residual_1", "retargeted_residual_2"], added
    closer = np.linalg.norm(played(task.target, times) - frames, axis=2)
    assert (closer**2).mean() <= (off**2).mean() * (1 + 1e-6)
    # Another kind takes the curves off the own keys: they would move the face a second time.
    bake(task, "frames")
    np.testing.assert_allclose(played(task.target, times), frames, atol=1e-5 * unit(task))
    assert all(task.target.data.shape_keys.key_blocks[name].value == 0 for name in names[1:])


def what_cannot_be_done_is_said() -> None:
    """Absolute keys beside own ones, a rig without keys, a cache without a file, bad patterns."""
    task = pair()
    task.bake.how.kind = "rig"
    with refused("target", "no shape key", "rig"):
        bpy.ops.facial_retarget.retarget()
    task.bake.how.kind = "pc2"
    with refused("no file is chosen for the cache"):
        bpy.ops.facial_retarget.retarget()
    task.bake.cache = str(FOLDER / "nowhere" / "a.pc2")
    with refused("nowhere", "no folder"):
        bpy.ops.facial_retarget.retarget()
    task.bake.how.kind, task.bake.pattern = "frames", "frame"
    with refused("'frame'", "no #"):
        bpy.ops.facial_retarget.retarget()
    task.bake.pattern = 62 * "ä" + "#"
    with refused("at most 63"):
        bpy.ops.facial_retarget.retarget()
    task.bake.pattern, task.bake.how.kind = "frame_####", "absolute"
    own = task.target.shape_key_add(name="Basis", from_mix=False)
    task.target.shape_key_add(name='my "own"', from_mix=False)
    assert own.name == "Basis"
    with refused('my "own"', "turn off"):
        bpy.ops.facial_retarget.retarget()


every_kind_plays_the_frames()
sub_frames_are_baked_where_they_lie()
a_rig_plays_it_with_its_own_keys()
what_cannot_be_done_is_said()
