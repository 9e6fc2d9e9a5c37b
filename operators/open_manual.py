"""Open the manual."""

import bpy
from bpy.props import StringProperty
from bpy.types import Context, Operator

from ..facial_retarget_addon.manual import FOLDER
from ..facial_retarget_addon.translations import filled


class FACIAL_RETARGET_OT_open_manual(Operator):
    """Open this step's page of the manual, which ships with the extension, in the browser"""

    bl_idname = "facial_retarget.open_manual"
    bl_label = "Open Manual"

    page: StringProperty(name="Page", default="blender.html", description="Which page, and which place on it")

    @classmethod
    def poll(cls, context: Context) -> bool:
        """The pages are made when the extension is built."""
        if not FOLDER.is_dir():
            cls.poll_message_set(filled("The manual is part of the built extension, not of its sources"))
            return False
        return True

    def execute(self, context: Context) -> set[str]:
        """Hand it to the browser."""
        return bpy.ops.wm.url_open(url=f"{FOLDER.as_uri()}/{self.page}")
