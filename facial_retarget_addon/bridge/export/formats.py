"""Blender's exporters, with the settings that keep most of a head, found by reading back in Blender 4.5 to 5.2."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy

from ...core.errors import RetargetError
from ...export_losses import FORMATS
from ..exporter_files import is_complete

SUFFIXES = {"GLTF": (".glb",), "FBX": (".fbx",), "USD": (".usdc", ".usda", ".usd"), "ALEMBIC": (".abc",)}
"""Format -> suffixes of its files, the usual one first."""


def check_suffix(form: str, path: Path) -> None:
    """RetargetError if a path has none of its format's suffixes."""
    if path.suffix.lower() not in SUFFIXES[form]:
        raise RetargetError(
            f"{path} is no name for {FORMATS[form]}, expected one that ends in {' or '.join(SUFFIXES[form])}"
        )


def write_selected(form: str, place: Path, path: Path, first: int, last: int, samples: int, points: bool) -> None:
    """Let Blender's exporter write what is selected, over the scene's range.

    Parameters
    ----------
    place, path : where it is written, and where it will be in the end, for messages.
    first, last : scene frames. samples : of a frame; glTF and USD know whole frames of the scene only.
    points : USD with moving vertices instead of shape keys.

    Raises
    ------
    RetargetError : if the exporter fails; says what it said.
    """
    try:
        done = _call(form, str(place), first, last, samples, points)
    except RuntimeError as error:
        said = _said(error)
        raise RetargetError(
            f"{path} cannot be written: Blender's {FORMATS[form]} exporter has failed: {said}"
        ) from error
    if done != {"FINISHED"} or not place.is_file():
        raise RetargetError(f"{path} cannot be written: Blender's {FORMATS[form]} exporter has written nothing")
    if form in ("USD", "ALEMBIC") and not is_complete(place):
        raise RetargetError(
            f"{path} cannot be written: Blender's {FORMATS[form]} exporter did not get to its end; the disk may be full"
        )


def _said(error: RuntimeError) -> str:
    """What an exporter said at last; below a Python error Blender tells a place in its code."""
    lines = [line for line in str(error).splitlines() if line.strip() and not line.startswith("Location: ")]
    return lines[-1].removeprefix("Error: ")


def _call(form: str, path: str, first: int, last: int, samples: int, points: bool) -> set[str]:
    if form == "GLTF":
        # SCENE: one animation of all objects, as they are evaluated.
        scene: dict[str, Any] = {"export_animation_mode": "SCENE", "export_anim_scene_split_object": False}
        exact = {"export_optimize_animation_size": False, "use_active_scene": True}
        return bpy.ops.export_scene.gltf(filepath=path, use_selection=True, export_format="GLB", **scene, **exact)
    if form == "FBX":
        # One take of the scene: else there is one for each action of the file that would fit.
        takes = {"bake_anim_use_all_actions": False, "bake_anim_use_nla_strips": False}
        exact = {"bake_anim_simplify_factor": 0.0, "bake_anim_step": 1 / samples, "add_leaf_bones": False}
        kinds = {"MESH", "ARMATURE"}
        return bpy.ops.export_scene.fbx(filepath=path, use_selection=True, object_types=kinds, **takes, **exact)
    # As the viewport shows it, where rendering would subdivide more.
    seen = {"evaluation_mode": "VIEWPORT"}
    if form == "USD":
        skeletons = {"export_shapekeys": not points, "export_armatures": not points, "export_animation": True}
        names = {"allow_unicode": True, "export_textures_mode": "KEEP"}
        subdivided = {"export_subdivision": "TESSELLATE" if points else "IGNORE"}
        return bpy.ops.wm.usd_export(
            filepath=path, selected_objects_only=True, **skeletons, **names, **subdivided, **seen
        )
    rates = {"start": first, "end": last, "xsamples": samples, "gsamples": samples}
    whole = {"apply_subdiv": True, "vcolors": True}
    return bpy.ops.wm.alembic_export(filepath=path, selected=True, **rates, **whole, **seen)
