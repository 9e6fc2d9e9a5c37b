"""The methods' settings: property groups to dataclasses and back."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np
from bpy.types import PropertyGroup

from ..core.methods.settings import Settings, read_settings


def read_task_settings(task: PropertyGroup) -> Settings:
    """The settings of the task's method."""
    return read_method_settings(task, task.method)


def read_method_settings(task: PropertyGroup, method: str) -> Settings:
    """The settings that the panel has for a method."""
    group = getattr(task, method)
    values = {name: _plain(getattr(group, name)) for name in group.__annotations__}
    return read_settings(method, values, "the panel")


def write_task_settings(task: PropertyGroup, method: str, settings: Settings) -> None:
    """Choose a method and set its settings; gains that are not given are 1."""
    task.method = method
    group = getattr(task, method)
    for setting in fields(settings):
        value = getattr(settings, setting.name)
        if isinstance(value, tuple):
            size = len(getattr(group, setting.name))
            value = (value + (1.0,) * size)[:size]
        setattr(group, setting.name, value)


def _plain(value: Any) -> Any:
    """A property's value as plain data; Blender keeps float32, so 0.7 is read as the shortest number that means it."""
    if isinstance(value, float):
        return float(str(np.float32(value)))
    if isinstance(value, str | int):
        return value
    gains = [_plain(part) for part in value]
    while gains and gains[-1] == 1.0:
        gains.pop()
    return gains
