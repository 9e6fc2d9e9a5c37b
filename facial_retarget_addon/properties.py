"""Property groups: what the artist sets, kept in the .blend, and where it hangs.

The methods' settings are made from their dataclasses, so that panel, job file and core agree.
"""

from collections.abc import Callable
from dataclasses import Field, fields
from typing import Any

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    IntVectorProperty,
    PointerProperty,
    StringProperty,
)
from bpy.types import Context, Object, PropertyGroup, Scene, WindowManager

from .core.methods import METHODS
from .core.methods.settings import MASK_GAIN, SETTINGS, BakeSettings, RegionGains
from .core.point_sets import POINT_SETS, next_point, point_label, point_meaning
from .guide import FRAME_NAMES
from .preview_state import STATE

LEVEL_GAINS = 6
"""Gains that the panel offers: as many as there can be levels."""


def _is_mesh(_: PropertyGroup, candidate: Object) -> bool:
    return candidate.type == "MESH"


def _title(point: PropertyGroup) -> str:
    label = point_label(point.name)
    return label if label == point.name else f"{point.name}  {label}"


def _meaning(point: PropertyGroup) -> str:
    meaning = point_meaning(point.name)
    return meaning[:1].upper() + meaning[1:]


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


PART_ROLES = (
    *("left eyeball", "right eyeball", "upper teeth", "lower teeth", "gums", "tongue"),
    *("lashes", "brows", "moustache", "beard", "still"),
)
"""What an artist may call a part of a head: the names of `core.parts.kinds.NAMED_KINDS`, which loads NumPy."""


class FACIAL_RETARGET_PG_part(PropertyGroup):
    """An object that belongs to the head of a face: an eye, teeth, lashes."""

    thing: PointerProperty(
        name="Object", type=Object, poll=_is_mesh, description="The object that is a part of the head"
    )
    role: EnumProperty(
        name="Role",
        description="What the part is, and so how it moves",
        items=[
            ("AUTO", "By Place", "What it is shows by where it lies on the head"),
            *((role, role.title(), f"Moves as {role} do" if role != "still" else "Never moves") for role in PART_ROLES),
        ],
    )


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


POINT_LISTS = [
    ("PLACED", "Placed", "Feature points that the face has"),
    ("PROPOSED", "Proposed", "Feature points that are predicted, and count once they are accepted"),
    ("SKIPPED", "Skipped", "Feature points of the set that this face does without"),
]


def _set_chosen(face: PropertyGroup, context: Context) -> None:
    """Propose what the other set has, and nothing that it does not have."""
    from .bridge.points.point_prediction import update_predictions

    if face.id_data.type == "MESH":
        update_predictions(face.id_data)


def _has_stale_points(face: PropertyGroup) -> bool:
    from .bridge.points.topology import has_stale_points

    return has_stale_points(face.id_data)


def _show_finding(face: PropertyGroup, context: Context) -> None:
    """Go to what was clicked in the list."""
    from .bridge.reports.findings import show_finding

    show_finding(context.scene, face.id_data)


class FACIAL_RETARGET_PG_finding(PropertyGroup):
    """A baked frame or a cloned shape key that is in trouble. `name` is inherited."""

    kind: EnumProperty(
        name="Kind",
        items=[("FRAME", "Frame", "A baked frame"), ("KEY", "Shape Key", "A cloned shape key")],
        description="What is in trouble",
    )
    frame: FloatProperty(name="Frame", description="The scene frame")
    note: StringProperty(name="Figures", description="What is wrong, in words")
    trouble: FloatProperty(name="Trouble", description="All figures together, by which the worst come first")
    torn: IntProperty(name="Torn Edges", description="Edges stretched beyond 3 times where the source is calm")
    turned: IntProperty(name="Turned Triangles", description="Triangles that look inwards where the source's do not")
    lip_gap: FloatProperty(name="Lip Gap", description="More than the source's, in percent of the mouth's width")
    lid_gap: FloatProperty(name="Lid Gap", description="More than the source's, in percent of the eye's opening")
    torn_vertices: StringProperty(name="Torn Vertices", description="Vertices of the torn edges, packed")
    turned_vertices: StringProperty(name="Turned Vertices", description="Vertices of the turned triangles, packed")


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


EXAMPLE_STATES = [
    ("MISSING", "Missing", "The face has no shape key of this name", "X", 0),
    ("EMPTY", "Not Sculpted", "The shape key equals the Basis: the example is left out", "RADIOBUT_OFF", 1),
    ("SCULPTED", "Sculpted", "The shape key moves the face", "RADIOBUT_ON", 2),
]


class FACIAL_RETARGET_PG_example(PropertyGroup):
    """An example expression: the shape key of this name on both faces. `name` is inherited."""

    def _state(self, side: str) -> str:
        """What `bridge.example_states` says of the example."""
        from .bridge.examples.example_states import states_of

        state = states_of(self.id_data.facial_retarget).get(self.name)
        return "" if state is None else getattr(state, side)

    def _source_state(self) -> int:
        return _STATE_NUMBERS.get(self._state("source"), 0)

    def _target_state(self) -> int:
        return _STATE_NUMBERS.get(self._state("target"), 0)

    def _warning(self) -> str:
        return self._state("warning")

    def _checked(self) -> bool:
        from .bridge.examples.example_states import stamp_of

        task = self.id_data.facial_retarget
        return self.fit >= 0 and task.examples_checked == stamp_of(task)

    source_state: EnumProperty(
        name="On the Source", items=EXAMPLE_STATES, get=_source_state, description="How far the example is there"
    )
    target_state: EnumProperty(
        name="On the Target", items=EXAMPLE_STATES, get=_target_state, description="How far the example is there"
    )
    warning: StringProperty(name="Warning", get=_warning, description="What is wrong with the example")
    fit: FloatProperty(
        name="Fit", default=-1.0, description="Share of the example's motion that the method misses; -1 if not checked"
    )
    leave_one_out: FloatProperty(
        name="Without It",
        default=-1.0,
        description="Share of the example's motion that would be missing if only the others were known",
    )
    checked: BoolProperty(
        name="Checked", get=_checked, description="Whether its figures are those of the examples as they are now"
    )


_STATE_NUMBERS = {state[0]: state[-1] for state in EXAMPLE_STATES}


class FACIAL_RETARGET_PG_sculpting(PropertyGroup):
    """The example that is being sculpted, and what is to be as it was afterwards."""

    thing: PointerProperty(name="Object", type=Object, description="The object in Sculpt Mode")
    example: StringProperty(name="Example", description="Its name")
    side: StringProperty(name="Face", description="SOURCE or TARGET")
    before: PointerProperty(name="Active Object", type=Object, description="The object that was active before")
    key: StringProperty(name="Shape Key", description="The shape key that was active before")
    pinned: BoolProperty(name="Pinned", description="Whether it alone was shown before")


def _tell(what: str) -> Callable[[PropertyGroup, Context], None]:
    """Tells the live preview that a property was changed: its faces, or settings."""
    return lambda _, __: STATE.tell(what)


def _label(name: str) -> str:
    """A name of the core as an artist reads it."""
    return name.replace("_", " ").title()


METHOD_ITEMS = [(name, _label(name), text) for name, text in METHODS.items()]


def _property(setting: Field, tells: str) -> Any:
    """The Blender property of one setting; `tells` : what the live preview is told when it is changed."""
    limits = setting.metadata
    text = {"name": _label(setting.name), "description": limits["help"], "update": _tell(tells)}
    if isinstance(setting.default, str):
        items = [(choice, choice.capitalize(), limits["help"]) for choice in limits["choices"]]
        return EnumProperty(items=items, default=setting.default, **text)
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

SETTINGS_GROUPS = {method: _settings_group(method, cls, "settings") for method, cls in SETTINGS.items()}
"""Method name -> the property group of its settings; on the scene's group it has the method's name."""

FACIAL_RETARGET_PG_regions = _settings_group("regions", RegionGains, "gains")


class FACIAL_RETARGET_PG_mask(PropertyGroup):
    """A vertex group of the target, painted to make the motion weaker or stronger."""

    name: StringProperty(name="Vertex Group", update=_tell("masks"), description="A vertex group of the target")
    gain: FloatProperty(
        name="Gain",
        default=1.0,
        min=MASK_GAIN["low"],
        max=MASK_GAIN["high"],
        update=_tell("gains"),
        description="Strength of the motion where the weight is 1; where it is 0, nothing changes",
    )


BAKES = [
    ("frames", "Shape Keys", "A shape key per frame, each shown on its own frame: to edit and to mix"),
    ("absolute", "Absolute Shape Keys", "A shape key per frame, all on one curve: plays many times as fast"),
    ("compact", "Compact Shape Keys", "As few shape keys as the tolerance allows, each a region, with curves to edit"),
    ("rig", "Own Shape Keys", "Curves of the shape keys that the target has: your own sliders"),
    ("pc2", "PC2 Cache", "A file on disk that a Mesh Cache modifier plays: for long performances"),
    ("mdd", "MDD Cache", "The same, as older programs read it"),
]


def _limits(name: str) -> dict[str, Any]:
    """Default, range and tooltip of a number of `BakeSettings`."""
    setting = next(setting for setting in fields(BakeSettings) if setting.name == name)
    limits = setting.metadata
    return {
        "name": _label(name),
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
    cache: StringProperty(name="Cache", subtype="FILE_PATH", description="File that the cache becomes")


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


class FACIAL_RETARGET_PG_normal_maps(PropertyGroup):
    """How normal maps of the performance are made."""

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


class FACIAL_RETARGET_PG_task(PropertyGroup):
    """One retargeting task: the panel, and what a job file holds."""

    source: PointerProperty(
        name="Source", type=Object, poll=_is_mesh, update=_tell("faces"), description="The face that moves"
    )
    target: PointerProperty(
        name="Target", type=Object, poll=_is_mesh, update=_tell("faces"), description="The face that shall move"
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
        poll=_is_mesh,
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
    normal_maps: PointerProperty(type=FACIAL_RETARGET_PG_normal_maps)
    overlay: PointerProperty(type=FACIAL_RETARGET_PG_overlay)
    method: EnumProperty(
        name="Method",
        items=METHOD_ITEMS,
        description="How the motion is carried from face to face",
        update=_tell("settings"),
    )
    compared: EnumProperty(
        name="Methods",
        items=[(name, _label(name), text) for name, text in METHODS.items()],
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
    report: StringProperty(name="Report", subtype="FILE_PATH", description="Where to write the figures (.json)")
    page: StringProperty(name="Page", subtype="FILE_PATH", description="Where to write the page to look at (.html)")
    output: StringProperty(
        name="Frames", subtype="FILE_PATH", description="Where the command line writes the frames of a saved job"
    )


class FACIAL_RETARGET_PG_work(PropertyGroup):
    """Long work that is under way: what the panel shows of it, and how its button stops it."""

    running: BoolProperty(name="Running", description="Whether something is being computed")
    stop: BoolProperty(name="Stop", description="Whether the artist has asked to stop")
    doing: StringProperty(name="Doing", description="What is being computed")
    share: FloatProperty(name="Share", min=0.0, max=1.0, description="How much of it is done")
    left: FloatProperty(name="Left", min=0.0, description="Seconds that it still takes, 0 where that is not known")


for _method, _group in SETTINGS_GROUPS.items():
    FACIAL_RETARGET_PG_task.__annotations__[_method] = PointerProperty(type=_group)

CLASSES = (
    FACIAL_RETARGET_PG_feature_point,
    FACIAL_RETARGET_PG_point_name,
    FACIAL_RETARGET_PG_part,
    FACIAL_RETARGET_PG_origin,
    FACIAL_RETARGET_PG_cloned_key,
    FACIAL_RETARGET_PG_finding,
    FACIAL_RETARGET_PG_face,
    FACIAL_RETARGET_PG_example,
    FACIAL_RETARGET_PG_sculpting,
    *SETTINGS_GROUPS.values(),
    FACIAL_RETARGET_PG_regions,
    FACIAL_RETARGET_PG_mask,
    FACIAL_RETARGET_PG_cloning,
    FACIAL_RETARGET_PG_bake_how,
    FACIAL_RETARGET_PG_bake,
    FACIAL_RETARGET_PG_normal_maps,
    FACIAL_RETARGET_PG_overlay,
    FACIAL_RETARGET_PG_task,
    FACIAL_RETARGET_PG_work,
)

_register_classes, _unregister_classes = bpy.utils.register_classes_factory(CLASSES)


def register() -> None:
    """Hang the groups on objects, scenes and the window manager."""
    _register_classes()
    Object.facial_retarget = PointerProperty(type=FACIAL_RETARGET_PG_face)
    Scene.facial_retarget = PointerProperty(type=FACIAL_RETARGET_PG_task)
    WindowManager.facial_retarget = PointerProperty(type=FACIAL_RETARGET_PG_work, options={"SKIP_SAVE"})


def unregister() -> None:
    """Take the groups off again; their data stays in the .blend."""
    del WindowManager.facial_retarget
    del Scene.facial_retarget
    del Object.facial_retarget
    _unregister_classes()
