"""Settings of the methods, made from their dataclasses, so that panel, job file and core agree."""

from dataclasses import Field, fields
from typing import Any

from bpy.props import EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, StringProperty
from bpy.types import PropertyGroup

from ..core.methods import METHODS
from ..core.methods.settings import MASK_GAIN, SETTINGS, RegionGains
from ..translations import OURS
from .choices import label, tell

LEVEL_GAINS = 6
"""Gains that the panel offers: as many as there can be levels."""


METHOD_ITEMS = [(name, label(name), text) for name, text in METHODS.items()]


def _property(setting: Field, tells: str) -> Any:
    """The Blender property of one setting; `tells` : what the live preview is told when it is changed."""
    limits = setting.metadata
    text = {"name": label(setting.name), "description": limits["help"], "update": tell(tells)}
    if isinstance(setting.default, str):
        items = [(choice, choice.capitalize(), limits["help"]) for choice in limits["choices"]]
        return EnumProperty(items=items, default=setting.default, translation_context=OURS, **text)
    text |= {"min": limits["low"], "max": limits["high"]}
    if isinstance(setting.default, tuple):
        return FloatVectorProperty(size=LEVEL_GAINS, default=(1.0,) * LEVEL_GAINS, **text)
    kind = IntProperty if isinstance(setting.default, int) else FloatProperty
    return kind(default=setting.default, **text)


def _settings_group(name: str, cls: type, tells: str) -> type[PropertyGroup]:
    """The property group of a dataclass of settings."""
    annotations = {setting.name: _property(setting, tells) for setting in fields(cls)}
    body = {"__doc__": cls.__doc__, "__module__": __name__, "__annotations__": annotations}
    return type(f"FACIAL_RETARGET_PG_{name}", (PropertyGroup,), body)


SETTINGS_GROUPS = {method: _settings_group(method, cls, "settings") for method, cls in SETTINGS.items()}
"""Method name -> the property group of its settings; on the scene's group it has the method's name."""


FACIAL_RETARGET_PG_regions = _settings_group("regions", RegionGains, "gains")


class FACIAL_RETARGET_PG_mask(PropertyGroup):
    """A vertex group of the target, painted to make the motion weaker or stronger."""

    name: StringProperty(name="Vertex Group", update=tell("masks"), description="A vertex group of the target")
    gain: FloatProperty(
        name="Gain",
        default=1.0,
        min=MASK_GAIN["low"],
        max=MASK_GAIN["high"],
        update=tell("gains"),
        description="Strength of the motion where the weight is 1; where it is 0, nothing changes",
    )


CLASSES = (
    *SETTINGS_GROUPS.values(),
    FACIAL_RETARGET_PG_regions,
    FACIAL_RETARGET_PG_mask,
)
