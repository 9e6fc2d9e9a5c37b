"""The curves of a target's shape keys as files, and as FAPs where they drive it; jobs that make the same bakes."""

import csv
import json
import sys
from pathlib import Path

import bpy
import numpy as np
from stage import actor_face, donor_pair, empty_scene, part, refused

folder = Path(sys.argv[1])
FIRST, COUNT = 11, 8


def table(name: str) -> tuple[list[str], np.ndarray]:
    """Names and values (F, 2 + K) of an exported table."""
    with open(folder / name, encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    return head, np.array(rows, float)


def export(name: str, **options: object) -> None:
    """Export the curves of the performance's frames."""
    span = {"frame_start": FIRST, "frame_end": FIRST + COUNT - 1} | options
    assert bpy.ops.facial_retarget.export_curves(filepath=str(folder / name), **span) == {"FINISHED"}


empty_scene()
task, scene = bpy.context.scene.facial_retarget, bpy.context.scene
task.source, task.target = donor_pair()
task.method = "motion_cloning"
scene.render.fps, scene.frame_start, scene.frame_end = 25, FIRST, FIRST + COUNT - 1
for number, name in enumerate(("joy", "surprise")):
    key = task.source.data.shape_keys.key_blocks[name]
    for frame, value in ((FIRST, 0.0), (FIRST + 3 + number, 1.0), (FIRST + COUNT - 1, 0.2)):
        key.value = value
        key.keyframe_insert("value", frame=frame)
scene.frame_set(FIRST)
assert not bpy.ops.facial_retarget.export_curves.poll()
assert not bpy.ops.facial_retarget.export_faps.poll()

# Each bake that a job can do as well: its curves, and the job that gives the same ones.
for kind, residual in (("compact", 0), ("rig", 4)):
    task.bake.how.kind, task.bake.how.residual = kind, residual
    if kind == "rig":
        assert bpy.ops.facial_retarget.clone_shapes() == {"FINISHED"}
        task.target.data.shape_keys.key_blocks["anger"].mute = True
    bpy.ops.facial_retarget.save_job(filepath=str(folder / f"{kind}.toml"))
    assert bpy.ops.facial_retarget.retarget() == {"FINISHED"}
    scene.frame_set(FIRST + 1)
    export(f"blender_{kind}.csv")
    export(f"blender_{kind}.json")
    assert scene.frame_current == FIRST + 1
    head, rows = table(f"blender_{kind}.csv")
    keys = [key for key in task.target.data.shape_keys.key_blocks[1:] if not key.mute]
    assert head == ["frame", "time", *(key.name for key in keys)], head
    assert rows[:, 0].tolist() == list(range(FIRST, FIRST + COUNT))
    np.testing.assert_allclose(rows[:, 1], np.arange(COUNT) / 25, rtol=1e-6)
    for row, frame in zip(rows, range(FIRST, FIRST + COUNT), strict=True):
        scene.frame_set(frame)
        np.testing.assert_array_equal(row[2:].astype(np.float32), np.array([key.value for key in keys], np.float32))
    assert np.ptp(rows[:, 2:], axis=0).max() > 0.5
    document = json.loads((folder / f"blender_{kind}.json").read_text("utf-8"))
    assert (document["fps"], list(document["curves"])) == (25.0, head[2:])
    np.testing.assert_array_equal(np.array(list(document["curves"].values())).T, rows[:, 2:])
assert {"joy", "surprise", "retargeted_residual_1", "retargeted_residual_2"} <= set(head), head

# Half frames, and what a driver does.
keys = task.target.data.shape_keys
follower = keys.key_blocks["fear"].driver_add("value").driver
variable = follower.variables.new()
variable.targets[0].id_type, variable.targets[0].id = "KEY", keys
variable.targets[0].data_path = 'key_blocks["joy"].value'
follower.expression = f"{variable.name} / 2"
export("halves.csv", step=0.5)
head, halves = table("halves.csv")
assert halves[:3, 0].tolist() == [FIRST, FIRST + 0.5, FIRST + 1]
np.testing.assert_allclose(halves[:, head.index("fear")], halves[:, head.index("joy")] / 2, atol=1e-6)

# What cannot be exported is said.
with refused(".txt", "expected .csv or .json"):
    export("curves.txt")
with refused("no folder"):
    export("no/curves.csv")
with refused("ends at 3 before it starts"):
    export("none.csv", frame_end=3)
task.target.hide_set(True)
with refused("'target'", "hidden"):
    export("hidden.csv")
task.target.hide_set(False)
keys.use_relative = False
with refused("'target'", "absolute"):
    export("absolute.csv")
assert not {"curves.txt", "none.csv", "hidden.csv", "absolute.csv"} & {path.name for path in folder.iterdir()}

# FAPs come out where they drive the target.
actor = actor_face()
task.target = actor
assert not bpy.ops.facial_retarget.export_faps.poll()
fap, conversions = part("files.motion.fap"), part("core.mpeg4.conversions")
values = np.zeros((COUNT, 68))
values[:, 2] = 40 * np.arange(COUNT)  # open_jaw
fap.write_fap(conversions.stream_of_values("take", 25.0, values), folder / "take.fap")
bpy.ops.facial_retarget.import_motion(filepath=str(folder / "take.fap"), frame_start=FIRST)
bpy.context.view_layer.objects.active = task.source
options = {"frame_start": FIRST, "frame_end": FIRST + COUNT - 1}
assert bpy.ops.facial_retarget.export_faps(filepath=str(folder / "back.fap"), **options) == {"FINISHED"}
stream = fap.read_fap(folder / "back.fap")
assert stream.fps == 25.0
np.testing.assert_array_equal(conversions.low_level(stream), values)
