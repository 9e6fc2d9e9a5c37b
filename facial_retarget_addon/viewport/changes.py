"""Which objects look otherwise than before, or have other points: what is drawn of them is built anew only then."""

from __future__ import annotations

from itertools import count
from typing import Any

import bpy
import numpy as np
from bpy.app.handlers import persistent
from bpy.types import Object, bpy_prop_collection

_numbers = count(1)
_all = [0]
_own: dict[int, int] = {}


def look(thing: Object) -> int:
    """A number that is another one as soon as an object may look otherwise."""
    return max(_all[0], _own.get(thing.session_uid, 0))


def stored_points(points: bpy_prop_collection) -> tuple[Any, ...]:
    """All that a collection of points says, quick to compare."""
    vertices, weights = np.empty(3 * len(points), np.int32), np.empty(3 * len(points), np.float32)
    points.foreach_get("vertices", vertices)
    points.foreach_get("weights", weights)
    return (*points.keys(), vertices.tobytes(), weights.tobytes())


@persistent
def _note_updates(scene: Any, depsgraph: Any) -> None:
    for update in depsgraph.updates:
        if isinstance(update.id, Object) and (update.is_updated_geometry or update.is_updated_transform):
            _own[update.id.original.session_uid] = next(_numbers)


@persistent
def _note_all(*_: Any) -> None:
    _all[0] = next(_numbers)
    _own.clear()


_HANDLERS = (
    ("depsgraph_update_post", _note_updates),
    ("frame_change_post", _note_all),
    ("undo_post", _note_all),
    ("redo_post", _note_all),
    ("load_post", _note_all),
)


def register() -> None:
    """Listen to Blender."""
    for event, handler in _HANDLERS:
        getattr(bpy.app.handlers, event).append(handler)


def unregister() -> None:
    """Stop listening."""
    for event, handler in _HANDLERS:
        getattr(bpy.app.handlers, event).remove(handler)
