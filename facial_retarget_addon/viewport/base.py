"""The base mesh over both faces: worked out beside the drawing, drawn anew when the faces move."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import bpy
import numpy as np
from bpy.types import Context, Object, Scene
from gpu.types import GPUBatch

from ..bridge.scene.redraw import redraw_views
from ..core.errors import RetargetError
from .changes import look, stored_points
from .lines import line_batch, triangle_batch

REST = 0.3
"""Seconds that points must rest before the base mesh is worked out again."""
TURN = 0.02
"""Seconds between two looks at the thread that does it."""


@dataclass(eq=False)
class BaseLines:
    """What is known of the base mesh.

    Attributes
    ----------
    wanted, working : of what they are to be made, and of what the thread makes them now.
    steps : of the thread; None while it rests.
    lines : for each face, by the object's session.
    trouble : why there are none; "" where all is well.
    stamps : by the object's session, how it looked, and the state of its Basis then.
    batches : by the object's session, of what they were made, and what is drawn.
    """

    wanted: Any = None
    working: Any = None
    steps: Any = None
    lines: dict[int, Any] = field(default_factory=dict)
    trouble: str = ""
    stamps: dict[int, tuple[int, int]] = field(default_factory=dict)
    batches: dict[int, tuple[Any, GPUBatch, GPUBatch | None]] = field(default_factory=dict)


_base = BaseLines()


def forget() -> None:
    """Drop everything: another file is open."""
    global _base
    if _base.steps is not None:
        _base.steps.close()
    _base = BaseLines()


def trouble() -> str:
    """Why there is no base mesh; "" where all is well."""
    return _base.trouble


def lines_of(thing: Object) -> Any:
    """The base mesh on a face, as `SurfaceLines`; None if there is none."""
    return _base.lines.get(thing.session_uid)


def folded_names(thing: Object) -> frozenset[str]:
    """Points of base triangles that fold over on a face; none while the base mesh is not shown."""
    lines = lines_of(thing)
    return frozenset() if lines is None else lines.folded_names


def base_batches(context: Context, thing: Object) -> tuple[GPUBatch, GPUBatch | None] | None:
    """The lines of the base mesh on a face as it looks now, and the triangles that fold over; None if there are none.

    Where the points have changed since, new lines are begun to be worked out.
    """
    state = _state(context.scene)
    if state != _base.wanted:
        _begin(state)
    lines = lines_of(thing)
    if lines is None or lines.vertices.max() >= len(thing.data.vertices):
        return None
    made = _base.batches.get(thing.session_uid)
    if made is None or made[0] != (look(thing), id(lines)):
        made = _base.batches[thing.session_uid] = _batches(thing, context.view_layer.depsgraph, lines)
    return None if made[1] is None else made[1:]


def _state(scene: Scene) -> Any:
    """What the base mesh depends on, the scene's name first; None without two faces."""
    task = scene.facial_retarget
    if task.source is None or task.target is None or task.source == task.target:
        return None
    faces = [(_stamp(thing), *stored_points(thing.facial_retarget.points)) for thing in (task.source, task.target)]
    return (scene.name, *faces, None if task.base is None else _stamp(task.base))


def _stamp(thing: Object) -> tuple[int, int]:
    """An object and the state of its Basis, read only when something about the object has changed."""
    from ..bridge.points.base_lines import shape_stamp

    known = _base.stamps.get(thing.session_uid)
    if thing.data.is_editmode:  # the mesh is what it was before; it is read when Edit Mode is left
        return thing.session_uid, 0 if known is None else known[1]
    if known is None or known[0] != look(thing):
        known = _base.stamps[thing.session_uid] = (look(thing), shape_stamp(thing))
    return thing.session_uid, known[1]


def _begin(state: Any) -> None:
    """Want lines for a state, which are worked out once it has rested; what the thread does now is done first."""
    _base.wanted = state
    if _base.steps is None:
        if bpy.app.timers.is_registered(_go_on):
            bpy.app.timers.unregister(_go_on)
        bpy.app.timers.register(_go_on, first_interval=REST)


def _go_on() -> float | None:
    """A turn of the timer: begin, look at the thread, or take what it has made. Seconds to the next turn."""
    from ..bridge.background import in_thread
    from ..bridge.points.base_lines import base_lines_work

    made: tuple[dict[int, Any], str] = ({}, "")
    try:
        if _base.steps is None:
            _base.working = _base.wanted
            scene = None if _base.working is None else bpy.data.scenes.get(_base.working[0])
            if scene is not None:
                task = scene.facial_retarget
                if any(thing is not None and thing.data.is_editmode for thing in (task.source, task.target, task.base)):
                    return REST
                _base.steps = in_thread(base_lines_work(task))
        if _base.steps is not None:
            next(_base.steps)
            return TURN
    except StopIteration as done:
        made = (done.value, "")
    except RetargetError as error:
        made = ({}, str(error))
    except BaseException:
        _base.steps = None
        raise
    _base.steps, (_base.lines, _base.trouble) = None, made
    _base.batches.clear()
    redraw_views()
    return None if _base.wanted == _base.working else REST


def _batches(thing: Object, depsgraph: Any, lines: Any) -> tuple[Any, GPUBatch | None, GPUBatch | None]:
    from ..bridge.points.point_places import shown_vertices

    state = (look(thing), id(lines))
    vertices = shown_vertices(thing, depsgraph)
    if vertices is None:
        return state, None, None
    places = lines.places(vertices).astype(np.float32)
    folded = triangle_batch(places[lines.folded]) if len(lines.folded) else None
    return state, line_batch(places[lines.pieces]), folded
