"""The live preview in Blender: from the source's evaluated shape to the target's shape key, without drawing."""

from __future__ import annotations

from collections.abc import Iterator
from time import perf_counter

import bpy
import numpy as np

from facial_retarget_addon import demo, properties
from facial_retarget_addon.bridge.background import finished
from facial_retarget_addon.bridge.bakes.frames import write_frames
from facial_retarget_addon.bridge.examples.examples import write_example
from facial_retarget_addon.bridge.meshes import new_object
from facial_retarget_addon.bridge.points.points import write_points
from facial_retarget_addon.bridge.preview.preview import preview_steps, stop_preview
from facial_retarget_addon.core.methods.base import fit
from facial_retarget_addon.core.methods.settings import HierarchicalSettings
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.preview_state import STATE

from .timing import Row

SOURCE_VERTICES, TARGET_VERTICES = 26_000, 30_000
EVERY = 8
"""One frame of so many of the built-in performance."""
ROUNDS = 5
"""How often each frame is shown; the quickest counts, so that other programs do not."""
BOUNDS = {"feature_points": 10.0, "motion_cloning": 10.0, "hierarchical": 30.0, "wavelet": None}
"""Method -> milliseconds that the median frame may take."""
CHANGED, ADJUSTED = ("base_gain", "detail_scale", "example_strength"), 300.0
"""Strengths that are changed while the preview is on, and milliseconds that this may take."""


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
            problem = Problem(*(Face(face.face.mesh, face.face.points) for face in (source, target)))
            levels = fit("hierarchical", problem, HierarchicalSettings()).report["levels"]
            yield Row("fine vertices of the methods with levels", levels[-1]["vertices"], "")
        for method, bound in BOUNDS.items():
            yield from _method_rows(method, len(frames), "with six examples" if examples else "", bound)
    properties.unregister()


def _method_rows(method: str, count: int, how: str, bound: float | None) -> Iterator[Row]:
    scene = bpy.context.scene
    task = scene.facial_retarget
    task.method = method
    finished(preview_steps(bpy.context))
    taken = np.empty((ROUNDS, count))
    for turn in range(ROUNDS):
        for frame in range(count):
            scene.frame_set(frame + 1)
            taken[turn, frame] = STATE.milliseconds
    seconds = {"a region's gain": _changed(task.regions, "mouth")}
    strengths = [setting for setting in CHANGED if hasattr(getattr(task, method), setting)]
    seconds |= {setting: _changed(getattr(task, method), setting) for setting in strengths}
    stop_preview()
    taken = taken.min(axis=0)
    name = " ".join([method, how]).strip()
    yield Row(f"{name}: median frame", float(np.median(taken)), "ms", bound)
    yield Row(f"{name}: slowest of ten", float(np.quantile(taken, 0.9)), "ms")
    for what, value in seconds.items():
        yield Row(f"{name}: {what} changed", 1e3 * value, "ms", ADJUSTED)


def _changed(group: bpy.types.PropertyGroup, setting: str) -> float:
    """Seconds from a change of a setting to the target that shows it."""
    taken = []
    for value in np.linspace(0.9, 0.5, ROUNDS).tolist():
        start = perf_counter()
        setattr(group, setting, value)
        taken.append(perf_counter() - start)
    setattr(group, setting, 1.0)
    return min(taken)


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
