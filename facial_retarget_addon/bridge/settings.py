"""The methods' settings: property groups to dataclasses and back."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np
from bpy.types import PropertyGroup

from ..core.methods.settings import RegionGains, Settings, read_settings, read_values


def read_task_settings(task: PropertyGroup) -> Settings:
    """The settings of the task's method."""
    return read_method_settings(task, task.method)


def read_method_settings(task: PropertyGroup, method: str) -> Settings:
    """The settings that the panel has for a method."""
    return read_settings(method, _plain_values(getattr(task, method)), "the panel")


def read_group(cls: type[RegionGains], group: PropertyGroup) -> RegionGains:
    """A dataclass from the property group that was made from it."""
    return read_values(cls, _plain_values(group), "the panel")


def write_group(group: PropertyGroup, values: Settings | RegionGains) -> None:
    """Set a property group from the dataclass that it was made from; gains that are not given are 1."""
    for setting in fields(values):
        value = getattr(values, setting.name)
        if isinstance(value, tuple):
            size = len(getattr(group, setting.name))
            value = (value + (1.0,) * size)[:size]
        setattr(group, setting.name, value)


def write_task_settings(task: PropertyGroup, method: str, settings: Settings) -> None:
    """Choose a method and set its settings; gains that are not given are 1."""
    task.method = method
    write_group(getattr(task, method), settings)


def _plain_values(group: PropertyGroup) -> dict[str, Any]:
    # Of the class: in Python 3.14 an instance has no annotations.
    return {name: _plain(getattr(group, name)) for name in type(group).__annotations__}


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
