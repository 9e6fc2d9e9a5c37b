"""Blender's translation knows our texts while the extension is enabled, buttons of operators among them."""

import bpy
from stage import disable, enable, part

enable()
german = part("translations.de").TEXTS
view = bpy.context.preferences.view
if "de_DE" in bpy.app.translations.locales or "de" in bpy.app.translations.locales:
    view.language = next(name for name in ("de_DE", "de") if name in bpy.app.translations.locales)
    view.use_translate_interface = True
    for english, text in german.items():
        assert bpy.app.translations.pgettext_iface(english, "*") == text, english
    assert bpy.app.translations.pgettext_iface("Retarget", "Operator") == german["Retarget"]
else:
    print("this Blender has no languages")
disable()
enable()
