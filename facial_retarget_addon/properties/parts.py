"""Objects that belong to a head."""

from bpy.props import EnumProperty, PointerProperty
from bpy.types import Object, PropertyGroup

from .choices import is_mesh

PART_ROLES = (
    *("left eyeball", "right eyeball", "upper teeth", "lower teeth", "gums", "tongue"),
    *("lashes", "brows", "moustache", "beard", "still"),
)
"""What an artist may call a part of a head: the names of `core.parts.kinds.NAMED_KINDS`, which loads NumPy."""


class FACIAL_RETARGET_PG_part(PropertyGroup):
    """An object that belongs to the head of a face: an eye, teeth, lashes."""

    thing: PointerProperty(
        name="Object", type=Object, poll=is_mesh, description="The object that is a part of the head"
    )
    role: EnumProperty(
        name="Role",
        description="What the part is, and so how it moves",
        items=[
            ("AUTO", "By Place", "What it is shows by where it lies on the head"),
            *((role, role.title(), f"Moves as {role} do" if role != "still" else "Never moves") for role in PART_ROLES),
        ],
    )


CLASSES = (FACIAL_RETARGET_PG_part,)
