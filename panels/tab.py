"""Where the panels stand, and what the steps of the work have in common."""

import blf
from bpy.types import Context, UILayout

from ..facial_retarget_addon import guide
from ..facial_retarget_addon.manual import STEPS

ICONS = {"DONE": "CHECKMARK", "NOW": "RADIOBUT_ON", "OPEN": "RADIOBUT_OFF"}
"""How far a step is -> the icon in its header."""

BESIDE_TEXT = 98
"""Pixels of the sidebar's width that are no room for a text beside an icon, at a scale of 1."""


class RetargetTab:
    """A panel in the Retarget tab of the 3D View's sidebar."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Retarget"

    @classmethod
    def poll(cls, context: Context) -> bool:
        """While something is being computed only the panel on top stands, with the button that stops it."""
        return not context.window_manager.facial_retarget.running


class WithManual(RetargetTab):
    """A panel whose header has a button that opens a page of the manual."""

    page = ""

    def draw_header_preset(self, context: Context) -> None:
        """Draw the button at the end of the header."""
        self.layout.operator("facial_retarget.open_manual", text="", icon="HELP", emboss=False).page = self.page


class Step(WithManual):
    """A panel that is one of `guide.STEPS`: its header shows how far the step is."""

    step = ""

    @property
    def page(self) -> str:
        """The step's page."""
        return STEPS[self.step]

    def draw_header(self, context: Context) -> None:
        """Draw the icon before the title."""
        self.layout.label(text="", icon=ICONS[guide.state(context, self.step)])


def draw_text(layout: UILayout, context: Context, text: str, icon: str = "NONE") -> None:
    """A text that is translated already, in as many lines as the sidebar's width asks for."""
    scale = context.preferences.system.ui_scale
    blf.size(0, scale * context.preferences.ui_styles[0].widget.points)
    column = layout.column(align=True)
    for line in lines(text, context.region.width - BESIDE_TEXT * scale):
        column.label(text=line, icon=icon, translate=False)
        icon = "BLANK1"


def lines(text: str, width: float) -> list[str]:
    """A text in lines of at most `width` pixels of the font that is set, broken between words."""
    found = [""]
    for word in text.split(" "):
        longer = f"{found[-1]} {word}".strip()
        if found[-1] and blf.dimensions(0, longer)[0] > width:
            found.append(word)
        else:
            found[-1] = longer
    return found
