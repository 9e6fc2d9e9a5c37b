"""Facial Retarget, a Blender extension. Enabling it loads neither SciPy nor Embree: operators do when they run."""

from . import operators, panels
from .facial_retarget_addon import manual, preview_watch, properties, translations, viewport
from .facial_retarget_addon.bridge.points import geometry_watch

PARTS = (properties, geometry_watch, preview_watch, operators, viewport, panels, manual, translations)


def register() -> None:
    """Called by Blender when the extension is enabled."""
    for part in PARTS:
        part.register()


def unregister() -> None:
    """Called by Blender when the extension is disabled."""
    for part in reversed(PARTS):
        part.unregister()
