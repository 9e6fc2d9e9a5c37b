"""The animation of a face as a motion file: what went in comes out."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import actor_face, empty_scene, fitted, grid, part, refused

folder = Path(sys.argv[1])
START, COUNT, FPS = 5, 8, 25.0

empty_scene()
context = bpy.context
scene = context.scene
import_motion, export_motion = bpy.ops.facial_retarget.import_motion, bpy.ops.facial_retarget.export_motion
conversions, fap, arkit_csv = part("core.mpeg4.conversions"), part("files.motion.fap"), part("files.motion.arkit_csv")
faps = part("core.mpeg4.faps").FAPS
rng = np.random.default_rng(3)
values = np.zeros((COUNT, 68))
for one in faps[2:]:
    size = 20_000 if one.unit == "AU" else 300
    values[:, one.number - 1] = rng.integers(0 if one.one_way else -size, size, COUNT)
fap.write_fap(conversions.stream_of_values("take", FPS, values), folder / "take.fap")


def exported(name: str, **options: object) -> object:
    """What a file holds after exporting the frames of the take."""
    span = {"frame_start": START, "frame_end": START + COUNT - 1}
    assert export_motion(filepath=str(folder / name), **(span | options)) == {"FINISHED"}
    read = {".fap": fap.read_fap, ".csv": arkit_csv.read_arkit_csv}[Path(name).suffix]
    return read(folder / name)


# Controls: all FAPs come back, those too that this face cannot show; the head's with its empty.
actor = actor_face()
take = {"filepath": str(folder / "take.fap"), "frame_start": START, "update_scene_fps": True}
import_motion(**take, head="EMPTY")
scene.frame_set(3)
stream = exported("back.fap")
assert scene.frame_current == 3
assert stream.fps == FPS
assert np.array_equal(conversions.low_level(stream), values)
assert np.array_equal(conversions.low_level(exported("part.fap", frame_start=START + 2)), values[2:])

# The NLA counts as well: the same action as a strip, two frames later.
animation = actor.animation_data
strip = animation.nla_tracks.new().strips.new("take", START + 2, animation.action)
strip.action_slot = animation.action_slot
animation.action = None
later = conversions.low_level(exported("later.fap", frame_start=START + 2, frame_end=START + COUNT + 1))
head = slice(47, 50)
assert np.array_equal(np.delete(later, head, axis=1), np.delete(values, head, axis=1))
animation.nla_tracks.remove(animation.nla_tracks[0])

# Off the mesh: whatever moves it, FAPs come back within one unit, those that a point shows.
face = fitted(actor)
bpy.ops.facial_retarget.remove_controls()
import_motion(**take, way="FRAMES")
for options in ({}, {"source": "MESH"}):
    measured = conversions.low_level(exported("measured.fap", **options))
    shown = face.measurable
    assert shown.sum() > 40
    np.testing.assert_allclose(measured[:, shown], values[:, shown], atol=1.0)
    assert not measured[:, ~shown & (np.arange(68) < 47)].any()

# Where the head moves in the vertices, that is found and taken out.
turning = face.frames(values, turn_head=True)
part("bridge.bakes.frames").write_frames(actor, part("bridge.meshes").from_face_space(actor, turning), START)
measured = conversions.low_level(exported("moving.fap", source="MOVING"))
shown[head] = True
np.testing.assert_allclose(measured[:, shown], values[:, shown], atol=2.0)

# ARKit's weights, off the keys that bear the names, however they are moved.
weights = rng.uniform(0, 1, (COUNT, 52))
arkit_take = part("core.mpeg4.arkit_take").ArkitTake("weights", FPS, weights, None, None)
arkit_csv.write_arkit_csv(arkit_take, folder / "weights.csv")
import_motion(filepath=str(folder / "weights.csv"), frame_start=START)
back = exported("back.csv")
assert back.fps == FPS
np.testing.assert_allclose(back.weights, weights, rtol=0, atol=1e-6)
rig = grid("rig")
context.view_layer.objects.active = rig
with refused("'rig'", "ARKit"):
    exported("rig.csv")
rig.shape_key_add(name="Basis", from_mix=False)
rig.shape_key_add(name="JawOpen", from_mix=False).value = 0.25
follower = rig.shape_key_add(name="eyeBlink_L", from_mix=False)
driver = follower.driver_add("value").driver
variable = driver.variables.new()
variable.targets[0].id_type, variable.targets[0].id = "KEY", actor.data.shape_keys
variable.targets[0].data_path = 'key_blocks["jawOpen"].value'
driver.expression = f"{variable.name} / 2"
rigged = exported("rig.csv").weights
names = part("core.mpeg4.arkit").ARKIT_NAMES
np.testing.assert_allclose(rigged[:, names.index("jawOpen")], 0.25)
jaw = weights[:, names.index("jawOpen")]
np.testing.assert_allclose(rigged[:, names.index("eyeBlinkLeft")], jaw / 2, atol=1e-6)
assert not np.delete(rigged, [names.index("jawOpen"), names.index("eyeBlinkLeft")], axis=1).any()

# A whole that the face has in halves drives both, and is their mean on the way back.
for side in "LR":
    rig.shape_key_add(name=f"cheekPuff_{side}", from_mix=False).value = 0.0
follower.driver_remove("value")
import_motion(filepath=str(folder / "weights.csv"), frame_start=START)
puffed = weights[:, names.index("cheekPuff")]
back = exported("rig.csv").weights
np.testing.assert_allclose(back[:, names.index("cheekPuff")], puffed, atol=1e-6)
context.scene.frame_set(START + 1)
assert {round(rig.data.shape_keys.key_blocks[f"cheekPuff_{side}"].value, 5) for side in "LR"} == {round(puffed[1], 5)}

# What cannot be exported is said; nothing is written.
with refused("MPEG-4"):
    exported("rig.fap")
context.view_layer.objects.active = actor
with refused("before it starts"):
    exported("none.fap", frame_end=START - 1)
with refused(".txt"):
    export_motion(filepath=str(folder / "motion.txt"))
with refused("no folder"):
    exported("no/folder/motion.csv")
actor.hide_set(True)
with refused("'actor'", "hidden"):
    exported("hidden.fap", source="MESH")
left = {path.name for path in folder.glob("*.fap")} | {path.name for path in folder.glob("*.txt")}
assert left == {"take.fap", "back.fap", "part.fap", "later.fap", "measured.fap", "moving.fap"}, left
