"""The panel's wish for normal maps, as the core, a job and a folder know it."""

from __future__ import annotations

from pathlib import Path

from bpy.types import PropertyGroup

from ...core.methods.settings import LEVELED, MapSettings
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
