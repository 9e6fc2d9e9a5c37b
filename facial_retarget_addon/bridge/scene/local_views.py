"""3D views that show a face alone."""

import bpy
from bpy.types import Object


def show_with(made: Object, face: Object) -> None:
    """Show a new object only where its face is shown: Blender shows new ones in all views that show others alone."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            space = area.spaces.active
            if area.type == "VIEW_3D" and space.local_view is not None:
                made.local_view_set(space, face.local_view_get(space))
