"""What the artist does next, and how far each step is: read off the scene at every redraw, without bpy and NumPy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from .core.methods.settings import FEWEST_POINTS, SETTINGS, least_points

if TYPE_CHECKING:
    from bpy.types import Context, Object, PropertyGroup

STEPS = ("FACES", "POINTS", "EXAMPLES", "RETARGET", "EXPORT", "REPORT")
"""The steps of the work, in their order."""

FIRST_POINTS = 5
"""Points to place before the others can be trusted to proposals."""

BAKED_KEY = "frame_{:04d}"
"""Name of the shape key that a bake makes for a scene frame."""

FRAME_NAMES = "frame_####"
"""The same as the pattern of names that the panel offers."""


@dataclass(frozen=True)
class Advice:
    """What to do next.

    Attributes
    ----------
    step : the one of `STEPS` that is at work.
    text : one line with {fields}, to be translated before they are filled in.
    fields : what fills them.
    operator : bl_idname of the button that does it; "" where there is none.
    options : the operator's properties.
    """

    step: str
    text: str
    fields: Mapping[str, Any] = field(default_factory=dict)
    operator: str = ""
    options: Mapping[str, Any] = field(default_factory=dict)


def advice(context: Context) -> Advice:
    """The one thing to do next for the scene's task."""
    task = context.scene.facial_retarget
    return _face_advice(context, task) or _point_advice(context, task) or _work_advice(context, task)


def state(context: Context, step: str) -> str:
    """How far a step is: DONE, NOW for the one that is at work, or OPEN."""
    task = context.scene.facial_retarget
    done = {
        "FACES": _face_advice(context, task) is None,
        "POINTS": _both(task) and _point_advice(context, task) is None,
        "EXAMPLES": any(one.source_state == one.target_state == "SCULPTED" for one in task.examples),
        "RETARGET": _both(task) and is_baked(task.target, first_frame(context)),
    }
    if done.get(step):
        return "DONE"
    return "NOW" if advice(context).step == step else "OPEN"


def first_frame(context: Context) -> int:
    """The first scene frame that the task retargets."""
    task = context.scene.facial_retarget
    return (context.scene if task.use_scene_range else task).frame_start


def is_baked(thing: Object, frame: int) -> bool:
    """Whether an object has a bake: a shape key for a scene frame, or one of another kind."""
    keys = thing.data.shape_keys
    return bool(thing.facial_retarget.bake) or (keys is not None and BAKED_KEY.format(frame) in keys.key_blocks)


def found_face(context: Context) -> Object | None:
    """The face whose findings the report shows: the active object if it has any, or else the target."""
    for thing in (context.active_object, context.scene.facial_retarget.target):
        if thing is not None and thing.type == "MESH" and thing.facial_retarget.findings_text:
            return thing
    return None


def wanted_points(task: PropertyGroup) -> int:
    """Feature points that both faces must have in common: few where the artist's own base mesh says which."""
    return FEWEST_POINTS if task.base is not None else least_points(SETTINGS[task.method])


def _both(task: PropertyGroup) -> bool:
    return task.source is not None and task.target is not None and task.source != task.target


def _face_advice(context: Context, task: PropertyGroup) -> Advice | None:
    if task.source is None and task.target is None and not any(_is_mesh(thing) for thing in context.scene.objects):
        return Advice("FACES", "Import two faces, or try the built-in ones", operator="facial_retarget.add_faces")
    for role, text in (("source", "Choose the face that moves"), ("target", "Choose the face that shall move")):
        thing = getattr(task, role)
        if thing is None:
            return Advice("FACES", text, operator="facial_retarget.choose_face", options={"role": role.upper()})
        if thing.name not in context.scene.objects:
            return Advice("FACES", "{face} is not in this scene: choose another face", {"face": thing.name})
    if task.source == task.target:
        return Advice("FACES", "Source and target are one object: choose another target")
    if task.source.hide_get() or task.source.hide_viewport:
        return Advice("FACES", "Unhide {face}: Blender moves nothing hidden", {"face": task.source.name})
    if _surely_still(task.source):
        text = "{face} does not move: animate it, import motion (More, MPEG-4 Face), or choose another source"
        return Advice("FACES", text, {"face": task.source.name})
    return None


def _is_mesh(thing: Object) -> bool:
    return thing.type == "MESH"


def _surely_still(thing: Object) -> bool:
    """Whether nothing on an object can move it: no animation, driver, modifier or parent, no part of its head."""
    animated = (thing, thing.data, thing.data.shape_keys)
    return (
        not any(data is not None and data.animation_data is not None for data in animated)
        and not len(thing.modifiers)
        and thing.parent is None
        and not len(thing.facial_retarget.parts)
    )


def _point_advice(context: Context, task: PropertyGroup) -> Advice | None:
    wanted = wanted_points(task)
    for role in ("source", "target"):
        thing = getattr(task, role)
        found = _missing_points(context, thing, role, wanted - len(_point_names(thing)))
        if found is not None:
            return found
    common = len(_point_names(task.source) & _point_names(task.target))
    if common < wanted:
        text = "Only {count} points have the same names on both faces: {wanted} must"
        return Advice("POINTS", text, {"count": common, "wanted": wanted})
    return None


def _missing_points(context: Context, thing: Object, role: str, missing: int) -> Advice | None:
    """What to do where a face lacks points: place some, then accept what is proposed."""
    if missing <= 0:
        return None
    face = thing.facial_retarget
    fields = {"count": missing, "face": thing.name}
    start = Advice("POINTS", "", fields, "facial_retarget.start_placing", {"role": role.upper()})
    if len(face.proposals) >= missing:
        fields["count"] = len(face.proposals)
        text = "Look at the {count} proposed points on {face}, then accept them"
        if context.active_object == thing:
            return Advice("POINTS", text, fields, "facial_retarget.accept_points")
        return replace(start, text=text)
    if not face.turn:
        return Advice("POINTS", "Choose a larger set of points for {face}: {count} are missing", fields)
    first = FIRST_POINTS - len(face.points)
    if first > 0:
        fields["count"] = first
        text = "Place {count} points on {face}, then the others are proposed"
        return replace(
            start, text=text if first > 1 else "Place one more point on {face}, then the others are proposed"
        )
    text = "Place {count} more points on {face}" if missing > 1 else "Place one more point on {face}"
    return replace(start, text=text)


def _point_names(thing: Object) -> set[str]:
    """Names of the points on a face and on the parts of its head."""
    things = [thing, *(part.thing for part in thing.facial_retarget.parts if part.thing is not None)]
    return {point.name for one in things for point in one.facial_retarget.points}


def _work_advice(context: Context, task: PropertyGroup) -> Advice:
    if context.mode != "OBJECT":
        return Advice("RETARGET", "Go back to Object Mode", operator="object.mode_set", options={"mode": "OBJECT"})
    if not is_baked(task.target, first_frame(context)):
        text = "Press Retarget" if len(task.examples) else "Examples are optional: press Retarget"
        return Advice("RETARGET", text, operator="facial_retarget.retarget")
    return Advice(
        "EXPORT", "Play it: then export it, or correct it and retarget again", operator="screen.animation_play"
    )
