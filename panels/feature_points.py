"""The feature points of the active face, and the base mesh made from them."""

from bpy.types import Context, Panel, PropertyGroup, UI_UL_list, UILayout, UIList

from ..facial_retarget_addon.translations import OURS, filled, told
from .tab import RetargetTab, Step, draw_text

LISTS = {"PLACED": ("points", "active_point"), "PROPOSED": ("proposals", "active_proposal")}
LISTS |= {"SKIPPED": ("skipped", "active_skipped")}
"""What the list shows -> the collection, and which of it is chosen."""

ICONS = {"points": "LAYER_ACTIVE", "proposals": "LAYER_USED", "skipped": "X"}


class FACIAL_RETARGET_UL_points(UIList):
    """A feature point: whether it is placed, doubtful, proposed or skipped, its name and what a person calls it."""

    def draw_item(
        self,
        context: Context,
        layout: UILayout,
        data: PropertyGroup,
        item: PropertyGroup,
        icon: int,
        active: PropertyGroup,
        active_name: str,
    ) -> None:
        """Draw a row."""
        row = layout.row(align=True)
        stored = next(collection for collection, chosen in LISTS.values() if chosen == active_name)
        doubtful = stored == "points" and item.doubt
        row.label(text=item.title, icon="ERROR" if doubtful else ICONS[stored], translate=False)
        if stored == "proposals":
            row.operator("facial_retarget.accept_point", text="", icon="CHECKMARK", emboss=False).name = item.name
        elif stored == "skipped":
            row.operator("facial_retarget.want_point", text="", icon="LOOP_BACK", emboss=False).name = item.name

    def filter_items(self, context: Context, data: PropertyGroup, collection: str) -> tuple[list[int], list[int]]:
        """By name and by what a person calls the point."""
        if not self.filter_name:
            return [], []
        items, bit = getattr(data, collection), self.bitflag_filter_item
        return UI_UL_list.filter_items_by_name(self.filter_name, bit, items, "title"), []


class FACIAL_RETARGET_PT_points(Step, Panel):
    """Feature points of the active object."""

    bl_label = "2. Feature Points"
    bl_order = 2
    step = "POINTS"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        thing = context.active_object
        if thing is None or thing.type != "MESH":
            layout.label(text="Select a face", icon="INFO")
            return
        face = thing.facial_retarget
        row = layout.row()
        row.label(text=thing.name, icon="MESH_DATA", translate=False)
        row.prop(face, "point_set", text="")
        counted = {"placed": face.placed_of_set, "wanted": face.set_size, "others": face.placed_beyond}
        text = (
            "{placed} of {wanted} placed, and {others} others" if face.placed_beyond else "{placed} of {wanted} placed"
        )
        layout.label(text=filled(text, **counted), translate=False)
        if face.stale_points:
            box = layout.box()
            draw_text(box, context, filled("The mesh has changed since the points were placed"), "ERROR")
            box.operator("facial_retarget.refresh_points", icon="FILE_REFRESH")
        layout.row(align=True).prop(face, "point_list", expand=True)
        _draw_list(layout, context, face)
        column = layout.column(align=True)
        column.operator("facial_retarget.guess_points", icon="VIEWZOOM")
        row = column.row(align=True)
        row.operator("facial_retarget.accept_points", icon="CHECKMARK")
        row.operator("facial_retarget.clear_proposals", text="", icon="X")
        column = layout.column(align=True)
        column.operator_menu_enum("facial_retarget.mirror_points", "which", icon="MOD_MIRROR")
        column.operator("facial_retarget.copy_points", icon="COPYDOWN")
        row = column.row(align=True)
        row.operator("facial_retarget.load_points", text="Load", text_ctxt=OURS, icon="IMPORT")
        row.operator("facial_retarget.save_points", text="Save", icon="EXPORT")


class FACIAL_RETARGET_PT_base(RetargetTab, Panel):
    """The base mesh that the points make."""

    bl_label = "Base Mesh"
    bl_parent_id = "FACIAL_RETARGET_PT_points"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.operator("facial_retarget.show_base")
        layout.prop(context.scene.facial_retarget, "base", text="Own Base")


def _draw_list(layout: UILayout, context: Context, face: PropertyGroup) -> None:
    """The points of one kind, and what the chosen one is."""
    collection, chosen = LISTS[face.point_list]
    row = layout.row()
    row.template_list("FACIAL_RETARGET_UL_points", face.point_list, face, collection, face, chosen, rows=6)
    if face.point_list == "PLACED":
        buttons = row.column(align=True)
        buttons.operator("facial_retarget.add_point", text="", icon="ADD")
        buttons.operator("facial_retarget.remove_point", text="", icon="REMOVE")
    stored, active = getattr(face, collection), getattr(face, chosen)
    if active in range(len(stored)):
        point = stored[active]
        if face.point_list == "PLACED" and point.doubt:
            draw_text(layout, context, filled("Doubtful: {why}", why=told(point.doubt)), "ERROR")
        elif point.meaning:
            draw_text(layout, context, point.meaning, "BLANK1")
