"""The live preview: the target follows the source while the artist scrubs, plays, or drags sliders and bones.

A method is fitted once. From then on each change of the source's evaluated shape is taken to the target, into a shape
key that no file holds (`preview_keys`). Handlers are there while a preview is on; those for undo and redo stay until
another file is loaded, since a step back may bring back a scene in which the preview was on.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from time import perf_counter
from zlib import crc32

import bpy
import numpy as np
from bpy.types import Context, Depsgraph, Object, PropertyGroup, Scene

from ..core.arrays import FloatArray, IntArray, Progress
from ..core.errors import RetargetError
from ..core.gained_face import GainedFace
from ..core.methods.base import Retargeter
from ..core.methods.settings import Settings, without_strengths
from ..core.retarget import checked_fit
from ..preview_state import STATE
from .background import Steps, in_thread
from .gains import read_gains
from .heads import head_now, head_parts, read_head
from .key_sets import check_targets
from .meshes import from_face_space, read_positions
from .performance import check_visible
from .preview_keys import (
    add_preview_keys,
    held_in_files,
    keep_own_keys,
    remove_every_key,
    remove_preview_keys,
    write_preview,
)
from .settings import read_task_settings
from .shape_keys import PREVIEW_KEY, find_key
from .task import read_problem

CHECK = 0.5
"""Seconds between two looks at what the fit came from."""
PAUSE = 0.02
"""Seconds after a change of the method's strengths before they act, so that a drag does not queue up."""


@dataclass(eq=False)
class Preview:
    """A method fitted to the heads of a scene, and where its frames go.

    Attributes
    ----------
    scene : its `session_uid`: objects and scenes are looked up anew at each use, since undo replaces them.
    origin : what the fit came from; see `_origin`.
    starts : (n + 1,) the first vertex of each of the target's objects, and how many there are.
    to_own : (n, 3, 3) displacements in the head's coordinates to each object's own.
    rest : (Vt, 3) float32 the target's neutral, in the head's coordinates.
    gained : the gains of regions and masks. masks : weights (Vt,) of the masks as they were read.
    shown : (Vs, 3) the source as it was shown last; None where it must be shown again.
    moved : (1, Vt, 3) what the method made of it, without the gains.
    """

    scene: int
    origin: dict[str, int]
    method: str
    settings: Settings
    retargeter: Retargeter
    starts: IntArray
    to_own: FloatArray
    rest: FloatArray
    gained: GainedFace
    masks: dict[str, FloatArray]
    shown: FloatArray | None = None
    moved: FloatArray | None = None

    def update(self, scene: Scene, depsgraph: Depsgraph) -> None:
        """Show what the source does now."""
        start = perf_counter()
        STATE.trouble = ""
        try:
            frame = _source_now(scene.facial_retarget, depsgraph)
            if self.shown is not None and np.array_equal(frame, self.shown):
                return
            self.moved = self.retargeter.frames(frame[None])
            self.write(scene, depsgraph)
        except RetargetError as error:
            STATE.trouble = str(error)
            return
        self.shown = frame
        STATE.milliseconds = 1e3 * (perf_counter() - start)

    def adjust(self, scene: Scene) -> None:
        """Take over strengths of the method that have changed; the source is to be shown again."""
        settings = read_task_settings(scene.facial_retarget)
        if settings != self.settings and without_strengths(settings) == without_strengths(self.settings):
            self.retargeter, self.settings, self.shown = self.retargeter.adjusted(settings), settings, None

    def set_gains(self, scene: Scene) -> None:
        """Take over gains of regions and masks that have changed.

        Raises
        ------
        RetargetError : as `read_gains` and `GainedFace`.
        """
        task = scene.facial_retarget
        gains = read_gains(task, read_head(task.target) if self._new_masks(task) else None, self.masks)
        self.gained.set(gains)
        self.masks = {name: mask.weights for name, mask in gains.masks.items()}

    def _new_masks(self, task: PropertyGroup) -> bool:
        return any(mask.name not in self.masks for mask in task.masks)

    def write(self, scene: Scene, depsgraph: Depsgraph) -> None:
        """Show what the method has made, as strong as the gains say."""
        if self.moved is not None:
            things = _head(scene.facial_retarget.target)
            self._write(things, self.gained.scale(self.moved.copy())[0], depsgraph)

    def _write(self, things: Sequence[Object], positions: FloatArray, depsgraph: Depsgraph) -> None:
        """Show positions (Vt, 3) of the target's head."""
        counts = [len(thing.data.vertices) for thing in things]
        if counts != np.diff(self.starts).tolist():
            raise RetargetError("the target's vertices are not those that were fitted, expected a refresh")
        for row, (thing, first, last) in enumerate(zip(things, self.starts, self.starts[1:], strict=False)):
            if thing.mode == "EDIT" or find_key(thing, PREVIEW_KEY) is None:
                continue
            keep_own_keys(thing)
            if row == 0:
                own = from_face_space(thing, positions[first:last])
            else:
                moves = positions[first:last] - self.rest[first:last]
                own = read_positions(thing.data) + (moves @ self.to_own[row].T).astype(np.float32)
            write_preview(thing, own, depsgraph)


_preview: Preview | None = None
"""What is on, or was on last: a step of undo may turn it on again."""


def preview_steps(context: Context) -> Steps[None]:
    """Fit the task's method and let the target follow; a preview that is on is fitted anew.

    Closing the steps at any time leaves everything as it was.

    Raises
    ------
    RetargetError : for bad input; says what, and on which object.
    """
    global _preview
    fitted = yield from fit_steps(context)
    stop_preview()
    task = context.scene.facial_retarget
    add_preview_keys(_head(task.target))
    _preview = fitted
    _go_on()
    show_now(context)


def fit_steps(context: Context) -> Steps[Preview]:
    """Fit the task's method for a preview; nothing is changed.

    Raises
    ------
    RetargetError : as `preview_steps`.
    """
    scene, task = context.scene, context.scene.facial_retarget
    method, settings = task.method, read_task_settings(task)
    problem = read_problem(context)
    head = read_head(task.target)
    check_targets(_head(task.source), head.things)
    check_visible(_head(task.source), context.view_layer)
    origin = _origin(task)

    def compute(progress: Progress) -> tuple[Retargeter, GainedFace]:
        gained = GainedFace(problem.target, problem.gains)
        return checked_fit(method, problem, settings, progress), gained

    retargeter, gained = yield from in_thread(compute)
    return Preview(
        scene.session_uid,
        origin,
        method,
        settings,
        retargeter,
        head.starts,
        np.linalg.inv(head.linear),
        head.face.mesh.vertices.astype(np.float32),
        gained,
        {name: mask.weights for name, mask in problem.gains.masks.items()},
    )


def stop_preview() -> None:
    """Turn the preview off: the target is as it was before."""
    _halt()
    remove_every_key()


def show_now(context: Context) -> None:
    """Show the source's present shape again, whatever was shown."""
    if _preview is not None and STATE.on:
        _preview.shown = None
        _preview.update(context.scene, context.evaluated_depsgraph_get())


def check_origin() -> None:
    """Find out whether what the fit came from has changed since."""
    scene = _scene()
    if _preview is None or scene is None:
        return
    now = _origin(scene.facial_retarget)
    changed = [what for what, value in now.items() if value != _preview.origin[what]]
    stale = f"Changed since the fit: {', '.join(changed)}" if changed else ""
    if stale != STATE.stale:
        STATE.stale = stale
        _redraw()


# ---- what the fit came from ---------------------------------------------------------------------


def _origin(task: PropertyGroup) -> dict[str, int]:
    """A sum of each thing that a fit comes from, by what the artist calls it."""
    heads = [_head(task.source), _head(task.target)]
    return {
        "method": hash(task.method),
        "settings": hash(without_strengths(read_task_settings(task))),
        "meshes": hash(tuple(_mesh_sum(thing) for things in heads for thing in things)),
        "points": hash(tuple(_point_sum(thing) for things in heads for thing in things)),
        "parts": hash(tuple((part.thing, part.role) for things in heads for part in things[0].facial_retarget.parts)),
        "examples": hash(
            tuple(_key_sum(thing, example.name) for example in task.examples for things in heads for thing in things)
        ),
        "base mesh": 0 if task.base is None else _mesh_sum(task.base),
        "neutral": hash((task.source_neutral, task.neutral_frame)),
    }


def _mesh_sum(thing: Object) -> int:
    mesh = thing.data
    return crc32(read_positions(mesh), len(mesh.polygons))


def _point_sum(thing: Object) -> int:
    points = thing.facial_retarget.points
    return hash(tuple((point.name, *point.vertices, *point.weights) for point in points))


def _key_sum(thing: Object, name: str) -> int:
    key = find_key(thing, name)
    if key is None:
        return 0
    flat = np.empty(3 * len(key.points), np.float32)
    key.points.foreach_get("co", flat)
    return hash((name, crc32(flat)))


def _head(face: Object) -> tuple[Object, ...]:
    """A face and its parts."""
    return (face, *head_parts(face))


def _source_now(task: PropertyGroup, depsgraph: Depsgraph) -> FloatArray:
    """(V, 3) float32 the source's head as it looks now.

    Raises
    ------
    RetargetError : if it is hidden, or its vertices have changed in number.
    """
    things = _head(task.source)
    check_visible(things, depsgraph.view_layer)
    return head_now(things, depsgraph)


# ---- handlers -----------------------------------------------------------------------------------


def _scene() -> Scene | None:
    """The scene of the preview; None where it has none, or is no longer whole."""
    scene = next((one for one in bpy.data.scenes if _preview is not None and one.session_uid == _preview.scene), None)
    if scene is None:
        return None
    faces = scene.facial_retarget.source, scene.facial_retarget.target
    return scene if all(face is not None and scene in face.users_scene for face in faces) else None


def _on_frame(scene: Scene, depsgraph: Depsgraph) -> None:
    """The frame has changed: show it, in a render too."""
    if _preview is not None and scene.session_uid == _preview.scene and _still_there():
        _preview.update(scene, depsgraph)


def _on_update(scene: Scene, depsgraph: Depsgraph) -> None:
    """Something has changed: follow where it was the source. What is written here comes back in no further update."""
    if _preview is None or scene.session_uid != _preview.scene or not _still_there():
        return
    things = _head(scene.facial_retarget.source)
    changed = {
        update.id.original for update in depsgraph.updates if update.is_updated_geometry or update.is_updated_transform
    }
    if changed.intersection(things):
        _preview.update(scene, depsgraph)
    elif len(scene.facial_retarget.masks) and changed.intersection(_head(scene.facial_retarget.target)):
        # The artist may have painted; what is written here comes in no further update.
        _preview.masks = {}
        _gain_again()


def _still_there() -> bool:
    """Whether both faces are still in the scene; the preview is off if not."""
    if _scene() is None:
        stop_preview()
    return STATE.on


def _before_save(*_: object) -> None:
    """Take the key out of what is written."""
    scene = _scene()
    if scene is not None and STATE.on:
        things = _head(scene.facial_retarget.target)
        for thing in things:
            keep_own_keys(thing)
        # An object in Edit Mode holds its keys elsewhere; loading the file removes the one that it keeps.
        remove_preview_keys(thing for thing in things if held_in_files(thing) and thing.mode != "EDIT")


def _after_save(*_: object) -> None:
    """Put the key back."""
    scene = _scene()
    if scene is not None and STATE.on and _preview is not None:
        add_preview_keys(_head(scene.facial_retarget.target))
        _preview.shown = None
        _preview.update(scene, bpy.context.evaluated_depsgraph_get())


def _after_undo(*_: object) -> None:
    """A step of undo has taken the key away, or brought it back: the preview is off or on with it."""
    scene = _scene()
    target = None if scene is None else scene.facial_retarget.target
    if target is None or find_key(target, PREVIEW_KEY) is None:
        _halt()
    elif _preview is not None:
        _go_on()
        _preview.shown = None
        _preview.update(scene, bpy.context.evaluated_depsgraph_get())


def _before_load(*_: object) -> None:
    """The scene goes away."""
    global _preview
    _halt()
    _preview = STATE.forget = None
    _set_handlers(STAYING, False)


def _forget() -> None:
    """End it, for good."""
    stop_preview()
    _before_load()


WORKING: tuple[tuple[str, Callable[..., None]], ...] = (
    ("frame_change_post", _on_frame),
    ("depsgraph_update_post", _on_update),
    ("save_pre", _before_save),
    ("save_post", _after_save),
)
"""Handlers while a preview is on."""
STAYING: tuple[tuple[str, Callable[..., None]], ...] = (
    ("undo_post", _after_undo),
    ("redo_post", _after_undo),
    ("load_pre", _before_load),
)
"""Those that stay until another file is loaded."""


def _set_handlers(handlers: Sequence[tuple[str, Callable[..., None]]], there: bool) -> None:
    for name, handler in handlers:
        present = getattr(bpy.app.handlers, name)
        if there and handler not in present:
            present.append(handler)
        elif not there and handler in present:
            present.remove(handler)


def _go_on() -> None:
    """Follow from now on."""
    if _preview is None:
        return
    STATE.on, STATE.method, STATE.stale, STATE.trouble = True, _preview.method, "", ""
    STATE.listener, STATE.forget = _on_change, _forget
    _set_handlers((*WORKING, *STAYING), True)
    if not bpy.app.timers.is_registered(_tick):
        bpy.app.timers.register(_tick, first_interval=CHECK)
    _redraw()


def _halt() -> None:
    """Follow no longer; what is fitted is kept for a step of undo."""
    STATE.on, STATE.stale, STATE.trouble, STATE.listener = False, "", "", None
    _set_handlers(WORKING, False)
    for timer in (_tick, _adjust):
        if bpy.app.timers.is_registered(timer):
            bpy.app.timers.unregister(timer)
    _redraw()


def _tick() -> float:
    check_origin()
    return CHECK


def _on_change(what: str) -> None:
    """A property of the task has changed: faces end the preview, gains act at once, the rest after a drag."""
    if what == "faces":
        stop_preview()
    elif _preview is not None and what in ("gains", "masks"):
        if what == "masks":
            _preview.masks = {}
        _gain_again()
    elif bpy.app.background:
        _adjust()
    elif not bpy.app.timers.is_registered(_adjust):
        bpy.app.timers.register(_adjust, first_interval=PAUSE)


def _adjust() -> None:
    """Take over strengths of the method, or say that the fit is out of date."""
    scene = _scene()
    if _preview is not None and scene is not None and STATE.on:
        _preview.adjust(scene)
        _preview.update(scene, bpy.context.evaluated_depsgraph_get())
        check_origin()


def _gain_again() -> None:
    """Take over gains of regions and masks."""
    scene = _scene()
    if _preview is None or scene is None:
        return
    STATE.trouble = ""
    try:
        _preview.set_gains(scene)
        _preview.write(scene, bpy.context.evaluated_depsgraph_get())
    except RetargetError as error:
        STATE.trouble = str(error)


def _redraw() -> None:
    """Draw the panels again."""
    for manager in bpy.data.window_managers:
        for window in manager.windows:
            for area in window.screen.areas:
                if area.type == "VIEW_3D":
                    area.tag_redraw()
