"""The source's performance: an evaluated object, frame after frame."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

import bpy
import numpy as np
from bpy.types import Context, Object, Scene, ViewLayer

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from .background import Steps
from .heads import head_now, head_parts


@contextmanager
def frame_kept(scene: Scene) -> Iterator[None]:
    """Puts the scene back to its frame, whatever happens inside."""
    frame, subframe = scene.frame_current, scene.frame_subframe
    try:
        yield
    finally:
        scene.frame_set(frame, subframe=subframe)


def scene_rate(scene: Scene) -> float:
    """Frames a second of a scene."""
    return scene.render.fps / scene.render.fps_base


def is_shown(thing: Object, view_layer: ViewLayer) -> bool:
    """Whether nothing hides an object in the scene. That a 3D view shows others alone is no matter."""
    with bpy.context.temp_override(area=None):
        return thing.visible_get(view_layer=view_layer)


def check_visible(things: Sequence[Object], view_layer: ViewLayer) -> None:
    """RetargetError if an object is hidden: Blender does not evaluate it then."""
    for thing in things:
        if not is_shown(thing, view_layer):
            raise RetargetError(
                f"object {thing.name!r} is hidden, expected it visible: Blender evaluates nothing hidden"
            )


def read_frame(context: Context, things: Sequence[Object], frame: float) -> FloatArray:
    """(V, 3) float32 positions of a face and its parts at one frame, in face space; the scene is left at that frame.

    Raises
    ------
    RetargetError : if one is hidden (Blender does not evaluate it then), or its vertices change in number.
    """
    check_visible(things, context.view_layer)
    context.scene.frame_set(int(frame // 1), subframe=frame % 1)
    return head_now(things, context.evaluated_depsgraph_get())


def check_range(frames: Sequence[float]) -> None:
    """RetargetError if there is no frame."""
    if isinstance(frames, range) and not len(frames):
        raise RetargetError(f"the frame range ends at {frames.stop - 1} before it starts at {frames.start}")


def each_frame(scene: Scene, frames: Sequence[float], read: Callable[[int, float], None]) -> Steps[None]:
    """Call `read(i, frame)` for each frame, one at each step.

    The scene's frame is put back at the end, and when the steps are closed half-way.
    """
    with frame_kept(scene):
        for i, frame in enumerate(frames):
            read(i, frame)
            yield (i + 1) / len(frames), f"Reading frame {frame}"


def read_frames(context: Context, face: Object, frames: Sequence[float]) -> Steps[FloatArray]:
    """Read the performance of a face and its parts; returns (F, V, 3) float32 in face space.

    Raises
    ------
    RetargetError : as `check_range` and `read_frame`.
    """
    check_range(frames)
    things = (face, *head_parts(face))
    positions = np.empty((len(frames), sum(len(thing.data.vertices) for thing in things), 3), np.float32)

    def read(i: int, frame: float) -> None:
        positions[i] = read_frame(context, things, frame)

    yield from each_frame(context.scene, frames, read)
    return positions
