"""Shape keys that go from head to head."""

from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, StringProperty
from bpy.types import PropertyGroup

from .methods import METHOD_ITEMS

ACTOR_SETS = [
    ("arkit", "ARKit", "The 52 shapes that phones record"),
    ("visemes", "Visemes", "The mouth in speech: MPEG-4's 14"),
    ("expressions", "Expressions", "joy, sadness, anger, fear, disgust, surprise"),
]


EXISTING_KEYS = [
    ("KEEP", "Keep", "Shape keys of these names that move something stay as they are"),
    ("REPLACE", "Replace", "Shape keys of these names are made anew"),
    ("SUFFIX", "Number", "New shape keys whose name is taken get a number behind it"),
]


class FACIAL_RETARGET_PG_origin(PropertyGroup):
    """A shape key of the source that a cloned one comes from. `name` is inherited."""


class FACIAL_RETARGET_PG_cloned_key(PropertyGroup):
    """A shape key that was cloned onto an object. `name` is inherited."""

    origins: CollectionProperty(type=FACIAL_RETARGET_PG_origin)
    side: EnumProperty(
        name="Side",
        items=[
            ("WHOLE", "Whole", "Both sides"),
            ("LEFT", "Left Half", "The left side alone"),
            ("RIGHT", "Right Half", "The right side alone"),
        ],
        description="Which half of the source's shape key it is",
    )
    corrected: BoolProperty(
        name="Corrected", description="As you want it: Re-solve leaves it alone, and teaches the other keys by it"
    )
    shape: StringProperty(name="Shape", description="Fingerprint of the shape that was cloned, by which a change shows")
    note: StringProperty(name="Figures", description="What the report says of it")


class FACIAL_RETARGET_PG_cloning(PropertyGroup):
    """How shape keys are cloned from head to head."""

    donor: EnumProperty(
        name="From",
        description="Whose shape keys are cloned",
        items=[
            ("SOURCE", "Source", "The shape keys of the source chosen under Faces, and of its parts"),
            ("ACTOR", "Built-In Actor", "The shapes of the built-in actor; no source is needed, and nothing is added"),
        ],
    )
    actor_sets: EnumProperty(
        name="Sets",
        description="Which of the actor's shapes",
        items=ACTOR_SETS,
        options={"ENUM_FLAG"},
        default={"arkit"},
    )
    targets: EnumProperty(
        name="Onto",
        description="Which heads get the shape keys",
        items=[
            ("TARGET", "Target", "The target chosen under Faces"),
            ("SELECTED", "Selected Heads", "Every selected object with feature points, but for the source"),
        ],
    )
    keep: StringProperty(
        name="Keep",
        default="*",
        description="Which shape keys: patterns such as mouth* or *Left, with commas between",
    )
    drop: StringProperty(name="But Not", description="Which of these to leave out, as patterns with commas between")
    sides: EnumProperty(
        name="Sides",
        description="What becomes of shape keys with and without a side in their name",
        items=[
            ("AS_THEY_ARE", "As They Are", "Shape keys come as the source has them"),
            ("SPLIT", "Split", "Shape keys without a side in their name become a left and a right one"),
            ("MERGE", "Merge", "Left and right halves of what ARKit has as a whole become one"),
        ],
    )
    feather: FloatProperty(
        name="Soft Border",
        default=0.25,
        min=0.0,
        soft_max=1.0,
        description="How far left and right overlap on either side of the middle, in distances between the eyes",
    )
    arkit_names: BoolProperty(
        name="ARKit Names",
        description="Shape keys that stand for one of ARKit's get its name: eyeBlink_L, EyeBlinkLeft",
    )
    existing: EnumProperty(
        name="Existing Keys", items=EXISTING_KEYS, description="What becomes of shape keys that are there already"
    )
    copy_drivers: BoolProperty(name="Drivers", default=True, description="Copy the drivers of the shape keys")
    copy_animation: BoolProperty(name="Animation", default=True, description="Copy the animation of the shape keys")
    method: EnumProperty(
        name="Method",
        items=METHOD_ITEMS,
        default="motion_cloning",
        description="How the motion is carried from face to face",
    )


CLASSES = (
    FACIAL_RETARGET_PG_origin,
    FACIAL_RETARGET_PG_cloned_key,
    FACIAL_RETARGET_PG_cloning,
)
