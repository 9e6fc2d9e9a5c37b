"""The installed extension is enabled, and its tab shows."""

import bpy
from drive import buttons, open_tab, screenshot


def scenario():
    assert "bl_ext.user_default.facial_retarget" in bpy.context.preferences.addons
    yield from open_tab("Retarget")
    screenshot("tab")
    found = yield from buttons()
    assert any("facial_retarget.source" in what for what in found), found
