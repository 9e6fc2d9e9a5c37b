"""The method, its settings, the frames, and the button."""

from bpy.types import Context, Panel, UILayout

from ..facial_retarget_addon.bake_cost import CACHES, bake_cost
from ..facial_retarget_addon.translations import filled
from .tab import RetargetTab, Step, draw_text


class FACIAL_RETARGET_PT_retarget(Step, Panel):
    """Retarget and bake."""

    bl_label = "4. Retarget"
    bl_order = 4
    step = "RETARGET"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        task = context.scene.facial_retarget
        layout.prop(task, "method")
        layout.prop(task, "use_scene_range")
        if not task.use_scene_range:
            column = layout.column(align=True)
            column.prop(task, "frame_start", text="Frames")
            column.prop(task, "frame_end", text="to")
        button = layout.row()
        button.scale_y = 1.5
        button.operator("facial_retarget.retarget", icon="PLAY")


class FACIAL_RETARGET_PT_bake(RetargetTab, Panel):
    """What the frames become, and what that costs."""

    bl_label = "Bake"
    bl_parent_id = "FACIAL_RETARGET_PT_retarget"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        task = context.scene.facial_retarget
        bake = task.bake
        layout.prop(bake.how, "kind")
        for name in SETTINGS_OF.get(bake.how.kind, ()):
            layout.prop(bake.how, name)
        if bake.how.kind in ("frames", "absolute"):
            layout.prop(bake, "pattern")
        if bake.how.kind in CACHES:
            layout.prop(bake, "cache")
        layout.prop(bake, "step")
        layout.prop(bake, "earlier")
        if task.target is not None:
            draw_cost(layout, context)
            draw_bakes(layout, context)


SETTINGS_OF = {"compact": ("tolerance",), "rig": ("smoothness", "sparsity", "residual")}
"""Kind of a bake -> the settings that it has."""


def draw_cost(layout: UILayout, context: Context) -> None:
    """What the bake will cost."""
    task = context.scene.facial_retarget
    chosen = context.scene if task.use_scene_range else task
    frames = max(chosen.frame_end - chosen.frame_start + 1, 0)
    cost = bake_cost(task.bake.how.kind, len(task.target.data.vertices), frames, task.bake.step)
    if cost.disk:
        draw_text(layout, context, filled("{size:.0f} MB on disk", size=cost.disk), icon="DISK_DRIVE")
    else:
        draw_text(layout, context, filled("At most {size:.0f} MB in the file", size=cost.file), icon="FILE_BLEND")
    if cost.advice:
        draw_text(layout, context, filled(cost.advice), icon="ERROR")


def draw_bakes(layout: UILayout, context: Context) -> None:
    """The bake that the target plays, and the earlier ones that it keeps."""
    task = context.scene.facial_retarget
    face = task.target.facial_retarget
    kinds = {item.identifier: item.name for item in task.bake.how.bl_rna.properties["kind"].enum_items}
    column = layout.column(align=True)
    if face.bake:
        row = column.row(align=True)
        row.label(text=filled("Plays: {kind}", kind=filled(kinds[face.bake])), icon="PLAY", translate=False)
        row.operator("facial_retarget.remove_bake", text="", icon="X").number = 0
    for kept in face.kept_bakes:
        row = column.row(align=True)
        row.prop(kept, "name", text="")
        row.label(text=kinds[kept.kind])
        row.operator("facial_retarget.play_bake", text="", icon="PLAY").number = kept.number
        row.operator("facial_retarget.remove_bake", text="", icon="X").number = kept.number


class FACIAL_RETARGET_PT_settings(RetargetTab, Panel):
    """The settings of the chosen method."""

    bl_label = "Settings"
    bl_parent_id = "FACIAL_RETARGET_PT_retarget"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        task = context.scene.facial_retarget
        settings = getattr(task, task.method)
        for name in type(settings).__annotations__:
            layout.prop(settings, name)
        layout.operator("facial_retarget.show_levels")
