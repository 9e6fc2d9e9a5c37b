"""One line always says what to do next, from the empty scene to the baked performance; each step says how far it is."""

import bpy
from stage import empty_scene, grid, part, refused

empty_scene()
guide = part("guide")
context = bpy.context
task = context.scene.facial_retarget


def advised(text: str, step: str, operator: str = "") -> None:
    """What the panel says now, which step is at work, and which button does it."""
    advice = guide.advice(context)
    assert (advice.text.format(**advice.fields), advice.step, advice.operator) == (text, step, operator), advice
    now = [name for name in guide.STEPS if guide.state(context, name) == "NOW"]
    assert now in ([step], []), (now, step)
    if operator:
        group, _, name = operator.partition(".")
        known = getattr(getattr(bpy.ops, group), name).get_rna_type().properties
        for option, value in advice.options.items():
            assert value in known[option].enum_items, (option, value)


def done() -> list[str]:
    """The steps that have a check mark."""
    return [name for name in guide.STEPS if guide.state(context, name) == "DONE"]


advised("Import two faces, or try the built-in ones", "FACES", "facial_retarget.add_faces")
source, target = grid("source", 9), grid("target", 12)
advised("Choose the face that moves", "FACES", "facial_retarget.choose_face")
context.view_layer.objects.active = source
assert bpy.ops.facial_retarget.choose_face(role="SOURCE") == {"FINISHED"}
advised("Choose the face that shall move", "FACES", "facial_retarget.choose_face")
with refused("'source' is the source already"):
    bpy.ops.facial_retarget.choose_face(role="TARGET")
assert task.target is None
task.target = source
advised("Source and target are one object: choose another target", "FACES")
context.view_layer.objects.active = target
task.target = None
assert bpy.ops.facial_retarget.choose_face(role="TARGET") == {"FINISHED"}
advised("source does not move: animate it, import motion (More, MPEG-4 Face), or choose another source", "FACES")
source.keyframe_insert("location", frame=1)
source.hide_set(True)
advised("Unhide source: Blender moves nothing hidden", "FACES")
source.hide_set(False)
assert done() == ["FACES"]

# Points: as many as the method wants, of the same names; a part of the head may have some.
task.method = "motion_cloning"
wanted = guide.wanted_points(task)
assert wanted < 30
START = "facial_retarget.start_placing"
advised("Place 5 points on source, then the others are proposed", "POINTS", START)
for number in range(wanted):
    if number == guide.FIRST_POINTS - 1:
        advised("Place one more point on source, then the others are proposed", "POINTS", START)
    if number == guide.FIRST_POINTS:
        advised(f"Place {wanted - 5} more points on source", "POINTS", START)
        for proposed in range(wanted):
            source.facial_retarget.proposals.add().name = f"p{5 + proposed}"
        text = f"Look at the {wanted} proposed points on source, then accept them"
        advised(text, "POINTS", START)
        context.view_layer.objects.active = source
        advised(text, "POINTS", "facial_retarget.accept_points")
        context.view_layer.objects.active = target
        source.facial_retarget.proposals.clear()
    source.facial_retarget.points.add().name = f"p{number}"
advised("Place 5 points on target, then the others are proposed", "POINTS", START)
for number in range(wanted - 2):
    target.facial_retarget.points.add().name = f"p{number}"
eye = grid("eye", 3)
eye.facial_retarget.points.add().name = "eye"
target.facial_retarget.parts.add().thing = eye
advised("Place one more point on target", "POINTS", START)
target.facial_retarget.points.add().name = "mine"
target.facial_retarget.points.remove(len(target.facial_retarget.points) - 1)
target.facial_retarget.point_set = "MINIMAL"
skipped = [info.name for info in part("core.point_sets").POINT_SETS["MINIMAL"]]
for name in skipped:
    target.facial_retarget.skipped.add().name = name
advised("Choose a larger set of points for target: 1 are missing", "POINTS")
target.facial_retarget.points.add().name = "mine"
advised(f"Only {wanted - 2} points have the same names on both faces: {wanted} must", "POINTS")
for name in ("eye", "mine"):
    source.facial_retarget.points.add().name = name
assert done() == ["FACES", "POINTS"]
task.method = "hierarchical"
advised(f"Place {30 - wanted - 2} more points on source", "POINTS", START)
task.base = eye
assert done() == ["FACES", "POINTS"], "an own base mesh says itself which points it wants"
task.base, task.method = None, "motion_cloning"

advised("Examples are optional: press Retarget", "RETARGET", "facial_retarget.retarget")
task.examples.add().name = "joy"
advised("Press Retarget", "RETARGET", "facial_retarget.retarget")
assert done() == ["FACES", "POINTS"], "the example is not sculpted yet"
for thing in (source, target):
    part("bridge.examples.examples").write_example(thing, "joy", part("bridge.meshes").read_positions(thing.data) * 1.1)
part("bridge.points.geometry_watch").changed()
assert done() == ["FACES", "POINTS", "EXAMPLES"]
bpy.ops.object.mode_set(mode="SCULPT")
advised("Go back to Object Mode", "RETARGET", "object.mode_set")
bpy.ops.object.mode_set(mode="OBJECT")

# Baked: by the frame that the range begins with.
part("bridge.shape_keys").ensure_key(target, f"frame_{context.scene.frame_start:04d}")
advised("Play it: then export it, or correct it and retarget again", "EXPORT", "screen.animation_play")
assert done() == ["FACES", "POINTS", "EXAMPLES", "RETARGET"]
task.use_scene_range, task.frame_start = False, 100
advised("Press Retarget", "RETARGET", "facial_retarget.retarget")

# A face that was deleted is no longer chosen.
bpy.data.objects.remove(target)
advised("Choose the face that shall move", "FACES", "facial_retarget.choose_face")
context.scene.collection.objects.unlink(source)
advised("source is not in this scene: choose another face", "FACES")
