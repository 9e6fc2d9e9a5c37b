"""Writing into Blender: a bake of 300 frames of 30 000 vertices, and FAPs played into one shape key."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from statistics import median
from time import perf_counter

import bpy
import numpy as np

from facial_retarget_addon.bridge.bakes.frames import write_frames
from facial_retarget_addon.bridge.bakes.names import frame_key_name
from facial_retarget_addon.bridge.meshes import new_object
from facial_retarget_addon.bridge.shape_keys import ensure_key, write_key
from facial_retarget_addon.core.acting.fap_face import fit_fap_face

from .faces import skin
from .timing import Row

FRAMES, VERTICES, ROUNDS = 300, 30_000, 5
PLAYED = {1_257: 6_000, 30_000: 900, 100_000: 270}
"""Vertices -> frames a second that FAPs shall play into a shape key."""
BLOCK = 16
"""Frames that are computed at once: what fits into the processor's cache."""
Write = Callable[[bpy.types.Object, np.ndarray], None]


def rows() -> Iterator[Row]:
    """Seconds for the bake, and for the same keys by the documented way."""
    times: dict[Write, list[float]] = {bake: [], write_key_data: []}
    for _ in range(ROUNDS):
        for write, seconds in times.items():
            seconds.append(measure(write))
    ours, documented = (median(seconds) for seconds in times.values())
    yield Row(f"bake with curves, Blender {bpy.app.version_string}", ours, "s", 1.0)
    yield Row("the same keys through key.data, without curves", documented, "s")
    yield Row("the bake is faster by", documented / ours, "x")

    for vertices, bound in PLAYED.items():
        yield Row(f"FAPs into a shape key, {vertices} vertices", play(vertices), "frames/s", bound, at_least=True)


def play(vertices: int) -> float:
    """Frames a second from FAPs to a shape key of a face, which takes one frame after the other."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    mesh, points = skin(vertices)
    face = fit_fap_face(mesh, points)
    thing = new_object("face", mesh.vertices, np.full(len(mesh.faces), 3), mesh.faces.ravel())
    key = ensure_key(thing, "played")
    values = np.random.default_rng(1).normal(0, 300, (FRAMES, 68))
    seconds = []
    for _ in range(ROUNDS + 1):
        start = perf_counter()
        for i in range(0, FRAMES, BLOCK):
            for positions in face.frames(values[i : i + BLOCK]):
                write_key(key, positions)
        seconds.append(perf_counter() - start)
    return FRAMES / median(seconds[1:])


def measure(write: Write) -> float:
    """Seconds that a way of writing takes in a new file."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    rng = np.random.default_rng(1)
    vertices = rng.random((VERTICES, 3), np.float32)
    thing = new_object("face", vertices, np.full(VERTICES // 3, 3), np.arange(VERTICES))
    frames = vertices + rng.random((FRAMES, 1, 1), np.float32)
    start = perf_counter()
    write(thing, frames)
    return perf_counter() - start


def bake(thing: bpy.types.Object, frames: np.ndarray) -> None:
    """The extension's way."""
    write_frames(thing, frames, first=1)


def write_key_data(thing: bpy.types.Object, frames: np.ndarray) -> None:
    """The way of Blender's documentation."""
    for i, positions in enumerate(frames):
        ensure_key(thing, frame_key_name("frame_####", i + 1)).data.foreach_set("co", positions.ravel())
