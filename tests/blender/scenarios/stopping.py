"""Work in steps may be stopped at any time: then all is as it was; done, one undo step takes all of it back."""

import sys
import threading
from pathlib import Path

import bpy
import numpy as np
from stage import demo_object, differences, empty_scene, everything, part

folder = Path(sys.argv[1])
SHARES = (0.0, 0.3, 0.7, 0.9, 0.999)
"""Where the work is stopped: at its first step, and at the first one past each of these shares."""

empty_scene()
context, demo = bpy.context, part("demo")
actor, warped = demo.actor(4_500), demo.warped_actor(np.random.default_rng(1), 4_500)
source, target = demo_object(actor, "source"), demo_object(warped, "target", pieces=True)
task = context.scene.facial_retarget
part("bridge.points.points").write_points(
    demo_object(actor, "bare"), actor.face.points.subset(["9.3", "2.1", "3.7", "3.12", "4.1"])
)
task.source, task.target = source, target
task.method, task.use_scene_range, task.frame_start, task.frame_end = "motion_cloning", False, 2, 4
task.cloning.existing = "REPLACE"
bpy.ops.facial_retarget.create_examples()
for name in ("joy", "fear"):
    part("bridge.examples.examples").write_example(source, name, actor.face.examples[name])
    bpy.ops.facial_retarget.rough_out(example=name, side="TARGET")
for frame, value in ((1, 0.0), (5, 1.0)):
    source.data.shape_keys.key_blocks["joy"].value = value
    source.data.shape_keys.key_blocks["joy"].keyframe_insert("value", frame=frame)
context.scene.frame_set(3, subframe=0.25)
context.view_layer.objects.active = target
stream = np.full((3, 68), 100.0)
stream[:, :2] = 0
take = folder / "take.fap"
part("files.motion.fap").write_fap(part("core.mpeg4.conversions").stream_of_values("take", 24.0, stream), take)


def steps_of(module: str, name: str, *arguments: object) -> object:
    """Steps of the bridge on the scene as it is when they begin: an undo makes new objects."""
    return getattr(part(f"bridge.{module}"), name)(*map(_given, arguments))


def _given(argument: object) -> object:
    if isinstance(argument, list):
        return [_given(one) for one in argument]
    return bpy.data.objects[argument[1:]] if isinstance(argument, str) and argument[:1] == "@" else argument


def files() -> dict[str, object]:
    """What lies in the folder."""
    return {str(path): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def take_in(way: str) -> tuple[object, ...]:
    """Arguments for the steps that import the take."""
    options = part("bridge.motion.motion_import").ImportOptions(
        take, way, 1, "EMPTY", "hold", "fill", None, None, True, True
    )
    return context, "@target", options


BAKES = ("frames", "compact", "rig", "pc2", "alembic")
WORKS = {
    **{f"bake {kind}": ("retargeting", "retarget_steps", context) for kind in BAKES},
    "show levels": ("retargeting", "level_steps", context),
    "clone": ("cloning.cloning", "clone_steps", context),
    "re-solve": ("cloning.resolving", "resolve_steps", context),
    "make shapes": ("motion.expression_keys", "make_shapes_steps", "@target", {"arkit", "expressions"}, True),
    "make controls": ("motion.controls", "make_controls_steps", "@target"),
    "import as controls": ("motion.motion_import", "import_motion_steps", *take_in("CONTROLS")),
    "import as points": ("motion.motion_import", "import_motion_steps", *take_in("POINTS")),
    "import as frames": ("motion.motion_import", "import_motion_steps", *take_in("FRAMES")),
    "rough out": ("examples.example_making", "rough_out_steps", context, ["joy", "fear"], "TARGET", "POINTS", True),
    "clone an example": ("examples.example_making", "rough_out_steps", context, ["joy"], "TARGET", "CLONE", True),
    "mirror": ("examples.example_making", "mirror_steps", context, ["joy"], "SOURCE", "FLIP"),
    "check examples": ("examples.example_checking", "check_steps", context),
    "add the actor": ("cloning.donors", "add_actor_steps", context, {"expressions"}),
    "add the pair": ("scene.demo_pair", "add_pair_steps", context, "child", True),
    "copy points": ("points.point_copies", "copy_steps", "@source", ["@bare"]),
    "export": (
        "motion.motion_export",
        "export_motion_steps",
        context,
        "@source",
        folder / "out.fap",
        range(1, 6),
        "MESH",
    ),
    "save a job": ("job", "save_job_steps", context, folder / "job.toml"),
    "load a job": ("job", "load_job_steps", context, folder / "job.toml", "Z"),
    "save a clone job": ("cloning.clone_job", "save_clone_job_steps", context, folder / "clone.toml"),
    "save shapes": ("cloning.shape_tables", "save_shapes_steps", "@target", folder / "shapes.json"),
    "load shapes": ("cloning.shape_tables", "load_shapes_steps", "@target", folder / "shapes.json", "SUFFIX"),
    "show the base mesh": ("points.base_steps", "show_base_steps", context),
    "preview": ("preview.preview", "preview_steps", context),
}


def stopped_past(share: float, work: tuple[object, ...]) -> bool:
    """Stop a work at its first step past a share; false if it has come to its end instead."""
    running = steps_of(*work)
    for done, _ in running:
        if done >= share:
            running.close()
            for thread in threading.enumerate():
                if thread.name == "facial retarget":
                    thread.join(60)
            return True
    return False


failed = []
for name, work in WORKS.items():
    task = context.scene.facial_retarget
    task.method = "hierarchical" if name == "show levels" else "motion_cloning"
    if name.startswith("bake "):
        task.bake.how.kind, task.bake.cache = name.removeprefix("bake "), str(folder / "bake.pc2")
        task.report, task.page = str(folder / "report.json"), str(folder / "page.html")
    context.view_layer.update()
    before, lying = everything(), files()
    bpy.ops.ed.undo_push(message="before")
    for share in SHARES:
        if not stopped_past(share, work):
            break
        if found := differences(before | lying, everything() | files()):
            failed.append((name, share, found))
    else:
        part("bridge.background").finished(steps_of(*work))
    context.view_layer.update()
    assert differences(before | lying, everything() | files()), f"{name} has changed nothing"
    if name == "preview":  # it writes a key that no file holds, and takes it away by itself
        part("bridge.preview.preview").stop_preview()
    bpy.ops.ed.undo_push(message="after")
    if name == "clone":  # the next work needs it, and a correction
        corrected = bpy.data.objects["target"].data.shape_keys.key_blocks["joy"]
        for point in list(corrected.points)[:20]:
            point.co.z += 0.01
        continue
    bpy.ops.ed.undo()
    if found := differences(before, everything()):
        failed.append((name, "undo", found))
    print(name, "seen")
assert not failed, failed
