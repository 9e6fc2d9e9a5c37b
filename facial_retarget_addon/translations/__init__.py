"""Texts of the interface in other languages: a module with TEXTS and a line in LANGUAGES make a new one."""

import bpy

from .de import TEXTS as GERMAN

LANGUAGES = {"de_DE": GERMAN, "de": GERMAN}
"""What Blender calls a language, by its versions -> English text -> text."""

CONTEXTS = ("*", "Operator")
"""Where Blender looks texts up: buttons of operators have a place of their own."""


def register() -> None:
    """Let Blender's translation know our texts."""
    known = {
        language: {(context, english): text for english, text in texts.items() for context in CONTEXTS}
        for language, texts in LANGUAGES.items()
    }
    bpy.app.translations.register(__name__, known)


def unregister() -> None:
    """Take them away again."""
    bpy.app.translations.unregister(__name__)
