"""The ways in which motion gets onto a face.

Each computes what it needs, touching no Blender data but to read it, and gives back what writes all of it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from bpy.types import Object

from ...core.acting.expression_sets import expression_shapes
from ...core.acting.fap_face import FapFace
from ...core.arrays import FloatArray, Progress
from ...core.errors import RetargetError
from ...core.mpeg4.arkit import ARKIT_NAMES
from ...core.mpeg4.arkit_take import ArkitTake
from ...fap_controls import CONTROLS, REACH
from ...files.motion.read import Motion
from ...files.pages.fap_report import mute_warnings
from ..background import Steps, in_thread
from ..bakes.frames import write_frames
from ..curves import ensure_curves, remove_curves, write_curve
from ..shape_keys import ensure_key
from .arkit_keys import find_arkit_halves, find_arkit_keys
from .controls import Shapes, has_controls, shape_steps, shown_faps, write_controls
from .fap_faces import write_shapes
from .motion_curves import CHANNELS, MOTION, check_free, drive_keys

BLOCK = 16
"""Frames that are computed at once: what fits into the processor's cache."""
WHOLE = 1e-6
"""Scene frames by which the end of a motion may miss a whole one."""

Write = Callable[[], list[str]]
"""Writes what was prepared; returns sentences that an artist should read."""


@dataclass(frozen=True)
class Take:
    """What a file holds, and when.

    motion : as the file has it.
    values : (F, 68) as FAPs.
    fps : frames a second.
    frames : (F,) the scene frame of each.
    warnings : of the reading.
    """

    motion: Motion
    values: FloatArray
    fps: float
    frames: FloatArray
    warnings: list[str]


def controls_steps(thing: Object, face: FapFace | None, take: Take) -> Steps[Write]:
    """Curves of the FAP controls, which are made if the face has none; for ARKit weights, of their named shape keys."""
    if isinstance(take.motion, ArkitTake):
        return (yield from _named_steps(thing, face, take.motion, take.frames))
    numbers = [control.fap.number for control in CONTROLS]
    reached = np.abs(take.values[:, [number - 1 for number in numbers]]).max(axis=0)
    limits = np.array([REACH * control.full for control in CONTROLS])
    if (reached > limits).any():
        worst = int((reached / limits).argmax())
        raise RetargetError(
            f"FAP {numbers[worst]} reaches {reached[worst]:.0f}, but controls end at {limits[worst]}: "
            "import the motion as points or frames"
        )
    shapes: Shapes | None = None
    if not has_controls(thing):
        shapes = yield from shape_steps(face)

    def write() -> list[str]:
        if shapes is not None:
            write_controls(thing, shapes)
        bag = ensure_curves(thing, f"{thing.name} motion")
        remove_curves(bag, {control.path for control in CONTROLS})
        for control, most in zip(CONTROLS, reached, strict=True):
            if most > 0:
                write_curve(bag, control.path, take.frames, take.values[:, control.fap.number - 1], group=MOTION)
            elif control.name in thing:
                thing[control.name] = 0.0
        return mute_warnings(take.values, shown_faps(thing))

    return write


def _named_steps(thing: Object, face: FapFace | None, take: ArkitTake, frames: FloatArray) -> Steps[Write]:
    """Curves of the 52 named shape keys; those that are missing are made, if there is a face to make them from.

    Both halves of a shape without sides do what the whole would.
    """
    named, halves = find_arkit_keys(thing), find_arkit_halves(thing)
    missing = [name for name in ARKIT_NAMES if name not in named and name not in halves]
    if not named and face is None:
        raise RetargetError(
            f"object {thing.name!r} has no shape key with an ARKit name such as jawOpen, and no feature points to make "
            "one from"
        )
    check_free(thing, [*named.values(), *(key for pair in halves.values() for key in pair)])
    made: dict[str, FloatArray] = {}
    if missing and face is not None:
        made = yield from in_thread(lambda progress: expression_shapes(face, ("arkit",)))
    weights = dict(zip(ARKIT_NAMES, take.weights.T, strict=True))

    def write() -> list[str]:
        write_shapes(thing, {name: made[name] for name in missing if name in made})
        if face is not None:
            named.update({name: ensure_key(thing, name).name for name in missing})
        driven = {key: weights[name] for name, key in named.items()}
        driven |= {key: weights[name] for name, pair in halves.items() for key in pair}
        drive_keys(thing, driven, frames, MOTION)
        lost = [name for name in missing if name not in made and weights[name].any()]
        return [f"ARKit shapes that the take uses and the face cannot show: {', '.join(lost)}"] if lost else []

    return write


def points_steps(thing: Object, face: FapFace, take: Take) -> Steps[Write]:
    """A shape key and a curve for each channel of the face that the motion uses; at 1 it is where it goes farthest."""

    def compute(progress: Progress) -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
        values = face.channel_values(take.values)
        used = np.flatnonzero(values.any(axis=0))
        farthest = np.abs(values[:, used]).max(axis=0)
        neutral = face.mesh.vertices.astype(np.float32)
        shapes = neutral + farthest[:, None, None].astype(np.float32) * (face.channel_shapes()[used] - neutral)
        names = [face.channels[column] for column in used]
        curves = (values[:, used] / farthest).T
        return dict(zip(names, shapes, strict=True)), dict(zip(names, curves, strict=True))

    shapes, values = yield from in_thread(compute)
    check_free(thing, shapes)

    def write() -> list[str]:
        write_shapes(thing, shapes)
        drive_keys(thing, values, take.frames, CHANNELS)
        return mute_warnings(take.values, face.playable)

    return write


def frames_steps(thing: Object, face: FapFace, take: Take) -> Steps[Write]:
    """A shape key for each scene frame of the motion."""
    first, last = int(take.frames[0]), int(np.floor(take.frames[-1] + WHOLE))
    whole = np.arange(first, last + 1)
    values = np.stack([np.interp(whole, take.frames, column) for column in take.values.T], axis=1)
    frames = np.empty((len(whole), *face.mesh.vertices.shape), np.float32)

    def compute(progress: Progress) -> None:
        for start in range(0, len(whole), BLOCK):
            frames[start : start + BLOCK] = face.frames(values[start : start + BLOCK])
            progress(start / len(whole), f"Frame {start + 1} of {len(whole)}")

    yield from in_thread(compute)

    def write() -> list[str]:
        write_frames(thing, frames, first)
        return mute_warnings(take.values, face.playable)

    return write
