"""Drawing anew what Blender does not know to have changed."""

import bpy


def redraw_views() -> None:
    """Draw all 3D views and their sidebars again."""
    for manager in bpy.data.window_managers:
        for window in manager.windows:
            for area in window.screen.areas:
                if area.type == "VIEW_3D":
                    area.tag_redraw()
