"""How a head is exported."""

from bpy.props import BoolProperty, EnumProperty
from bpy.types import PropertyGroup


class FACIAL_RETARGET_PG_export(PropertyGroup):
    """How a head is exported."""

    form: EnumProperty(
        name="Format",
        description="The format of the file",
        items=[
            ("GLTF", "glTF", "Shape keys and their animation, for engines and the web"),
            ("FBX", "FBX", "Shape keys and their animation, for engines and animation programs"),
            ("USD", "USD", "Shape keys and their animation, or moving vertices, for film pipelines"),
            ("ALEMBIC", "Alembic", "Moving vertices, whatever moves them, for film pipelines"),
        ],
    )
    points: BoolProperty(
        name="Moving Vertices",
        description="USD gets where the vertices are at each frame, whatever moves them, instead of shape keys",
    )


CLASSES = (FACIAL_RETARGET_PG_export,)
