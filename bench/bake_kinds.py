"""Every kind of bake of 300 frames of 30 000 vertices: seconds to write it, memory against the size of the frames."""

from __future__ import annotations

import gc
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from statistics import median
from time import perf_counter

import bpy
import numpy as np

from facial_retarget_addon import properties
from facial_retarget_addon.bridge.background import finished
from facial_retarget_addon.bridge.bakes.bake import Wish, bake_steps
from facial_retarget_addon.bridge.bakes.scene_cache import let_go
from facial_retarget_addon.bridge.heads import Head, head_now, read_head
from facial_retarget_addon.bridge.key_sets import KeyTraits, write_keys
from facial_retarget_addon.bridge.meshes import new_object
from facial_retarget_addon.bridge.points.points import write_points
from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.core.base.regions import eye_separation
from facial_retarget_addon.core.face_regions import region_weights
from facial_retarget_addon.core.methods.settings import BakeSettings
from facial_retarget_addon.core.problem import Face
from facial_retarget_addon.files.whole import written_whole

from .faces import skin
from .timing import Row

FRAMES, VERTICES, AMPLITUDE, ROUNDS = 300, 30_000, 0.05, 3
KINDS = ("frames", "absolute", "compact", "rig", "pc2", "mdd", "alembic", "usd")
WRITING, MEMORY = 1.0, 2.0
"""Bounds: seconds, and the frames' own size together with what is added to it."""


def rows() -> Iterator[Row]:
    """Each kind in a process of its own, so that no other one's memory counts."""
    for kind in KINDS:
        preparing, writing, growth = map(median, zip(*(run(kind) for _ in range(ROUNDS)), strict=True))
        if kind in ("compact", "rig"):
            yield Row(f"{kind}: computed in", preparing, "s")
        yield Row(f"{kind}: written in", writing, "s", WRITING)
        yield Row(f"{kind}: frames and all memory at its peak, of the frames' size", 1 + growth, "x", MEMORY)


def run(kind: str) -> list[float]:
    """`measure` in a new process."""
    command = [sys.executable, "-m", "bench.bake_kinds", kind]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split("\n")
    return [float(word) for word in said[-2].split()]


def measure(kind: str) -> tuple[float, float, float]:
    """Seconds to prepare and to write a bake, and how far memory rises meanwhile, in sizes of the frames."""
    head, frames = acting_head(kind)
    unit = eye_separation(head.face.mesh, head.face.points)
    times = range(1, FRAMES + 1)
    with tempfile.TemporaryDirectory() as folder:
        wish = Wish(BakeSettings(kind=kind), "frame_####", str(Path(folder) / "bake.pc2"))
        before = rest_memory()
        start = perf_counter()
        bake = finished(bake_steps(head, unit, frames, times, wish))
        prepared = perf_counter()
        with let_go(bake.files), written_whole() as aside:
            bake.add_files(aside)
        bake.write()
        written = perf_counter()
        growth = (memory("VmHWM") - before) / frames.nbytes
        check(head, frames, kind)
    return prepared - start, written - prepared, growth


def acting_head(kind: str) -> tuple[Head, FloatArray]:
    """A face with points, and (F, V, 3) float32 frames of slow waves in its regions; for a rig keys of these."""
    properties.register()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    mesh, points = skin(VERTICES)
    thing = new_object("face", mesh.vertices, np.full(len(mesh.faces), 3), mesh.faces.ravel())
    write_points(thing, points)
    weights = region_weights(Face(mesh, points)).T
    shapes = np.concatenate([AMPLITUDE * weights[:, :, None] * axis for axis in np.eye(3)]).astype(np.float32)
    if kind == "rig":
        names = [f"unit {number}" for number in range(len(shapes))]
        write_keys(thing, dict(zip(names, shapes, strict=True)), dict.fromkeys(names, KeyTraits(low=-1.0)))
    rng, rest = np.random.default_rng(1), mesh.vertices.astype(np.float32)
    phases, paces = rng.uniform(0, 6, len(shapes)), rng.uniform(0.02, 0.2, len(shapes))
    frames = np.empty((FRAMES, *rest.shape), np.float32)
    for number, frame in enumerate(frames):
        frame[:] = np.tensordot(np.sin(paces * number + phases).astype(np.float32), shapes, axes=1) + rest
    return read_head(thing), frames


def check(head: Head, frames: FloatArray, kind: str) -> None:
    """The bake must play the last frame: to float32, or within half a percent of the eye separation."""
    bpy.context.scene.frame_set(FRAMES)
    away = np.linalg.norm(head_now(head.things, bpy.context.evaluated_depsgraph_get()) - frames[-1], axis=1)
    unit = eye_separation(head.face.mesh, head.face.points)
    assert away.max() < (0.05 if kind in ("compact", "rig") else 1e-5) * unit, (kind, away.max() / unit)


def memory(what: str) -> int:
    """Bytes of this process by Linux: VmRSS now, VmHWM at its peak."""
    line = next(line for line in Path("/proc/self/status").read_text().split("\n") if line.startswith(what))
    return 1024 * int(line.split()[1])


def rest_memory() -> int:
    """Bytes of this process now; its peak counts from here on."""
    gc.collect()
    Path("/proc/self/clear_refs").write_text("5")
    return memory("VmRSS")


if __name__ == "__main__":
    print(*measure(sys.argv[1]))
