"""What is drawn over the faces."""

from bpy.props import BoolProperty, EnumProperty
from bpy.types import PropertyGroup

from ..translations import OURS


class FACIAL_RETARGET_PG_overlay(PropertyGroup):
    """What is drawn over the faces in the 3D views."""

    show_points: BoolProperty(
        name="Points",
        default=True,
        description="Show the feature points of source, target and the active face; names appear under the mouse",
    )
    show_names: BoolProperty(name="All Names", description="Show the names of all points that face the view")
    show_base: BoolProperty(
        name="Base Mesh",
        description="Show the triangles between the points on source and target; those that fold over stand out",
    )
    show_heat: BoolProperty(name="Heat Map", description="Show a figure of each vertex of the target as colour")
    heat: EnumProperty(
        name="Figure",
        translation_context=OURS,
        items=[
            ("STRETCH", "Stretch", "How many times its neutral length the most stretched edge at a vertex has"),
            ("BEYOND", "Beyond the Source", "Stretch over the source's at the same place; needs a retargeting"),
            (
                "MOTION",
                "Motion Difference",
                "How far a vertex is from where the source's motion, turned and scaled as the heads are, would take "
                "it; a method that fits other proportions differs on purpose. Needs a retargeting",
            ),
        ],
        description="What the colours of the heat map show",
    )
    show_diagram: BoolProperty(
        name="Diagram",
        default=True,
        description="While the feature-point tool is chosen, show in a corner of the view where the next point lies",
    )


CLASSES = (FACIAL_RETARGET_PG_overlay,)
