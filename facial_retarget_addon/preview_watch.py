"""What is there for the live preview as long as the extension is enabled, without SciPy."""

import bpy

from .preview_state import STATE


@bpy.app.handlers.persistent
def _clean(*_: object) -> None:
    """Clean up a file that Blender saved by itself while a preview was on."""
    from .bridge.preview.preview_keys import remove_every_key

    remove_every_key()


def register() -> None:
    """Watch the files that are loaded."""
    bpy.app.handlers.load_post.append(_clean)


def unregister() -> None:
    """Watch no longer; a preview that is on ends."""
    bpy.app.handlers.load_post.remove(_clean)
    if STATE.forget is not None:
        STATE.forget()
