"""Shape keys of one head onto others."""

from bpy.types import Context, Panel, PropertyGroup, UILayout, UIList

from ..facial_retarget_addon.manual import CLONING
from ..facial_retarget_addon.translations import told
from .tab import RetargetTab, WithManual


class FACIAL_RETARGET_UL_cloned(UIList):
    """A cloned shape key, its figures, and whether it is corrected."""

    def draw_item(
        self, context: Context, layout: UILayout, data: object, item: PropertyGroup, icon: int, active: object
    ) -> None:
        """Draw a row."""
        row = layout.row(align=True)
        row.label(text=item.name, translate=False)
        row.label(text=told(item.note), translate=False)
        row.prop(item, "corrected", text="")


class FACIAL_RETARGET_PT_cloning(WithManual, Panel):
    """What to clone, onto what, and the button."""

    bl_label = "Clone Shape Keys"
    page = CLONING
    bl_parent_id = "FACIAL_RETARGET_PT_more"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        cloning = context.scene.facial_retarget.cloning
        layout.prop(cloning, "donor")
        if cloning.donor == "ACTOR":
            layout.row().prop(cloning, "actor_sets")
        layout.prop(cloning, "targets")
        column = layout.column(align=True)
        column.prop(cloning, "keep")
        column.prop(cloning, "drop")
        layout.prop(cloning, "sides")
        if cloning.sides == "SPLIT":
            layout.prop(cloning, "feather")
        layout.prop(cloning, "arkit_names")
        layout.prop(cloning, "existing")
        column = layout.column(heading="Copy", align=True)
        column.prop(cloning, "copy_drivers")
        column.prop(cloning, "copy_animation")
        layout.prop(cloning, "method")
        layout.operator("facial_retarget.clone_shapes", icon="SHAPEKEY_DATA")
        layout.operator("facial_retarget.add_actor", icon="ADD")
        layout.operator("facial_retarget.save_clone_job")


class FACIAL_RETARGET_PT_clone_settings(RetargetTab, Panel):
    """The settings of the method that clones."""

    bl_label = "Settings"
    bl_parent_id = "FACIAL_RETARGET_PT_cloning"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        task = context.scene.facial_retarget
        settings = getattr(task, task.cloning.method)
        for name in type(settings).__annotations__:
            layout.prop(settings, name)


class FACIAL_RETARGET_PT_cloned(RetargetTab, Panel):
    """The active head's cloned shape keys, the worst ones first."""

    bl_label = "Corrections"
    bl_parent_id = "FACIAL_RETARGET_PT_cloning"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        thing = context.active_object
        if thing is None or thing.type != "MESH" or not len(thing.facial_retarget.cloned):
            layout.label(text="Select a head with cloned shape keys", icon="INFO")
            return
        face = thing.facial_retarget
        layout.template_list("FACIAL_RETARGET_UL_cloned", "", face, "cloned", face, "active_cloned", rows=5)
        layout.operator("facial_retarget.find_corrected")
        layout.operator("facial_retarget.resolve_shapes", icon="FILE_REFRESH")
