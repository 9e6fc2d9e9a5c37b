"""What a retargeting or cloning found wrong, the worst first."""

from bpy.types import Context, Panel, PropertyGroup, UILayout, UIList

from ..facial_retarget_addon import guide
from ..facial_retarget_addon.translations import told
from .tab import Step, draw_text

ICONS = {"FRAME": "KEYFRAME", "KEY": "SHAPEKEY_DATA"}
"""Kind of a finding -> its icon."""


COLUMNS = (
    ("Torn", "TORN", "torn"),
    ("Turn", "TURNED", "turned"),
    ("Lip", "LIPS", "lip_gap"),
    ("Lid", "LIDS", "lid_gap"),
)
"""Heading of a column, the kind of trouble that it tells of, and the figure that stands in it."""
NAMES = 0.34
"""Share of a row that the name takes."""


class FACIAL_RETARGET_UL_findings(UIList):
    """A frame or shape key, and its figures; what is 0 stays empty."""

    def draw_item(
        self, context: Context, layout: UILayout, data: object, item: PropertyGroup, icon: int, active: object
    ) -> None:
        """Draw a row."""
        row = layout.split(factor=NAMES)
        name = item.name if item.kind == "KEY" else f"{item.frame:g}"
        row.label(text=name, icon=ICONS[item.kind], translate=False)
        figures = row.row()
        for *_, name in COLUMNS:
            value = round(getattr(item, name))
            figures.label(text=str(value) if value else "", translate=False)


class FACIAL_RETARGET_PT_report(Step, Panel):
    """Frames and shape keys in trouble, and where the figures go."""

    bl_label = "6. Report"
    bl_order = 6
    bl_options = {"DEFAULT_CLOSED"}
    step = "REPORT"

    def draw(self, context: Context) -> None:
        """Draw the panel."""
        layout = self.layout
        task = context.scene.facial_retarget
        thing = guide.found_face(context)
        if thing is None:
            layout.label(text="Retarget or clone first", icon="INFO")
        else:
            self._draw_findings(layout, context, thing.facial_retarget)
        column = layout.column(align=True)
        column.prop(task.overlay, "show_heat")
        figure = column.row()
        figure.active = task.overlay.show_heat
        figure.prop(task.overlay, "heat", text="")
        column = layout.column()
        column.use_property_split, column.use_property_decorate = True, False
        column.prop(task, "report")
        column.prop(task, "page")

    def _draw_findings(self, layout: UILayout, context: Context, face: PropertyGroup) -> None:
        draw_text(layout, context, f"{face.id_data.name}: {told(face.findings_text)}")
        if not len(face.findings):
            return
        headings = layout.split(factor=NAMES)
        headings.label(text="Worst")
        row = headings.row()
        for heading, *_ in COLUMNS:
            row.label(text=heading)
        layout.template_list("FACIAL_RETARGET_UL_findings", "", face, "findings", face, "active_finding", rows=5)
        row = layout.split(factor=NAMES)
        row.label(text="Select")
        row = row.row(align=True)
        for heading, kind, _ in COLUMNS:
            row.operator("facial_retarget.select_trouble", text=heading).kind = kind
