"""In German everything is German; in Japanese, where Blender names new things by itself, the work is the same."""

from pathlib import Path

import bpy
from drive import OUT, log, look, open_tab, override, still, wait
from stage import choose, clear, part

AS_GOOD = {
    "Solving",
    "Next",
    "Frames",
    "Regions",
    "Flip",
    "Up",
    "Update Scene Duration",
    "Frame",
    "Vertices",
    "Weights",
    "X Mirror",
    "Fit",
    "Pinned",
    "Gain",
    "Merge",
    "Left",
    "Detail Scale",
}
"""Texts that Blender has in German too, in words that are as good as ours, or are never drawn."""
CLEAR = {"Set", "At", "Sculpt", "Load", "Face", "Stretch", "Report", "Back", "Hold", "Track", "Paper", "Default"}
"""Texts by which Blender means something else: they are drawn in our own context."""


def speak(language: str) -> None:
    """Let Blender speak a language, and name new things in it."""
    view = bpy.context.preferences.view
    view.language = language
    for what in ("interface", "tooltips", "reports", "new_dataname"):
        setattr(view, f"use_translate_{what}", True)


def refused() -> str:
    """What the tooltip says of an operator that cannot run."""
    try:
        bpy.ops.facial_retarget.stop()
    except RuntimeError as error:
        return str(error)
    raise AssertionError("nothing is computed, and yet it can be stopped")


def material() -> bpy.types.Material:
    """A new one, with the nodes that Blender gives it."""
    made = bpy.data.materials.new("skin")
    if bpy.app.version < (5, 0, 0):
        made.use_nodes = True
    return made


def scenario():
    clear()
    speak("de_DE")
    yield from wait()
    translations, german = part("translations"), part("translations.de").TEXTS
    look_up = bpy.app.translations.pgettext_iface
    differ = {text for text, ours in german.items() if look_up(text, "*") != ours}
    log("in other words than ours:", sorted(differ))
    assert differ <= AS_GOOD | CLEAR, differ - AS_GOOD - CLEAR
    assert all(look_up(text, translations.OURS) == ours for text, ours in german.items())
    assert "Es wird nichts gerechnet" in refused(), refused()
    said = translations.told("object 'Kopf' is hidden, expected it visible to be sculpted; it is so")
    assert said == "Objekt 'Kopf' ist verborgen; zum Formen einblenden; it is so", said

    task, scene = bpy.context.scene.facial_retarget, bpy.context.scene
    with override():
        bpy.ops.facial_retarget.add_faces("EXEC_DEFAULT", target="child", points=True)
    target = task.target
    assert target.facial_retarget.points["9.3"].title == "9.3  Nasenspitze"
    assert target.facial_retarget.points["9.3"].meaning == "Nasenspitze"
    scene.frame_start, scene.frame_end = 40, 41
    choose(target)
    yield from look("FRONT")
    yield from open_tab()
    yield from still()

    speak("ja_JP")
    yield from wait()
    assert bpy.app.translations.pgettext_data("Cube") != "Cube", "new things are not named in Japanese"
    skin = material()
    assert all(not node.name.isascii() for node in skin.node_tree.nodes), [node.name for node in skin.node_tree.nodes]
    target.data.materials.clear()
    target.data.materials.append(skin)
    task.method = "hierarchical"
    task.normal_maps.folder, task.normal_maps.pixels = str(Path(OUT) / "maps"), 64
    with override():
        assert bpy.ops.facial_retarget.retarget("EXEC_DEFAULT") == {"FINISHED"}
        assert bpy.ops.facial_retarget.make_normal_maps("EXEC_DEFAULT") == {"FINISHED"}
    assert part("guide").is_baked(target, 40)
    shader = next(node for node in skin.node_tree.nodes if node.bl_idname == "ShaderNodeBsdfPrincipled")
    assert any(socket.identifier == "Normal" and socket.is_linked for socket in shader.inputs), "the map is not wired"
    speak("en_US")
    yield from wait()
