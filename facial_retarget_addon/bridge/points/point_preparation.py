"""Predictors made beside the work of the artist, so that no click waits for one."""

from __future__ import annotations

from threading import Thread

import bpy
from bpy.types import Object

from ...core.errors import RetargetError
from ...core.mesh import TriMesh
from ..meshes import neutral_mesh
from .point_prediction import Key, keep_predictor, kept_predictor, key_of, new_predictor, update_predictions

TICK = 0.05
"""Seconds between two looks at whether a predictor is made."""

_threads: dict[int, Thread] = {}


def prepare_predictions(thing: Object) -> None:
    """Begin to make an object's predictor, unless it is made or on its way. Returns at once."""
    if kept_predictor(thing) is not None or is_preparing(thing):
        return
    thread = Thread(target=_make, args=(thing.session_uid, key_of(thing), neutral_mesh(thing)), daemon=True)
    _threads[thing.session_uid] = thread
    thread.start()


def is_preparing(thing: Object) -> bool:
    """Whether the predictor of an object is on its way."""
    thread = _threads.get(thing.session_uid)
    return thread is not None and thread.is_alive()


def wait_until_prepared(thing: Object) -> None:
    """Wait for the predictor of an object that is on its way: sooner there than a second one would be."""
    if is_preparing(thing):
        _threads[thing.session_uid].join()


def update_when_prepared(thing: Object) -> None:
    """Update the proposals of an object at once, or as soon as its predictor is made."""
    if not is_preparing(thing):
        update_predictions(thing)
        return
    uid = thing.session_uid

    def look() -> float | None:
        found = next((other for other in bpy.data.objects if other.session_uid == uid), None)
        if found is None:
            return None
        if is_preparing(found):
            return TICK
        update_predictions(found)
        return None

    bpy.app.timers.register(look, first_interval=TICK)


def _make(uid: int, key: Key, mesh: TriMesh) -> None:
    """In the thread: nothing of Blender is touched."""
    try:
        predictor = new_predictor(mesh)
        predictor.prepare()
    except RetargetError:
        # The first prediction meets the same error, and tells the artist.
        return
    keep_predictor(uid, key, predictor)
