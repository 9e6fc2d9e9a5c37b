"""What an object knows as a face."""

from bpy.props import BoolProperty, CollectionProperty, EnumProperty, IntProperty, PointerProperty, StringProperty
from bpy.types import Context, Object, PropertyGroup

from ..core.point_sets import POINT_SETS, next_point
from ..translations import OURS
from .cloning import FACIAL_RETARGET_PG_cloned_key
from .findings import FACIAL_RETARGET_PG_finding
from .kept_bakes import FACIAL_RETARGET_PG_kept_bake
from .parts import FACIAL_RETARGET_PG_part
from .points import POINT_LISTS, POINT_SET_ITEMS, FACIAL_RETARGET_PG_feature_point, FACIAL_RETARGET_PG_point_name


def _set_chosen(face: PropertyGroup, context: Context) -> None:
    """Propose what the other set has, and nothing that it does not have."""
    from ..bridge.points.point_prediction import update_predictions

    if face.id_data.type == "MESH":
        update_predictions(face.id_data)


def _has_stale_points(face: PropertyGroup) -> bool:
    from ..bridge.points.topology import has_stale_points

    return has_stale_points(face.id_data)


def _show_finding(face: PropertyGroup, context: Context) -> None:
    """Go to what was clicked in the list."""
    from ..bridge.reports.findings import show_finding

    show_finding(context.scene, face.id_data)


class FACIAL_RETARGET_PG_face(PropertyGroup):
    """What an object knows as a face."""

    points: CollectionProperty(type=FACIAL_RETARGET_PG_feature_point, description="Feature points that are placed")
    active_point: IntProperty(name="Active Feature Point", description="The feature point that is chosen in the list")
    proposals: CollectionProperty(
        type=FACIAL_RETARGET_PG_feature_point, description="Feature points that are predicted, and not placed"
    )
    active_proposal: IntProperty(name="Active Proposal", description="The proposal that is chosen in the list")
    active_skipped: IntProperty(name="Active Skipped Point", description="The skipped point that is chosen in the list")
    point_list: EnumProperty(name="List", items=POINT_LISTS, description="Which feature points the list shows")
    stale_points: BoolProperty(
        name="Mesh Has Changed",
        get=_has_stale_points,
        description="Vertices were added, removed or renumbered since the feature points were placed",
    )
    point_set: EnumProperty(
        name="Set",
        items=POINT_SET_ITEMS,
        default="FMC",
        description="Which feature points the face shall have",
        translation_context=OURS,
        update=_set_chosen,
    )
    skipped: CollectionProperty(
        type=FACIAL_RETARGET_PG_point_name, description="Feature points of the set that this face shall not have"
    )
    parts: CollectionProperty(type=FACIAL_RETARGET_PG_part)
    active_part: IntProperty(name="Active Part", description="The part of the head that is chosen in the list")
    cloned: CollectionProperty(type=FACIAL_RETARGET_PG_cloned_key)
    active_cloned: IntProperty(
        name="Active Cloned Shape Key", description="The cloned shape key that is chosen in the list"
    )
    findings: CollectionProperty(type=FACIAL_RETARGET_PG_finding, description="Frames and shape keys in trouble")
    active_finding: IntProperty(
        name="Active Finding",
        update=_show_finding,
        description="Click to go to the frame, or to set the shape key to 1",
    )
    findings_text: StringProperty(name="Findings", description="What was found, in words")
    findings_vertices: IntProperty(
        name="Vertices Then", description="How many vertices the object had when this was found"
    )
    findings_source: PointerProperty(name="Source Then", type=Object, description="The source of the baked frames")
    counterpart: StringProperty(
        name="Counterpart", description="The source's vertex for each of the head's vertices, packed"
    )
    shown_key: StringProperty(name="Shown Shape Key", description="The shape key that a click in the list has set to 1")
    head: PointerProperty(name="Head", type=Object, description="The empty that shows how the head turns")
    prepared_from: PointerProperty(name="Prepared From", type=Object, description="What this copy was prepared from")
    kept_bakes: CollectionProperty(type=FACIAL_RETARGET_PG_kept_bake, description="Earlier bakes that are kept")
    bake: StringProperty(name="Bake", description="The kind of the bake that the face plays; empty for none")

    @property
    def set_size(self) -> int:
        """Points that the face shall have: those of its set, but for those that are skipped."""
        return sum(info.name not in self.skipped for info in POINT_SETS[self.point_set])

    @property
    def placed_of_set(self) -> int:
        """How many of these are placed."""
        placed = set(self.points.keys()) - set(self.skipped.keys())
        return sum(info.name in placed for info in POINT_SETS[self.point_set])

    @property
    def placed_beyond(self) -> int:
        """How many others are placed."""
        return len(self.points) - self.placed_of_set

    @property
    def turn(self) -> str:
        """The name of the point whose turn it is to be placed; "" if none of the set is left."""
        return next_point(self.point_set, self.points.keys(), self.skipped.keys()) or ""


CLASSES = (FACIAL_RETARGET_PG_face,)
