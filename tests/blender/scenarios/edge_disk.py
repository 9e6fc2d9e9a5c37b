"""Every output of Blender on a full disk and in a read-only folder: one sentence, and scene and files as they were."""

import os
import resource
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import bpy
import numpy as np
from stage import differences, empty_scene, everything, part, refused

NOBODY = 65534
MEGABYTES = 64
STEM = "out"


def textured(face: object, name: str) -> bpy.types.Object:
    """A built-in face as an object with points and UVs."""
    file = part("files.mesh_file").MeshFile(face.face.mesh, face.counts, face.corners, face.uvs[face.corners])
    made = part("bridge.meshes").new_face(name, file)
    part("bridge.points.points").write_points(made, face.face.points)
    return made


def pair() -> bpy.types.PropertyGroup:
    """Two faces, of which the source moves for two frames and the target has shape keys with curves."""
    empty_scene()
    demo, task = part("demo"), bpy.context.scene.facial_retarget
    actor = demo.actor(1_500)
    task.source, task.target = textured(actor, "source"), textured(actor, "target")
    task.hierarchical.levels = 1
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 2
    rest = actor.face.mesh.vertices.astype(np.float32)
    moved = np.stack([rest, actor.face.examples["joy"].astype(np.float32)])
    part("bridge.bakes.frames").write_frames(task.source, moved, 1)
    for name in ("jawOpen", "mouthClose"):
        key = part("bridge.shape_keys").ensure_key(task.target, name)
        part("bridge.shape_keys").write_key(key, moved[1])
        for frame in (1, 2):
            key.value = frame - 1.0
            key.keyframe_insert("value", frame=frame)
    bpy.context.view_layer.objects.active = task.target
    task.target.select_set(True)
    bpy.context.scene.frame_set(1)
    return task


def baked(kind: str, suffix: str) -> Callable[[bpy.types.PropertyGroup, Path], Callable[[], object]]:
    def prepare(task: bpy.types.PropertyGroup, folder: Path) -> Callable[[], object]:
        task.bake.how.kind, task.bake.cache = kind, str(folder / f"{STEM}{suffix}")
        return bpy.ops.facial_retarget.retarget

    return prepare


def reported(task: bpy.types.PropertyGroup, folder: Path) -> Callable[[], object]:
    task.bake.how.kind = "frames"
    task.report, task.page = str(folder / f"{STEM}.json"), str(folder / f"{STEM}.html")
    return bpy.ops.facial_retarget.retarget


def mapped(task: bpy.types.PropertyGroup, folder: Path) -> Callable[[], object]:
    task.normal_maps.folder, task.normal_maps.pixels = str(folder / STEM), 64
    return bpy.ops.facial_retarget.make_normal_maps


def wrinkled(task: bpy.types.PropertyGroup, folder: Path) -> Callable[[], object]:
    fine = task.target.copy()
    fine.data = task.target.data.copy()
    bpy.context.scene.collection.objects.link(fine)
    kit = task.wrinkle_kit
    kit.detail, kit.fine, kit.folder, kit.pixels, kit.least = "OBJECT", fine, str(folder / STEM), 64, 0.0
    return bpy.ops.facial_retarget.make_wrinkle_kit


def controlled(task: bpy.types.PropertyGroup, folder: Path) -> Callable[[], object]:
    assert bpy.ops.facial_retarget.make_controls() == {"FINISHED"}
    return filed("export_faps", ".fap")(task, folder)


def filed(name: str, suffix: str, **options: object) -> Callable[[bpy.types.PropertyGroup, Path], Callable[[], object]]:
    """An operator that asks for a file."""

    def prepare(task: bpy.types.PropertyGroup, folder: Path) -> Callable[[], object]:
        operator = getattr(bpy.ops.facial_retarget, name)
        return lambda: operator(filepath=str(folder / f"{STEM}{suffix}"), **options)

    return prepare


RANGE = {"frame_start": 1, "frame_end": 2}
OUTPUTS = {
    "report and page": reported,
    "pc2": baked("pc2", ".pc2"),
    "mdd": baked("mdd", ".mdd"),
    "alembic": baked("alembic", ".abc"),
    "usd": baked("usd", ".usdc"),
    "normal maps": mapped,
    "wrinkle kit": wrinkled,
    "points": filed("save_points", ".json"),
    "job": filed("save_job", ".toml"),
    "clone job": filed("save_clone_job", ".toml"),
    "shapes": filed("save_shapes", ".json"),
    "faps measured": filed("export_motion", ".fap", **RANGE),
    "arkit": filed("export_motion", ".csv", **RANGE),
    "faps": controlled,
    "curves csv": filed("export_curves", ".csv", **RANGE),
    "curves json": filed("export_curves", ".json", **RANGE),
    "export glb": filed("export_gltf", ".glb"),
    "export fbx": filed("export_fbx", ".fbx"),
    "export usd": filed("export_usd", ".usdc"),
    "export alembic": filed("export_alembic", ".abc"),
}


@contextmanager
def limited(folder: Path) -> Iterator[None]:
    """No file may become longer than a few bytes: what a full disk is without a disk of one's own."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (64, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@contextmanager
def full(folder: Path) -> Iterator[None]:
    """A small disk, filled up."""
    filler = folder.parent / "filler"
    room = os.statvfs(folder)
    with open(filler, "wb") as file:
        os.posix_fallocate(file.fileno(), 0, room.f_bavail * room.f_frsize)
    try:
        yield
    finally:
        filler.unlink()


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """A folder whose rights forbid writing; root, whom rights do not bind, is somebody else meanwhile."""
    folder.chmod(0o555)
    root = os.geteuid() == 0
    if root:
        os.setresuid(NOBODY, NOBODY, 0)
    try:
        yield
    finally:
        if root:
            os.setresuid(0, 0, 0)
        folder.chmod(0o755)


@contextmanager
def places() -> Iterator[tuple[Path, bool]]:
    """A folder that any user may read, on a small disk of its own where root may mount one, and whether it is."""
    disk = Path(tempfile.mkdtemp(prefix="facial_retarget_disk_"))
    disk.chmod(0o755)
    own = os.geteuid() == 0 and shutil.which("mount") is not None
    mount = ["mount", "-t", "tmpfs", "-o", f"size={MEGABYTES}m,mode=755", "tmpfs", str(disk)]
    own = own and subprocess.run(mount, check=False).returncode == 0
    try:
        yield disk, own
    finally:
        if own:
            subprocess.run(["umount", "-l", str(disk)], check=True)
        shutil.rmtree(disk)


def held(folder: Path) -> dict[str, bytes | None]:
    """Everything in a folder, hidden or not."""
    return {str(p.relative_to(folder)): None if p.is_dir() else p.read_bytes() for p in sorted(folder.rglob("*"))}


def every_output(disk: Path, own: bool) -> None:
    """First well, then where it cannot be: the sentence names the output."""
    scarce = [full if own else limited, locked]
    failures = []
    for name, prepare in OUTPUTS.items():
        task, folder = pair(), disk / name.replace(" ", "_")
        folder.mkdir()
        run = prepare(task, folder)
        assert run() == {"FINISHED"}, name
        files = held(folder)
        assert any(path.startswith(STEM) for path in files), (name, files.keys())
        for trouble in scarce:
            before = everything()
            try:
                with trouble(folder), refused(str(folder / STEM), " cannot be written: "):
                    run()
                assert not differences(before, everything()), differences(before, everything())
                assert held(folder) == files, set(held(folder)) ^ set(files)
            except AssertionError as error:
                failures.append(f"{name}, {trouble.__name__}: {error}")
    assert not failures, "\n".join(failures)


signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
with places() as (found, alone):
    every_output(found, alone)
