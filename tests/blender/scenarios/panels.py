"""Every panel draws what is there: its properties, lists and operators exist, whatever is active."""

from types import SimpleNamespace

import bpy
from stage import NAME, donor_pair, empty_scene, part


class Recorder:
    """Stands for a layout: checks what a panel asks for."""

    def __getattr__(self, name: str) -> object:
        """Rows, columns and what else holds a layout."""
        return lambda *arguments, **options: self

    def prop(self, data: object, name: str, **options: object) -> None:
        """A property must be there."""
        assert name.startswith("[") or name in data.bl_rna.properties, (data, name)

    def operator(self, name: str, **options: object) -> object:
        """An operator must be there."""
        group, _, own = name.partition(".")
        return SimpleNamespace() if getattr(getattr(bpy.ops, group), own).get_rna_type() else None

    def operator_menu_enum(self, name: str, choice: str, **options: object) -> object:
        """An operator and its choices must be there."""
        group, _, own = name.partition(".")
        assert choice in getattr(getattr(bpy.ops, group), own).get_rna_type().properties, (name, choice)
        return SimpleNamespace()

    def template_list(self, kind: str, key: str, *lists: object, **options: object) -> None:
        """A list's collection and its active row must be there."""
        assert hasattr(bpy.types, kind), kind
        for data, name in (lists[:2], lists[2:4]):
            assert name in data.bl_rna.properties, (data, name)

    def panel(self, *arguments: object, **options: object) -> tuple["Recorder", "Recorder"]:
        """A panel in a panel."""
        return self, self


class InSidebar:
    """Stands for the context of a panel: in background there is neither a region nor a scale."""

    region = SimpleNamespace(width=260)
    preferences = SimpleNamespace(
        system=SimpleNamespace(ui_scale=1.0), ui_styles=[SimpleNamespace(widget=SimpleNamespace(points=11))]
    )

    def __getattr__(self, name: str) -> object:
        """Everything else is Blender's."""
        return getattr(bpy.context, name)


LISTS = {
    "PLACED": ("points", "active_point"),
    "PROPOSED": ("proposals", "active_proposal"),
    "SKIPPED": ("skipped", "active_skipped"),
}


def draw_all() -> None:
    """Draw all panels and all lists."""
    for panel in panels:
        shown = SimpleNamespace(layout=Recorder(), step=getattr(panel, "step", ""), page="")
        for draw in ("draw_header", "draw_header_preset", "draw"):
            if draw in dir(panel):
                getattr(panel, draw)(shown, InSidebar())
    face = bpy.data.objects["target"].facial_retarget
    for kind, data in (("parts", face), ("cloned", face), ("examples", task)):
        for item in getattr(data, kind):
            getattr(bpy.types, f"FACIAL_RETARGET_UL_{kind}").draw_item(
                None, bpy.context, Recorder(), data, item, 0, data
            )
    for shown in LISTS:
        face.point_list = shown
        stored, chosen = LISTS[shown]
        for item in getattr(face, stored):
            bpy.types.FACIAL_RETARGET_UL_points.draw_item(None, bpy.context, Recorder(), face, item, 0, face, chosen)


empty_scene()
panels = [kind for kind in bpy.types.Panel.__subclasses__() if kind.__module__.startswith(NAME)]
assert len(panels) > 10, panels
task = bpy.context.scene.facial_retarget
task.source, task.target = donor_pair()
tops = sorted((panel for panel in panels if "bl_parent_id" not in dir(panel)), key=lambda panel: panel.bl_order)
titles = [panel.bl_label for panel in tops]
steps = ["1. Faces", "2. Feature Points", "3. Examples", "4. Retarget", "5. Bake and Export", "6. Report"]
assert titles == ["Next", *steps, "More"], titles
for active in (None, task.source, task.target):
    bpy.context.view_layer.objects.active = active
    draw_all()
task.target.facial_retarget.parts.add().thing = task.source
points = part("bridge.points.points")
points.skip_point(task.target, "11.1")
points.remove_point(task.target, "2.1")
points.write_proposals(task.target, points.read_points(task.source).subset(["2.1"]))
task.target.facial_retarget.cloned.add().name = "joy"
bpy.ops.facial_retarget.create_examples()
bpy.ops.facial_retarget.sculpt_example(example="fear")
draw_all()
bpy.ops.facial_retarget.stop_sculpting()
for donor, sides in (("ACTOR", "SPLIT"), ("SOURCE", "MERGE")):
    task.cloning.donor, task.cloning.sides = donor, sides
    for method in ("hierarchical", "motion_cloning"):
        task.cloning.method = method
        draw_all()
bpy.context.view_layer.objects.active = None
bpy.ops.object.light_add()
draw_all()
