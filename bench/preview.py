"""The live preview in Blender: from the source's evaluated shape to the target's shape key, without drawing."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import numpy as np

from facial_retarget_addon import demo, properties
from facial_retarget_addon.bridge.background import finished
from facial_retarget_addon.bridge.bakes.frames import write_frames
from facial_retarget_addon.bridge.examples import write_example
from facial_retarget_addon.bridge.meshes import new_object
from facial_retarget_addon.bridge.points import write_points
from facial_retarget_addon.bridge.preview import preview_steps, stop_preview
from facial_retarget_addon.preview_state import STATE

from .timing import Row

SOURCE_VERTICES, TARGET_VERTICES = 26_000, 30_000
EVERY = 8
"""One frame of so many of the built-in performance."""
ROUNDS = 3
BOUNDS = {"feature_points": 10.0, "motion_cloning": 10.0, "hierarchical": 30.0, "wavelet": None}
"""Method -> milliseconds that the median frame may take."""
BASE_POINTS = 85
"""Points of the base mesh, with which four levels make the 17 470 fine vertices of Na and Jung's table, or more."""


def rows() -> Iterator[Row]:
    """Milliseconds a frame of each method, alone and steered by six examples."""
    properties.register()
    source, target = demo.actor(SOURCE_VERTICES), demo.warped_actor(np.random.default_rng(3), TARGET_VERTICES)
    frames = demo.performance(source)[::EVERY].astype(np.float32)
    for examples in (False, True):
        _make_scene(source, target, frames, examples)
        if not examples:
            yield Row("source vertices", len(source.face.mesh.vertices), "")
            yield Row("target vertices", len(target.face.mesh.vertices), "")
        for method, bound in BOUNDS.items():
            yield from _method_rows(method, len(frames), "with six examples" if examples else "", bound)
    properties.unregister()


def _method_rows(method: str, count: int, how: str, bound: float | None) -> Iterator[Row]:
    scene = bpy.context.scene
    task = scene.facial_retarget
    task.method = method
    if hasattr(getattr(task, method), "base_points"):
        getattr(task, method).base_points = BASE_POINTS
    finished(preview_steps(bpy.context))
    taken = []
    for turn in range(ROUNDS + 1):
        for frame in range(1, count + 1):
            scene.frame_set(frame)
            if turn:
                taken.append(STATE.milliseconds)
    stop_preview()
    name = " ".join([method, how]).strip()
    yield Row(f"{name}: median frame", float(np.median(taken)), "ms", bound)
    yield Row(f"{name}: slowest of ten", float(np.quantile(taken, 0.9)), "ms")


def _make_scene(source: demo.DemoFace, target: demo.DemoFace, frames: np.ndarray, examples: bool) -> None:
    """A file with both faces, the source acting over the scene's frames."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    task = bpy.context.scene.facial_retarget
    for role, face in (("source", source), ("target", target)):
        thing = new_object(role, face.face.mesh.vertices, face.counts, face.corners)
        write_points(thing, face.face.points)
        if examples:
            for name, positions in face.face.examples.items():
                write_example(thing, name, positions)
        setattr(task, role, thing)
    if examples:
        for name in source.face.examples:
            task.examples.add().name = name
    write_frames(task.source, frames, 1)
