"""What the retargeted frames become."""

from dataclasses import fields
from typing import Any

from bpy.props import EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty
from bpy.types import PropertyGroup

from ..core.methods.settings import BakeSettings
from ..guide import FRAME_NAMES
from .choices import label

BAKES = [
    ("frames", "Shape Keys", "A shape key per frame, each shown on its own frame: to edit and to mix"),
    ("absolute", "Absolute Shape Keys", "A shape key per frame, all on one curve: plays many times as fast"),
    ("compact", "Compact Shape Keys", "As few shape keys as the tolerance allows, each a region, with curves to edit"),
    ("rig", "Own Shape Keys", "Curves of the shape keys that the target has: your own sliders"),
    ("pc2", "PC2 Cache", "A file on disk that a Mesh Cache modifier plays: for long performances"),
    ("mdd", "MDD Cache", "The same, as older programs read it"),
    (
        "alembic",
        "Alembic Cache",
        "One file of all moved objects that other programs read, and a modifier that plays it",
    ),
    ("usd", "USD Cache", "The same as USD: .usdc, or .usd if you name it so"),
]


def _limits(name: str) -> dict[str, Any]:
    """Default, range and tooltip of a number of `BakeSettings`."""
    setting = next(setting for setting in fields(BakeSettings) if setting.name == name)
    limits = setting.metadata
    return {
        "name": label(name),
        "default": setting.default,
        "min": limits["low"],
        "max": limits["high"],
        "description": limits["help"],
    }


class FACIAL_RETARGET_PG_bake_how(PropertyGroup):
    """What the retargeted frames become: `core.methods.settings.BakeSettings`."""

    kind: EnumProperty(name="Bake As", description="What the frames become on the target", items=BAKES)
    tolerance: FloatProperty(precision=4, step=0.1, **_limits("tolerance"))
    smoothness: FloatProperty(**_limits("smoothness"))
    sparsity: FloatProperty(precision=3, step=0.1, **_limits("sparsity"))
    residual: IntProperty(**_limits("residual"))


class FACIAL_RETARGET_PG_bake(PropertyGroup):
    """What the retargeted frames become."""

    how: PointerProperty(type=FACIAL_RETARGET_PG_bake_how)
    step: FloatProperty(
        name="Step",
        default=1.0,
        min=0.05,
        soft_max=10.0,
        description="Scene frames from one baked frame to the next; below 1 for sub-frames",
    )
    pattern: StringProperty(
        name="Names",
        default=FRAME_NAMES,
        description="Names of the shape keys of frames: the frame's number stands in place of the #",
    )
    earlier: EnumProperty(
        name="Earlier Bake",
        description="What becomes of the bake that the target plays now",
        items=[
            ("replace", "Replace", "Its shape keys, curves and modifiers go"),
            ("keep", "Keep", "It stays, turned off: play it again below. A cache gets a file of its own"),
        ],
    )
    cache: StringProperty(name="Cache", subtype="FILE_PATH", description="File that the cache becomes")


CLASSES = (
    FACIAL_RETARGET_PG_bake_how,
    FACIAL_RETARGET_PG_bake,
)
