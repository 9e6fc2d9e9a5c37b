"""The live preview."""

from collections.abc import Iterable

from bpy.types import Context, Panel, PropertyGroup, UILayout, UIList

from ..facial_retarget_addon.preview_state import COLUMNS, STATE, strengths
from ..facial_retarget_addon.translations import filled, told
from .tab import RetargetTab, draw_text


class FACIAL_RETARGET_PT_preview(RetargetTab, Panel):
    """The target follows the source live."""

    bl_label = "Live Preview"
    bl_parent_id = "FACIAL_RETARGET_PT_retarget"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        if not STATE.on:
            layout.operator("facial_retarget.start_preview", icon="HIDE_ON")
            return
        row = layout.row(align=True)
        row.operator("facial_retarget.stop_preview", icon="HIDE_OFF", depress=True)
        row.operator("facial_retarget.start_preview", text="", icon="FILE_REFRESH")
        for text in (STATE.trouble, STATE.stale):
            if text:
                draw_text(layout, context, told(text), icon="ERROR")
        layout.label(text=filled("{milliseconds:.1f} ms a frame", milliseconds=STATE.milliseconds), icon="TIME")


class FACIAL_RETARGET_PT_compare(RetargetTab, Panel):
    """The methods side by side, in numbers and on the target."""

    bl_label = "Compare"
    bl_parent_id = "FACIAL_RETARGET_PT_retarget"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        task = context.scene.facial_retarget
        layout.column(align=True).prop(task, "compared")
        row = layout.row(align=True)
        row.operator("facial_retarget.compare", icon="VIEWZOOM")
        row.prop(task, "compared_frames")
        if STATE.rows:
            _draw_cells(layout, COLUMNS)
        for shown in STATE.rows:
            button = layout.operator(
                "facial_retarget.show_method",
                text=layout.enum_item_name(task, "method", shown.method),
                depress=STATE.on and task.method == shown.method,
            )
            button.method = shown.method
            _draw_cells(layout, shown.cells, translate=False)


def _draw_cells(layout: UILayout, cells: Iterable[str], translate: bool = True) -> None:
    """One row of short texts, all as wide."""
    row = layout.grid_flow(row_major=True, columns=len(COLUMNS), even_columns=True, align=True)
    for cell in cells:
        row.label(text=cell, translate=translate)


class FACIAL_RETARGET_UL_masks(UIList):
    """Painted masks, each with its gain."""

    def draw_item(
        self, context: Context, layout: UILayout, data: PropertyGroup, item: PropertyGroup, icon: int, active: object
    ) -> None:
        """Draw a row."""
        row = layout.row(align=True)
        row.prop(item, "name", text="", icon="GROUP_VERTEX", emboss=False, translate=False)
        row.prop(item, "gain", text="")


class FACIAL_RETARGET_PT_gains(RetargetTab, Panel):
    """How strong the motion is: by level, by region, and by painted masks."""

    bl_label = "Gains"
    bl_parent_id = "FACIAL_RETARGET_PT_retarget"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        task = context.scene.facial_retarget
        column = layout.column(align=True, heading="Regions")
        for name in type(task.regions).__annotations__:
            column.prop(task.regions, name, slider=True)
        layout.label(text="Painted Masks")
        row = layout.row()
        row.template_list("FACIAL_RETARGET_UL_masks", "", task, "masks", task, "active_mask", rows=2)
        column = row.column(align=True)
        column.operator("facial_retarget.add_mask", text="", icon="ADD")
        column.operator("facial_retarget.remove_mask", text="", icon="REMOVE")
        if task.target is not None and len(task.masks):
            layout.prop_search(task.masks[task.active_mask], "name", task.target, "vertex_groups")
        column = layout.column(align=True)
        for name in strengths(task.method):
            column.prop(getattr(task, task.method), name)
