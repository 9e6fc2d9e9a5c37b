"""What an artist handles and sees in the 3D view: the feature-point tool, and what is drawn over the faces."""

from . import changes, hover, overlay, tool

PARTS = (changes, hover, overlay, tool)


def register() -> None:
    """Add tools and drawing; what needs a window is left out where there is none."""
    for part in PARTS:
        part.register()


def unregister() -> None:
    """Take them off again."""
    for part in reversed(PARTS):
        part.unregister()
