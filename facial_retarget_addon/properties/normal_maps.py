"""How normal maps and wrinkle kits are made."""

from math import radians

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty
from bpy.types import Object, PropertyGroup

from .choices import is_mesh


class Maps:
    """What maps are for, and how they are written."""

    light: EnumProperty(
        name="For",
        description="The mesh that the maps are for",
        items=[
            ("TARGET", "Target", "The target's own mesh, with its active UV map"),
            ("LEVEL", "Level", "A coarse level of the target's normal mesh, which becomes an object with its own UVs"),
        ],
    )
    level: IntProperty(name="Level", default=2, min=1, max=6, description="Level that the maps are for: 1 is coarsest")
    pixels: IntProperty(name="Size", default=1024, min=16, max=16384, description="Pixels along each side of a map")
    margin: IntProperty(
        name="Margin",
        default=8,
        min=0,
        soft_max=64,
        description="Pixels that the map goes on past the borders of the UVs",
    )
    depth: EnumProperty(
        name="Depth",
        description="What a picture file holds",
        items=[
            ("png16", "PNG, 16 Bits", "Fine enough for smooth skin"),
            ("png8", "PNG, 8 Bits", "Small files, as games use them"),
            ("exr", "OpenEXR", "Floats, as they were computed"),
        ],
    )
    convention: EnumProperty(
        name="Green",
        description="Which way green points in the pictures",
        items=[
            ("opengl", "Up (OpenGL)", "As Blender and OpenGL have it"),
            ("directx", "Down (DirectX)", "As DirectX has it"),
        ],
    )
    folder: StringProperty(name="Folder", subtype="DIR_PATH", description="Folder that the maps become; it is replaced")
    wire: BoolProperty(
        name="Show in Materials", default=True, description="Let the materials' Principled shaders show the maps"
    )


class FACIAL_RETARGET_PG_normal_maps(Maps, PropertyGroup):
    """How normal maps of the performance are made."""


class FACIAL_RETARGET_PG_wrinkle_kit(Maps, PropertyGroup):
    """How a wrinkle kit of the target's shape keys is made."""

    detail: EnumProperty(
        name="Wrinkles of",
        description="Where the wrinkles come from",
        items=[
            (
                "RETARGETED",
                "Retargeted Keys",
                "The finest level of the shapes that Cloning gives the target, by the method of step 4",
            ),
            ("OBJECT", "High-Poly Object", "A fine mesh in the target's place that has its shape keys, by their names"),
        ],
    )
    fine: PointerProperty(
        name="High-Poly",
        type=Object,
        poll=is_mesh,
        description="The fine mesh: it lies where the target does, and has shape keys of the same names",
    )
    least: FloatProperty(
        name="Least",
        subtype="ANGLE",
        default=radians(3.0),
        min=0.0,
        max=radians(90.0),
        description="Shape keys that turn no normal by this much get no map",
    )


CLASSES = (FACIAL_RETARGET_PG_normal_maps, FACIAL_RETARGET_PG_wrinkle_kit)
