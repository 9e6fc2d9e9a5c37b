"""The manual that ships with the extension: which page tells of what, for Blender's Online Manual and our buttons."""

from pathlib import Path

import bpy

FOLDER = Path(__file__).resolve().parent.parent / "manual"
"""Where build_extension.py puts the pages."""

STEPS = {
    "FACES": "blender.html#1-faces",
    "POINTS": "blender.html#2-feature-points",
    "EXAMPLES": "blender.html#3-examples",
    "RETARGET": "blender.html#4-retarget",
    "EXPORT": "blender.html#5-bake-and-export",
    "REPORT": "blender.html#6-report",
}
"""Step of the work -> page and place."""

EXPORTING = "export.html#what-each-format-keeps"
WRINKLES = "wrinkle_kit.html#in-blender"
CLONING, MPEG4 = "blender.html#clone-shape-keys", "blender.html#mpeg-4-face"

_OPERATORS = {
    STEPS["POINTS"]: ("*point*", "*proposal*", "accept*", "start_placing", "*part", "*parts", "show_base"),
    STEPS["EXAMPLES"]: ("*example*", "rough_out*", "stop_sculpting"),
    STEPS["RETARGET"]: ("retarget", "*levels", "*preview*", "compare", "show_method", "*mask*", "stop"),
    WRINKLES: ("*wrinkle*",),
    STEPS["EXPORT"]: ("load_job", "save_job", "*maps*", "export_curves", "export_faps"),
    EXPORTING: ("prepare_export", "export_gltf", "export_fbx", "export_usd", "export_alembic"),
    CLONING: ("*clone*", "add_actor", "resolve*", "find_corrected"),
    MPEG4: ("*shapes", "*controls", "*motion"),
    STEPS["FACES"]: ("*",),
}
"""Page -> names of operators, as patterns; the first page that has one counts."""

_GROUPS = {
    STEPS["POINTS"]: ("face", "feature_point", "point*", "part"),
    STEPS["EXAMPLES"]: ("example*", "sculpting"),
    STEPS["RETARGET"]: ("hierarchical", "feature_points", "motion_cloning", "wavelet", "regions", "mask"),
    STEPS["EXPORT"]: ("normal_maps",),
    WRINKLES: ("wrinkle_kit",),
    EXPORTING: ("export",),
    CLONING: ("cloning", "cloned_key"),
    STEPS["FACES"]: ("*",),
}
"""Page -> names of property groups, as patterns."""


def manual_map() -> tuple[str, list[tuple[str, str]]]:
    """Where the pages lie, and which one tells of an operator or a property; Blender asks for names in lower case."""
    found = [
        *((f"bpy.ops.facial_retarget.{name}", page) for page, names in _OPERATORS.items() for name in names),
        *((f"bpy.types.facial_retarget_pg_{name}.*", page) for page, names in _GROUPS.items() for name in names),
    ]
    return f"{FOLDER.as_uri()}/", found


def register() -> None:
    """Let Blender's Online Manual find our pages."""
    bpy.utils.register_manual_map(manual_map)


def unregister() -> None:
    """Take them away again."""
    bpy.utils.unregister_manual_map(manual_map)
