"""The live preview: the target follows the source while the artist scrubs, plays, or drags sliders and bones.

Methods are fitted once. From then on each change of the source's evaluated shape is taken to the target, into a shape
key that no file holds (`preview_keys`). Handlers are there while a preview is on; those for undo and redo stay until
another file is loaded, since a step back may bring back a scene in which the preview was on.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import bpy
import numpy as np
from bpy.types import Context, Depsgraph, Object, Scene

from ...core.arrays import FloatArray, Progress, progress_part
from ...core.comparison import MethodFigures, compare_method
from ...core.errors import RetargetError
from ...core.gained_face import GainedFace
from ...core.problem import Problem
from ...core.retarget import checked_fit
from ...core.seams.gaps import SeamGaps
from ...preview_state import STATE, ComparedMethod
from ..background import Steps, in_thread, part
from ..heads import Head, read_head
from ..key_sets import check_targets
from ..performance import check_range, check_visible, each_frame, read_frame
from ..scene.redraw import redraw_views
from ..settings import read_method_settings
from ..shape_keys import PREVIEW_KEY, find_key
from ..task import frame_range, read_problem
from .preview_keys import add_preview_keys, held_in_files, keep_own_keys, remove_every_key, remove_preview_keys
from .preview_origin import origin_of, whole_head
from .preview_target import Fit, PreviewTarget

CHECK = 0.5
"""Seconds between two looks at what the fits came from."""
PAUSE = 0.02
"""Seconds after a change of the method's strengths before they act, so that a drag does not queue up."""
READING = 0.1
"""Share of a comparison's time that reading takes."""

_preview: PreviewTarget | None = None
"""What is on, or was on last: a step of undo may turn it on again."""


def preview_steps(context: Context) -> Steps[None]:
    """Fit the task's method and let the target follow; a preview that is on is fitted anew.

    Closing the steps at any time leaves everything as it was.

    Raises
    ------
    RetargetError : for bad input; says what, and on which object.
    """
    task = context.scene.facial_retarget
    method, settings = task.method, read_method_settings(task, task.method)
    problem, head = _read(context)
    origin = origin_of(task)

    def compute(progress: Progress) -> tuple[GainedFace, Fit]:
        gained = GainedFace(problem.target, problem.gains)
        return gained, Fit(settings, checked_fit(method, problem, settings, progress))

    gained, fit = yield from in_thread(compute)
    fits = _preview.fits if _preview is not None and _preview.origin == origin else {}
    _turn_on(context, _made(context.scene, origin, head, gained, problem, {**fits, method: fit}))


def compare_steps(context: Context) -> Steps[None]:
    """Fit the task's chosen methods, measure each on a sample of the frames, and let the target follow by one of them.

    Closing the steps at any time leaves everything as it was.

    Raises
    ------
    RetargetError : for bad input; says what, and on which object.
    """
    task = context.scene.facial_retarget
    settings = {name: read_method_settings(task, name) for name in sorted(task.compared)}
    if not settings:
        raise RetargetError("no method is chosen to be compared, expected one or more")
    problem, head = _read(context)
    origin = origin_of(task)
    frames = yield from part(_sample(context), 0.0, READING)

    def compute(progress: Progress) -> tuple[GainedFace, dict[str, Fit], dict[str, MethodFigures]]:
        gained, seams = GainedFace(problem.target, problem.gains), SeamGaps(problem)
        fits, figures = {}, {}
        for number, (name, own) in enumerate(settings.items()):
            share = progress_part(progress, number / len(settings), (number + 1) / len(settings))
            retargeter, figures[name] = compare_method(name, problem, own, frames, seams, share)
            fits[name] = Fit(own, retargeter)
        return gained, fits, figures

    gained, fits, figures = yield from part(in_thread(compute), READING, 1 - READING)
    if task.method not in fits:
        task.method = next(iter(fits))
    _turn_on(context, _made(context.scene, origin, head, gained, problem, fits))
    STATE.rows = [ComparedMethod(name, _cells(found)) for name, found in figures.items()]


def stop_preview() -> None:
    """Turn the preview off: the target is as it was before."""
    _halt()
    remove_every_key()


def check_origin() -> None:
    """Find out whether what the fit came from has changed since."""
    scene = _scene()
    if _preview is None or scene is None:
        return
    changed = _preview.changed(scene.facial_retarget)
    stale = f"Changed since the fit: {', '.join(changed)}" if changed else ""
    if stale != STATE.stale:
        STATE.stale = stale
        redraw_views()


def _read(context: Context) -> tuple[Problem, Head]:
    """The problem, and the target as it is now."""
    task = context.scene.facial_retarget
    problem, head = read_problem(context), read_head(task.target)
    check_targets(whole_head(task.source), head.things)
    check_visible(whole_head(task.source), context.view_layer)
    return problem, head


def _sample(context: Context) -> Steps[FloatArray]:
    """(F, Vs, 3) float32 the source at some frames, evenly out of the task's."""
    task, frames = context.scene.facial_retarget, frame_range(context)
    count = min(task.compared_frames, len(frames))
    chosen = [frames[round(i)] for i in np.linspace(0, len(frames) - 1, count)] if count else []
    check_range(frames)
    things: tuple[Object, ...] = whole_head(task.source)
    found: list[FloatArray] = []
    yield from each_frame(context.scene, chosen, lambda _, frame: found.append(read_frame(context, things, frame)))
    return np.stack(found)


def _made(
    scene: Scene, origin: dict[str, int], head: Head, gained: GainedFace, problem: Problem, fits: dict[str, Fit]
) -> PreviewTarget:
    masks = {name: mask.weights for name, mask in problem.gains.masks.items()}
    made = PreviewTarget(scene, origin, head, gained, masks)
    made.fits.update(fits)
    return made


def _turn_on(context: Context, made: PreviewTarget) -> None:
    """Let the target follow from now on."""
    global _preview
    stop_preview()
    add_preview_keys(whole_head(context.scene.facial_retarget.target))
    _preview = made
    _go_on()
    made.update(context.scene, context.evaluated_depsgraph_get())


def _cells(found: MethodFigures) -> tuple[str, ...]:
    """The figures as the panel shows them, in the order of `preview_state.COLUMNS`."""
    gaps = ("-" if gap is None else f"{gap:.1f}" for gap in (found.lip_gap, found.lid_gap))
    counts = (f"{count:.3g}" for count in (found.torn_edges, found.turned_triangles))
    return (*counts, *gaps, f"{found.fit_seconds:.1f}", f"{1e3 * found.frame_seconds:.1f}")


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
    things = whole_head(scene.facial_retarget.source)
    changed = {
        update.id.original for update in depsgraph.updates if update.is_updated_geometry or update.is_updated_transform
    }
    if changed.intersection(things):
        _preview.update(scene, depsgraph)
    elif len(scene.facial_retarget.masks) and changed.intersection(whole_head(scene.facial_retarget.target)):
        # The artist may have painted; what is written here comes in no further update.
        _preview.set_gains(scene, depsgraph, painted=True)


def _still_there() -> bool:
    """Whether both faces are still in the scene; the preview is off if not."""
    if _scene() is None:
        stop_preview()
    return STATE.on


def _before_save(*_: object) -> None:
    """Take the key out of what is written."""
    scene = _scene()
    if scene is not None and STATE.on:
        things = whole_head(scene.facial_retarget.target)
        for thing in things:
            keep_own_keys(thing)
        # An object in Edit Mode holds its keys elsewhere; loading the file removes the one that it keeps.
        remove_preview_keys(thing for thing in things if held_in_files(thing) and thing.mode != "EDIT")


def _after_save(*_: object) -> None:
    """Put the key back."""
    scene = _scene()
    if scene is not None and STATE.on and _preview is not None:
        add_preview_keys(whole_head(scene.facial_retarget.target))
        _show_again(scene)


def _after_undo(*_: object) -> None:
    """A step of undo has taken the key away, or brought it back: the preview is off or on with it."""
    scene = _scene()
    target = None if scene is None else scene.facial_retarget.target
    if target is None or find_key(target, PREVIEW_KEY) is None:
        _halt()
    elif _preview is not None:
        _go_on()
        _show_again(scene)


def _before_load(*_: object) -> None:
    """The scene goes away."""
    global _preview
    _halt()
    _preview = STATE.forget = None
    STATE.rows = []
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
    redraw_views()


def _halt() -> None:
    """Follow no longer; what is fitted is kept for a step of undo."""
    STATE.on, STATE.stale, STATE.trouble, STATE.listener = False, "", "", None
    _set_handlers(WORKING, False)
    for timer in (_tick, _adjust):
        if bpy.app.timers.is_registered(timer):
            bpy.app.timers.unregister(timer)
    redraw_views()


def _tick() -> float:
    """Look at what the fits came from; nobody changes it while the animation plays."""
    windows = [window for manager in bpy.data.window_managers for window in manager.windows]
    if not any(window.screen.is_animation_playing for window in windows):
        check_origin()
    return CHECK


def _show_again(scene: Scene) -> None:
    """Show the source's present shape whatever was shown; at the next change where another scene is at work."""
    if _preview is not None:
        _preview.forget_shown()
        if bpy.context.scene == scene:
            _preview.update(scene, bpy.context.evaluated_depsgraph_get())


def _on_change(what: str) -> None:
    """A property of the task has changed: faces end the preview, gains act at once, the rest after a drag."""
    if what == "faces":
        stop_preview()
    elif what in ("gains", "masks"):
        scene = _scene()
        if _preview is not None and scene is not None and bpy.context.scene == scene:
            _preview.set_gains(scene, bpy.context.evaluated_depsgraph_get(), painted=what == "masks")
    elif bpy.app.background:
        _adjust()
    elif not bpy.app.timers.is_registered(_adjust):
        bpy.app.timers.register(_adjust, first_interval=PAUSE)


def _adjust() -> None:
    """Take over strengths of the method, or say that the fit is out of date."""
    scene = _scene()
    if _preview is not None and scene is not None and STATE.on:
        _preview.adjust(scene.facial_retarget)
        _show_again(scene)
        check_origin()
