"""Motion files onto a face: as curves of its controls or named shape keys, of a shape key per channel, or as frames."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from bpy.types import Context, Object

from ...core.arrays import Progress
from ...core.mpeg4.arkit import ARKIT_NAMES
from ...core.mpeg4.arkit_take import ArkitTake
from ...core.mpeg4.conversions import low_level
from ...core.mpeg4.faps import HEAD_TURNS
from ...files.motion.read import read_motion
from ...files.motion.stream import stream_of_motion
from ..background import Steps, in_thread, part
from ..performance import scene_rate
from .arkit_keys import find_arkit_halves, find_arkit_keys
from .controls import has_controls
from .fap_faces import fit_steps
from .head_empty import write_head
from .motion_curves import MOTION, clear_motion
from .motion_ways import Take, controls_steps, frames_steps, points_steps

WAYS = {"CONTROLS": controls_steps, "POINTS": points_steps, "FRAMES": frames_steps}


@dataclass(frozen=True)
class ImportOptions:
    """How a motion file is to be imported.

    Attributes
    ----------
    path : .fap, .csv (ARKit weights or markers), .trc, .c3d or .bvh.
    way : CONTROLS, POINTS or FRAMES.
    start : scene frame of the first frame of the file.
    head : EMPTY turns an empty as the head turns, LEAVE leaves that motion out.
    missing : what FAPs that a frame does not use do, "hold" or "zero".
    gaps : what becomes of markers that were hidden, "fill" or "refuse".
    marker_map : which marker sits on which point; None to read it off the markers' names.
    fps : frames a second of a table that does not tell them, or None.
    set_rate : whether the scene takes over the file's rate.
    set_range : whether the scene's range becomes that of the motion.
    """

    path: Path
    way: str
    start: int
    head: str
    missing: str
    gaps: str
    marker_map: Path | None
    fps: float | None
    set_rate: bool
    set_range: bool


@dataclass(frozen=True)
class Imported:
    """What was imported: frames of the file, the last scene frame, and sentences that an artist should read."""

    count: int
    last: float
    warnings: list[str]


def import_motion_steps(context: Context, thing: Object, options: ImportOptions) -> Steps[Imported]:
    """Import a motion file onto a face. An earlier import is replaced, other keys and curves stay.

    Closing the steps at any time leaves everything as it was: it is written at the very end.

    Raises
    ------
    RetargetError : for a file, points or shape keys that cannot be used.
    """
    scene = context.scene
    take = yield from part(_read_steps(options, scene_rate(scene)), 0.0, 0.2)
    face = None
    if options.head == "EMPTY" or options.way != "CONTROLS" or _needs_face(thing, take):
        face = yield from part(fit_steps(thing), 0.2, 0.4)
    write = yield from part(WAYS[options.way](thing, face, take), 0.6, 0.3)
    yield 0.9, "Writing"
    clear_motion(thing)
    warnings = [*take.warnings, *write()]
    if options.head == "EMPTY":
        empty = write_head(thing, face, take.frames, take.values[:, HEAD_TURNS], MOTION)
        if "7.1" not in thing.facial_retarget.points:
            warnings.append(f"{empty.name!r} turns about where the average face has its point 7.1: this face has none")
    if options.set_rate:
        scene.render.fps = max(round(take.fps), 1)
        scene.render.fps_base = scene.render.fps / take.fps
    if options.set_range:
        scene.frame_start, scene.frame_end = options.start, int(np.ceil(take.frames[-1]))
    scene.frame_set(scene.frame_current, subframe=scene.frame_subframe)
    return Imported(len(take.frames), float(take.frames[-1]), warnings)


def _read_steps(options: ImportOptions, scene_fps: float) -> Steps[Take]:
    def read(progress: Progress) -> Take:
        progress(0.1, f"Reading {options.path.name}")
        motion = read_motion(options.path, options.fps)
        stream, facts = stream_of_motion(motion, options.path, options.gaps, options.marker_map)
        values = low_level(stream, options.missing)
        step = 1.0 if options.set_rate else scene_fps / stream.fps
        return Take(motion, values, stream.fps, options.start + step * np.arange(len(values)), facts["warnings"])

    return (yield from in_thread(read))


def _needs_face(thing: Object, take: Take) -> bool:
    """Whether controls or named keys are missing, so that the points have to make them."""
    if isinstance(take.motion, ArkitTake):
        known = find_arkit_keys(thing).keys() | find_arkit_halves(thing).keys()
        return len(known) < len(ARKIT_NAMES) and len(thing.facial_retarget.points) > 0
    return not has_controls(thing)
