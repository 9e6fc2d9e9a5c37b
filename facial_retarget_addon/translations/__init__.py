"""Texts in other languages: a package with TEXTS, SENTENCES and PHRASES and a line in LANGUAGES make a new one."""

import bpy
from bpy.app.translations import pgettext_iface

from . import de
from .sentences import Sentences

LANGUAGES = {"de_DE": de, "de": de}
"""What Blender calls a language, by its versions -> its texts."""

SENTENCES = {language: Sentences(texts.SENTENCES, texts.PHRASES) for language, texts in LANGUAGES.items()}
"""The same -> what is said with values filled in."""

OURS = "Facial Retarget"
"""A context for short words of which Blender's own translation means something else: `translation_context=OURS` of a
property, `text_ctxt=OURS` of a button. Everywhere else Blender's translation of a text comes before ours.
"""

CONTEXTS = ("*", "Operator", OURS)
"""Where Blender looks texts up: buttons of operators have a place of their own."""


def filled(text: str, **fields: object) -> str:
    """A text of the interface in the artist's language, with its fields filled in."""
    return pgettext_iface(text).format(**fields)


def told(sentence: str) -> str:
    """A sentence that has its values already, such as a RetargetError's or a warning, in the artist's language."""
    translations = bpy.app.translations
    language = SENTENCES.get(translations.locale) if bpy.context.preferences.view.use_translate_reports else None
    return sentence if language is None else language.told(sentence)


def register() -> None:
    """Let Blender's translation know our texts."""
    known = {
        language: {(context, english): text for english, text in texts.TEXTS.items() for context in CONTEXTS}
        for language, texts in LANGUAGES.items()
    }
    bpy.app.translations.register(__name__, known)


def unregister() -> None:
    """Take them away again."""
    bpy.app.translations.unregister(__name__)
