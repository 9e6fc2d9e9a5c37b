"""Feature points on a face, and which of them it shall have."""

from bpy.app.translations import pgettext_iface
from bpy.props import BoolProperty, FloatVectorProperty, IntVectorProperty, StringProperty
from bpy.types import PropertyGroup

from ..core.point_sets import point_label, point_meaning


def _title(point: PropertyGroup) -> str:
    label = point_label(point.name)
    return label if label == point.name else f"{point.name}  {pgettext_iface(label)}"


def _meaning(point: PropertyGroup) -> str:
    meaning = point_meaning(point.name)
    return pgettext_iface(meaning[:1].upper() + meaning[1:])


class FACIAL_RETARGET_PG_feature_point(PropertyGroup):
    """A named place on the object's surface: three vertices and their weights. `name` is inherited."""

    title: StringProperty(name="Title", get=_title, description="Its name, and what a person calls it")
    meaning: StringProperty(name="Meaning", get=_meaning, description="Where on a face it lies")
    vertices: IntVectorProperty(name="Vertices", size=3, min=0, description="The vertices that hold the point")
    weights: FloatVectorProperty(
        name="Weights", size=3, default=(1.0, 0.0, 0.0), precision=4, description="How much of each vertex"
    )
    topology: StringProperty(
        name="Topology", description="The topology on which these vertices count, empty if it was never noted"
    )
    anchored: BoolProperty(name="Anchored", description="The anchor says where the point is when the topology changes")
    anchor: FloatVectorProperty(name="Anchor", size=3, subtype="XYZ", description="Its place on the mesh at rest")
    anchor_normal: FloatVectorProperty(
        name="Anchor Normal", size=3, subtype="XYZ", description="The surface's normal there"
    )
    doubt: StringProperty(name="Doubt", description="Why the point may be in the wrong place; empty if it is not")


class FACIAL_RETARGET_PG_point_name(PropertyGroup):
    """The name of a feature point that has no place. `name` is inherited."""

    title: StringProperty(name="Title", get=_title, description="Its name, and what a person calls it")
    meaning: StringProperty(name="Meaning", get=_meaning, description="Where on a face it lies")


POINT_SET_ITEMS = [
    ("MINIMAL", "Minimal", "15 points: the least from which a face can be driven"),
    ("FMC", "MPEG-4", "48 points of the MPEG-4 standard: all that motion cloning and FAPs need on the skin"),
    ("DENSE", "Dense", "124 points: those of MPEG-4 and more between them, for the hierarchical method's base mesh"),
]


POINT_LISTS = [
    ("PLACED", "Placed", "Feature points that the face has"),
    ("PROPOSED", "Proposed", "Feature points that are predicted, and count once they are accepted"),
    ("SKIPPED", "Skipped", "Feature points of the set that this face does without"),
]


CLASSES = (
    FACIAL_RETARGET_PG_feature_point,
    FACIAL_RETARGET_PG_point_name,
)
