"""Counts the changes of geometry, so that what was read of it can be kept until there is one. Loads nothing heavy."""

from __future__ import annotations

import bpy
from bpy.app.handlers import persistent
from bpy.types import Depsgraph, Scene

_changes = 0


def changes() -> int:
    """A number that is another one after any object's geometry may have changed."""
    return _changes


def changed() -> None:
    """Say that geometry has changed."""
    global _changes
    _changes += 1


@persistent
def _updated(scene: Scene, depsgraph: Depsgraph) -> None:
    """Shape keys that play change geometry at each frame, but not their own shapes."""
    playing = any(window.screen.is_animation_playing for window in bpy.context.window_manager.windows)
    if not playing and any(update.is_updated_geometry for update in depsgraph.updates):
        changed()


@persistent
def _stepped(*_: object) -> None:
    changed()


_HANDLERS = {"depsgraph_update_post": _updated, "undo_post": _stepped, "redo_post": _stepped, "load_post": _stepped}


def register() -> None:
    """Begin to count."""
    for name, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, name).append(handler)


def unregister() -> None:
    """Stop counting."""
    for name, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, name).remove(handler)
