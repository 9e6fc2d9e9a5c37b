"""The panel's wish for normal maps and wrinkle kits, as the core, a job and a folder know it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from bpy.types import PropertyGroup

from ...core.methods.settings import LEVELED, MapSettings, WrinkleSettings
from ...files.job import MapOutput
from ..paths import chosen_path


def map_settings(wish: PropertyGroup) -> MapSettings:
    """How the panel wants the maps."""
    level = wish.level if wish.light == "LEVEL" else 0
    return MapSettings(level, wish.pixels, wish.margin, wish.depth, wish.convention)


def map_folder(wish: PropertyGroup) -> Path:
    """The folder that the panel names, absolute.

    Raises
    ------
    RetargetError : as `chosen_path`.
    """
    return chosen_path(wish.folder, "folder", "normal maps", "Normal Maps")


def wrinkle_settings(wish: PropertyGroup) -> WrinkleSettings:
    """How the panel wants a wrinkle kit."""
    maps = map_settings(wish)
    level = maps.level if wish.detail == "RETARGETED" else 0
    least = round(float(np.degrees(wish.least)), 3)  # Blender keeps float32
    return WrinkleSettings(level, maps.pixels, maps.margin, maps.depth, maps.convention, least)


def job_kit(task: PropertyGroup, method: str) -> WrinkleSettings | None:
    """What a clone job says of wrinkle kits; None where the panel names no folder, or the method cannot make them."""
    wish = task.wrinkle_kit
    if not wish.folder or wish.detail == "OBJECT" or method not in LEVELED:
        return None
    return wrinkle_settings(wish)


def map_output(task: PropertyGroup) -> MapOutput | None:
    """What a job says of the maps; None where the panel names no folder, or the method has no levels."""
    if not task.normal_maps.folder or task.method not in LEVELED:
        return None
    return MapOutput(map_folder(task.normal_maps), map_settings(task.normal_maps))


def show_map_output(wish: PropertyGroup, output: MapOutput | None) -> None:
    """Let the panel say what a job says of the maps."""
    wish.folder = "" if output is None else str(output.folder)
    if output is None:
        return
    settings = output.settings
    wish.light = "LEVEL" if settings.level else "TARGET"
    wish.level = settings.level or wish.level
    wish.pixels, wish.margin = settings.pixels, settings.margin
    wish.depth, wish.convention = settings.depth, settings.convention
