"""One retargeting task."""

from bpy.props import BoolProperty, CollectionProperty, EnumProperty, IntProperty, PointerProperty, StringProperty
from bpy.types import Object, PropertyGroup

from ..core.methods import METHODS
from ..translations import OURS
from .bakes import FACIAL_RETARGET_PG_bake
from .choices import is_mesh, label, tell
from .cloning import FACIAL_RETARGET_PG_cloning
from .examples import FACIAL_RETARGET_PG_example, FACIAL_RETARGET_PG_sculpting
from .export import FACIAL_RETARGET_PG_export
from .methods import METHOD_ITEMS, SETTINGS_GROUPS, FACIAL_RETARGET_PG_mask, FACIAL_RETARGET_PG_regions
from .normal_maps import FACIAL_RETARGET_PG_normal_maps, FACIAL_RETARGET_PG_wrinkle_kit
from .overlay import FACIAL_RETARGET_PG_overlay


class FACIAL_RETARGET_PG_task(PropertyGroup):
    """One retargeting task: the panel, and what a job file holds."""

    source: PointerProperty(
        name="Source", type=Object, poll=is_mesh, update=tell("faces"), description="The face that moves"
    )
    target: PointerProperty(
        name="Target", type=Object, poll=is_mesh, update=tell("faces"), description="The face that shall move"
    )
    source_neutral: EnumProperty(
        name="Neutral",
        description="How the source looks at rest",
        items=[
            ("BASIS", "Basis", "The source's neutral is its Basis, without modifiers"),
            ("FRAME", "Frame", "The source's neutral is how it looks at one frame: for caches and scans"),
        ],
    )
    neutral_frame: IntProperty(
        name="Neutral Frame", default=1, description="Scene frame at which the source is at rest"
    )
    use_scene_range: BoolProperty(name="Scene Range", default=True, description="Retarget the scene's frame range")
    frame_start: IntProperty(name="First Frame", default=1, description="First scene frame that is retargeted")
    frame_end: IntProperty(name="Last Frame", default=250, description="Last scene frame that is retargeted")
    base: PointerProperty(
        name="Base Mesh",
        type=Object,
        poll=is_mesh,
        description="A base mesh of your own: show the base mesh, change its triangles, choose it here",
    )
    mirror_points: BoolProperty(
        name="X Mirror", description="What you do with a point happens to its partner on the other half of the face too"
    )
    examples: CollectionProperty(type=FACIAL_RETARGET_PG_example)
    active_example: IntProperty(name="Active Example", description="The example that is chosen in the list")
    examples_checked: StringProperty(name="Checked", description="Tells the examples that the figures belong to")
    sculpting: PointerProperty(type=FACIAL_RETARGET_PG_sculpting)
    cloning: PointerProperty(type=FACIAL_RETARGET_PG_cloning)
    bake: PointerProperty(type=FACIAL_RETARGET_PG_bake)
    export: PointerProperty(type=FACIAL_RETARGET_PG_export)
    normal_maps: PointerProperty(type=FACIAL_RETARGET_PG_normal_maps)
    wrinkle_kit: PointerProperty(type=FACIAL_RETARGET_PG_wrinkle_kit)
    overlay: PointerProperty(type=FACIAL_RETARGET_PG_overlay)
    method: EnumProperty(
        name="Method",
        items=METHOD_ITEMS,
        description="How the motion is carried from face to face",
        update=tell("settings"),
    )
    compared: EnumProperty(
        name="Methods",
        items=[(name, label(name), text) for name, text in METHODS.items()],
        options={"ENUM_FLAG"},
        default=set(METHODS),
        description="The methods that are compared",
    )
    compared_frames: IntProperty(
        name="Frames", default=8, min=1, soft_max=50, description="How many frames of the range the figures come from"
    )
    regions: PointerProperty(type=FACIAL_RETARGET_PG_regions)
    masks: CollectionProperty(type=FACIAL_RETARGET_PG_mask, description="Painted masks of the target")
    active_mask: IntProperty(name="Active Mask", description="The mask that is chosen in the list")
    report: StringProperty(
        name="Report",
        subtype="FILE_PATH",
        description="Where to write the figures (.json)",
        translation_context=OURS,
    )
    page: StringProperty(name="Page", subtype="FILE_PATH", description="Where to write the page to look at (.html)")
    output: StringProperty(
        name="Frames", subtype="FILE_PATH", description="Where the command line writes the frames of a saved job"
    )


for _method, _group in SETTINGS_GROUPS.items():
    FACIAL_RETARGET_PG_task.__annotations__[_method] = PointerProperty(type=_group)


CLASSES = (FACIAL_RETARGET_PG_task,)
