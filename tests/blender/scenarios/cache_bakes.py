"""Caches play the frames on heads as artists have them: parts, keys, modifiers, uneven scale, odd names, sub-frames."""

import resource
import signal
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Euler, Matrix
from stage import differences, empty_scene, enable, everything, grid, part, refused, shown, wave

FOLDER = Path(sys.argv[-1])
KINDS = {"pc2": "pc2", "mdd": "mdd", "alembic": "abc", "usd": "usd"}
FIRST, COUNT = -3, 5


def head() -> bpy.types.Object:
    """A face and two parts, of which one is still, turned and unevenly scaled, with names that no file knows."""
    empty_scene()
    bpy.context.scene.render.fps, bpy.context.scene.render.fps_base = 30, 1.001
    face, part_one, still = grid('a "face"/of Ä.001', 7), grid("/", 5), grid("1 still", 4)
    for number, thing in enumerate((face, part_one, still)):
        place = Matrix.LocRotScale((number, 2, 3), Euler((0.3, 0.2 * number, 0.1)), (2, 1 + number, 0.7))
        thing.matrix_world = place
    for thing in (part_one, still):
        face.facial_retarget.parts.add().thing = thing
    face.shape_key_add(name="Basis", from_mix=False)
    face.shape_key_add(name="own", from_mix=False).value = 1.0
    face.modifiers.new("own", "SIMPLE_DEFORM").angle = 0.0
    bpy.context.view_layer.update()
    return face


def moving(face: bpy.types.Object) -> np.ndarray:
    """(COUNT, V, 3) frames of the head: its face and its first part move."""
    found = part("bridge.heads").read_head(face)
    frames = np.repeat(found.face.mesh.vertices[None].astype(np.float32), COUNT, axis=0)
    moved = found.starts[2]
    frames[:, :moved] += np.random.default_rng(1).normal(0, 0.2, (COUNT, moved, 3)).astype(np.float32)
    return frames


def bake(face: bpy.types.Object, kind: str, frames: np.ndarray, times: list[float], path: Path) -> None:
    """As the button does."""
    module, read = part("bridge.bakes.bake"), part("bridge.heads").read_head(face)
    wish = module.Wish(part("core.methods.settings").BakeSettings(kind=kind), "", str(path))
    prepared = part("bridge.background").finished(module.bake_steps(read, 1.0, frames, times, wish))
    with part("bridge.bakes.scene_cache").let_go(prepared.files), part("files.whole").written_whole() as aside:
        prepared.add_files(aside)
    prepared.write()


def read(face: bpy.types.Object, time: float) -> np.ndarray:
    """(V, 3) the head at a scene frame, in the head's coordinates."""
    bpy.context.scene.frame_set(int(time // 1), subframe=time % 1)
    things = part("bridge.heads").head_parts(face)
    return part("bridge.heads").head_now([face, *things], bpy.context.evaluated_depsgraph_get())


def every_cache_plays_a_head() -> None:
    """At every step of frames and half-way between two, before and after saving; over a file of the same name too."""
    for kind, suffix in KINDS.items():
        face = head()
        frames, path = moving(face), FOLDER / f'odd "näme".{suffix}'
        for step in (1.0, 0.5, 2.0):
            times = [FIRST + step * i for i in range(COUNT)]
            frames = frames[::-1].copy()  # other frames each time, into the file that is there
            bake(face, kind, frames, times, path)
            assert path.is_file()
            assert not list(FOLDER.glob(".*")), list(FOLDER.iterdir())
            saved = FOLDER / f"{kind}.blend"
            for after in ("bake", "saving"):
                for time, frame in zip(times, frames, strict=True):
                    np.testing.assert_allclose(read(face, time), frame, atol=5e-6, err_msg=f"{kind} {step} {after}")
                between = read(face, times[0] + 0.5 * step)
                np.testing.assert_allclose(between, (frames[0] + frames[1]) / 2, atol=2e-5, err_msg=f"{kind} {step}")
                np.testing.assert_allclose(read(face, FIRST - 5), frames[0], atol=5e-6)
                np.testing.assert_allclose(read(face, FIRST + 50), frames[-1], atol=5e-6)
                bpy.ops.wm.save_as_mainfile(filepath=str(saved))
                bpy.ops.wm.open_mainfile(filepath=str(saved))
                enable()
                face = next(thing for thing in bpy.data.objects if len(thing.facial_retarget.parts))
        assert [modifier.name for modifier in face.modifiers] == ["Facial Retarget", "own"]
        assert [block.name for block in face.data.shape_keys.key_blocks] == ["Basis", "own"]
        still = face.facial_retarget.parts[1].thing
        assert not still.modifiers
        assert [len(data) for data in (bpy.data.scenes, bpy.data.objects, bpy.data.meshes)] == [1, 3, 3]
        assert len(bpy.data.cache_files) == (kind in ("alembic", "usd")), bpy.data.cache_files.keys()
        part("bridge.bakes.frames").remove_bake(face)
        part("bridge.bakes.frames").remove_bake(face.facial_retarget.parts[0].thing)
        assert [*bpy.data.cache_files, *bpy.data.actions] == []


def one_frame_and_no_motion() -> None:
    """A single frame, and frames that are all alike, of which exporters write one."""
    for kind, suffix in KINDS.items():
        face = grid("plain")
        still = np.repeat(wave(face, 1), 3, axis=0)
        for frames in (still[:1], still):
            bake(face, kind, frames, [float(1 + i) for i in range(len(frames))], FOLDER / f"still.{suffix}")
            for time in (0, 1, 2, 9):
                bpy.context.scene.frame_set(time)
                np.testing.assert_allclose(shown(face), still[0], atol=1e-6, err_msg=kind)
        bpy.data.objects.remove(face)


def what_the_disk_does_not_take_changes_nothing() -> None:
    """A file that grows past what the system allows: the scene and the cache of before stay."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    for kind, suffix in KINDS.items():
        empty_scene()
        face = grid("plain", 40)
        path = FOLDER / f"full.{suffix}"
        frames = wave(face, 20)
        bake(face, kind, frames, list(range(20)), path)
        before, held = everything(), path.read_bytes()
        limit = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (60_000, limit[1]))
        try:
            with refused(path.name, "cannot be written"):
                bake(face, kind, frames + 1, list(range(20)), path)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limit)
        assert not differences(before, everything()), differences(before, everything())
        assert path.read_bytes() == held, kind
        assert not list(FOLDER.glob(".full*")), kind
        bpy.context.scene.frame_set(7)
        np.testing.assert_allclose(shown(face), frames[7], atol=1e-6)


every_cache_plays_a_head()
one_frame_and_no_motion()
what_the_disk_does_not_take_changes_nothing()
