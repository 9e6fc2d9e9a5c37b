"""What is drawn over the faces, in the 3D view's own overlay menu."""

from bpy.types import Context, Panel, UILayout

from .tab import RetargetTab


def draw_overlay(layout: UILayout, context: Context) -> None:
    """The choices, two in a row."""
    wanted = context.scene.facial_retarget.overlay
    grid = layout.grid_flow(row_major=True, columns=2, even_columns=True, align=True)
    grid.prop(wanted, "show_points")
    names = grid.row()
    names.active = wanted.show_points
    names.prop(wanted, "show_names")
    grid.prop(wanted, "show_base")
    grid.prop(wanted, "show_diagram")


class FACIAL_RETARGET_PT_overlay(Panel):
    """Feature points in the overlay menu."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "HEADER"
    bl_parent_id = "VIEW3D_PT_overlay"
    bl_label = "Facial Retarget"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        draw_overlay(self.layout, context)


class FACIAL_RETARGET_PT_shown(RetargetTab, Panel):
    """The same choices beside the feature points."""

    bl_parent_id = "FACIAL_RETARGET_PT_points"
    bl_label = "Show in View"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        draw_overlay(self.layout, context)
