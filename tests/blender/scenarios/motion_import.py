"""Motion files onto a face: every way shows what the core computes, replaces itself, and leaves the artist's own."""

import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix
from stage import actor_face, empty_scene, enable, fitted, grid, part, refused, shown

folder = Path(sys.argv[1])
START, COUNT = 11, 9
FPS = 30.0
"""The file's; the scene has 24."""
TOLERANCE = 1e-5
"""Share of the face that float32 may cost."""

empty_scene()
context = bpy.context
scene = context.scene
import_motion = bpy.ops.facial_retarget.import_motion
conversions, fap_controls, arkit = part("core.mpeg4.conversions"), part("fap_controls"), part("core.mpeg4.arkit")


def wavy(count: int, seed: int) -> np.ndarray:
    """(count, 68) whole FAPs of every kind, the head's too."""
    rng, time = np.random.default_rng(seed), np.arange(count)[:, None]
    values = np.zeros((count, 68))
    for fap in part("core.mpeg4.faps").FAPS[2:]:
        size = 30_000 if fap.unit == "AU" else 500
        values[:, fap.number - 1] = np.rint(size * np.sin(0.4 * time[:, 0] + rng.uniform(0, 6)))
    return values


def write_fap(name: str, values: np.ndarray) -> str:
    """A `.fap` file; returns its path."""
    part("files.motion.fap").write_fap(conversions.stream_of_values(name, FPS, values), folder / f"{name}.fap")
    return str(folder / f"{name}.fap")


def plays(thing: bpy.types.Object, values: np.ndarray, step: float) -> None:
    """At the scene frame of each frame of the file, and half-way, the object shows what the core says."""
    face = fitted(thing)
    meshes = part("bridge.meshes")
    for i, row in enumerate(values):
        frame = START + i * step
        scene.frame_set(int(frame), subframe=frame % 1)
        seen = meshes.to_face_space(thing, shown(thing))
        np.testing.assert_allclose(seen, face.frames(row[None])[0], rtol=0, atol=TOLERANCE * face.mesh.size)


def names(thing: bpy.types.Object) -> list[str]:
    """Names of an object's shape keys."""
    return thing.data.shape_keys.key_blocks.keys()


def curve_paths(animated: bpy.types.ID) -> list[str]:
    """Data paths of the curves of something."""
    bag = part("bridge.curves").find_curves(animated)
    return [] if bag is None else [curve.data_path for curve in bag.fcurves]


# An artist's own animated key, control and action stay what they are, whatever is imported.
actor = actor_face()
actor.shape_key_add(name="Basis", from_mix=False)
own = actor.shape_key_add(name="wart", from_mix=False)
own.value = 0.0
own.keyframe_insert("value", frame=100)
actor["weight"] = 1.0
actor.keyframe_insert('["weight"]', frame=3)


def own_is_there() -> None:
    """What the artist made is as it was."""
    assert "wart" in names(actor)
    assert part("bridge.shape_keys").value_path("wart") in curve_paths(actor.data.shape_keys)
    assert '["weight"]' in curve_paths(actor)


first, second = wavy(COUNT, 1), wavy(4, 2)
paths = write_fap("first", first), write_fap("second", second)
rate = 24 / FPS
scene.frame_set(5)

# As controls: made where they are missing, at the file's times on the scene's clock.
assert import_motion(filepath=paths[0], frame_start=START) == {"FINISHED"}
assert scene.frame_current == 5
plays(actor, first, rate)
own_is_there()
curve = part("bridge.curves").find_curves(actor).fcurves.find('["fap_open_jaw"]')
assert curve.group.name == "Imported Motion"
assert {point.interpolation for point in curve.keyframe_points} == {"LINEAR"}
np.testing.assert_allclose([p.co.x for p in curve.keyframe_points], START + rate * np.arange(COUNT), rtol=1e-6)

# Again, with what an artist has sculpted in between: the motion is replaced, the shapes stay.
key = actor.data.shape_keys.key_blocks["FAP 3 open_jaw"]
flat = np.empty(3 * len(actor.data.vertices), np.float32)
key.points.foreach_get("co", flat)
sculpted = (flat + 0.1).astype(np.float32)
key.points.foreach_set("co", sculpted)
import_motion(filepath=paths[1], frame_start=START)
key.points.foreach_get("co", flat)
assert np.array_equal(flat, sculpted)
bpy.ops.facial_retarget.make_controls()
plays(actor, second, rate)
assert len(curve_paths(actor)) == len(set(curve_paths(actor)))
own_is_there()

# As points: three keys per point at most, and each import replaces the one before.
for path, values in zip(paths, (first, second), strict=True):
    import_motion(filepath=path, way="POINTS", frame_start=START)
    plays(actor, values, rate)
    own_is_there()
assert all(actor[control.name] == 0 for control in fap_controls.CONTROLS)
channels = [name for name in names(actor) if name[0].isdigit() or name.startswith("eye ")]
assert set(channels) <= set(fitted(actor).channels)
assert len(channels) == len(curve_paths(actor.data.shape_keys)) - 1

# As frames: the same, sampled at the scene's frames. A cache that the face plays goes: it would hide them.
caches, head = part("bridge.bakes.cache"), part("bridge.heads").read_head(actor)
frames = np.repeat(head.face.mesh.vertices[None].astype(np.float32), 2, axis=0)
places = caches.cache_places(head, folder / "cache.pc2", frames)
with part("files.whole").written_whole() as aside:
    caches.add_caches(aside, head, places, frames, [1, 2])
caches.play_caches(head, places, [1, 2])
actor.facial_retarget.bake = "pc2"
import_motion(filepath=paths[0], way="FRAMES", frame_start=START)
assert not set(channels) & set(names(actor))
assert not actor.modifiers
assert not actor.facial_retarget.bake
last = START + int((COUNT - 1) * rate + 1e-6)
assert [name for name in names(actor) if name.startswith("frame_")] == [
    f"frame_{frame:04d}" for frame in range(START, last + 1)
]
whole = np.arange(START, last + 1)
sampled = [np.interp((whole - START) / rate, np.arange(COUNT), column) for column in first.T]
plays(actor, np.stack(sampled, axis=1), 1.0)
own_is_there()

# With the scene at the file's rate, points and frames are the same at all frames.
rendered = {}
for way in ("FRAMES", "POINTS", "CONTROLS"):
    import_motion(filepath=paths[0], way=way, frame_start=START, update_scene_fps=True, update_scene_duration=True)
    assert (scene.frame_start, scene.frame_end) == (START, START + COUNT - 1)
    assert abs(scene.render.fps / scene.render.fps_base - FPS) < 1e-4
    plays(actor, first, 1.0)
    own_is_there()
    rendered[way] = []
    for frame in range(START, START + COUNT):
        scene.frame_set(frame)
        rendered[way].append(shown(actor))
size = np.ptp(rendered["FRAMES"][0], axis=0).max()
np.testing.assert_allclose(rendered["POINTS"], rendered["FRAMES"], rtol=0, atol=3e-6 * size)

# Saved, and opened again.
bpy.ops.wm.save_as_mainfile(filepath=str(folder / "motion.blend"))
bpy.ops.wm.open_mainfile(filepath=str(folder / "motion.blend"))
enable()
scene, actor = context.scene, bpy.data.objects["actor"]
plays(actor, first, 1.0)

# The head's turn on an empty that stands where the face stands, however it is placed and scaled.
actor.matrix_world = Matrix.Translation((3, 2, 1)) @ Matrix.Rotation(0.7, 4, "Y") @ Matrix.Diagonal((-2, 3, 2.5, 1))
context.view_layer.update()
import_motion(filepath=paths[0], way="POINTS", frame_start=START, head="EMPTY")
plays(actor, first, 1.0)
empty = actor.facial_retarget.head
assert empty.name == "actor head"
face, meshes = fitted(actor), part("bridge.meshes")
turned = face.frames(first, turn_head=True)
still = face.frames(first)
to_world = np.array(actor.matrix_world)
rest = None
for i in range(COUNT):
    scene.frame_set(START + i)
    now = np.array(empty.evaluated_get(context.evaluated_depsgraph_get()).matrix_world)
    if rest is None:
        delta = empty.delta_rotation_euler.to_matrix().to_4x4()
        rest = np.array(Matrix.Translation(empty.location) @ delta)
    # What is parented to the empty moves as the core turns the head.
    own_space = meshes.from_face_space(actor, np.concatenate([still[i], turned[i]]).astype(np.float64))
    world = own_space @ to_world[:3, :3].T + to_world[:3, 3]
    moved = now @ np.linalg.inv(rest)
    before, after = np.split(world, 2)
    np.testing.assert_allclose(before @ moved[:3, :3].T + moved[:3, 3], after, atol=1e-4)
import_motion(filepath=paths[1], way="POINTS", frame_start=START)
assert not curve_paths(empty)
assert tuple(empty.rotation_euler) == (0, 0, 0)

# ARKit: the artist's own keys are driven, in other spellings too, and beyond 1 where the take goes there.
rig = grid("rig")
context.view_layer.objects.active = rig
rig.shape_key_add(name="Basis", from_mix=False)
weights = np.abs(np.sin(np.arange(COUNT)[:, None] + np.arange(52))) * 1.1
take = part("core.mpeg4.arkit_take").ArkitTake("take", FPS, weights, None, None)
part("files.motion.arkit_csv").write_arkit_csv(take, folder / "take.csv")
spelled = [f"{name[:-4]}_L" if name.endswith("Left") and name != "jawLeft" else name for name in arkit.ARKIT_NAMES]
with refused("'rig'", "jawOpen", "no feature points"):
    import_motion(filepath=str(folder / "take.csv"))
for name in spelled[:-1]:
    rig.shape_key_add(name=name, from_mix=False).value = 0.0
for keys in (51, 52):
    import_motion(filepath=str(folder / "take.csv"), frame_start=START)
    assert len(names(rig)) == 1 + keys
    for i in range(COUNT):
        scene.frame_set(START + i)
        values = [rig.data.shape_keys.key_blocks[name].value for name in spelled[:keys]]
        np.testing.assert_allclose(values, weights[i, :keys], atol=1e-6)
    if keys == 51:
        rig.shape_key_add(name="TongueOut", from_mix=False).value = 0.0
        spelled[-1] = "TongueOut"
rig.data.shape_keys.key_blocks["jawOpen"].driver_add("value")
with refused("'rig'", "'jawOpen'", "driver"):
    import_motion(filepath=str(folder / "take.csv"))

# What is missing is made from the points.
context.view_layer.objects.active = actor
import_motion(filepath=str(folder / "take.csv"), frame_start=START)
shapes = part("core.acting.expression_sets").expression_shapes(face, ("arkit",))
assert set(arkit.ARKIT_NAMES) <= set(names(actor))
scene.frame_set(START + 4)
summed = sum(
    w * (shapes[name] - face.mesh.vertices)
    for name, w in zip(arkit.ARKIT_NAMES, weights[4], strict=True)
    if name in shapes
)
np.testing.assert_allclose(
    meshes.to_face_space(actor, shown(actor)), face.mesh.vertices + summed, rtol=0, atol=TOLERANCE * face.mesh.size
)
import_motion(filepath=str(folder / "take.csv"), frame_start=START, way="POINTS")
plays(actor, conversions.low_level(conversions.faps_of_arkit(take)), 1.0)
own_is_there()

# An empty that the artist has deleted is made again.
bpy.data.objects.remove(empty)
import_motion(filepath=paths[0], frame_start=START, way="POINTS", head="EMPTY")
for collection in actor.facial_retarget.head.users_collection:
    collection.objects.unlink(actor.facial_retarget.head)
import_motion(filepath=paths[0], frame_start=START, way="POINTS", head="EMPTY")
assert len(actor.facial_retarget.head.users_collection) == 1
assert len(curve_paths(actor.facial_retarget.head)) == 3

# Markers on the actor's own points, whose head turns and which are hidden at times.
actor.matrix_world = Matrix.Identity(4)
context.view_layer.update()
face = fitted(actor)
acted = first.copy()
acted[0] = 0
places = face.known.positions(face.frames(acted, turn_head=True))
places[3, face.known.names.index("8.3")] = np.nan
anchored = [name for name in face.known.names if part("core.mpeg4.fdps").FDPS[name].anchored]
header = ["time", *(f"m{name}_{axis}" for name in face.known.names for axis in "xyz")]
rows = [[i / FPS, *("" if np.isnan(x) else repr(x) for x in row.ravel().tolist())] for i, row in enumerate(places)]
lines = [",".join(map(str, row)) for row in (header, *rows)]
(folder / "markers.csv").write_text("\n".join(lines) + "\n")
marker_map = part("core.markers.assignment").MarkerMap(
    {f"m{name}": name for name in face.known.names}, tuple(f"m{name}" for name in anchored)
)
part("files.motion.marker_map").write_marker_map(marker_map, folder / "map.json")
markers = {"filepath": str(folder / "markers.csv"), "marker_map": str(folder / "map.json"), "frame_start": START}
with refused("'m8.3'", "hidden"):
    import_motion(**markers, gaps="refuse")
bpy.ops.facial_retarget.remove_controls()
import_motion(**markers, head="EMPTY")
for i in (0, 2, 4, COUNT - 1):
    scene.frame_set(START + i)
    for control in fap_controls.CONTROLS:
        column = control.fap.number - 1
        if face.measurable[column]:
            wanted = max(acted[i, column], 0) if control.fap.one_way else acted[i, column]
            assert abs(actor[control.name] - wanted) < 2, (i, control.name, actor[control.name], wanted)
    np.testing.assert_allclose(actor.facial_retarget.head.rotation_euler, acted[i, 47:50] * 1e-5, atol=2e-4)

# What cannot be imported is said, and changes nothing.
with refused("missing.fap"):
    import_motion(filepath=str(folder / "missing.fap"))
(folder / "bad.fap").write_text("what is this")
with refused("bad.fap"):
    import_motion(filepath=str(folder / "bad.fap"))
with refused(".obj"):
    import_motion(filepath=str(folder / "face.obj"))
with refused("missing.json"):
    import_motion(filepath=str(folder / "take.csv"), marker_map=str(folder / "missing.json"))
wild = second.copy()
wild[1, 2] = 20_000
bpy.ops.facial_retarget.make_controls()
with refused("FAP 3", "20000", "10240"):
    import_motion(filepath=write_fap("wild", wild))
import_motion(filepath=write_fap("wild", wild), way="POINTS", frame_start=START)
plays(actor, wild, 1.0)
context.view_layer.objects.active = plain = grid("plain")
with refused("MPEG-4"):
    import_motion(filepath=paths[0])

# Esc at every stage leaves everything as it was.
context.view_layer.objects.active = actor
motion_import, snapshot = part("bridge.motion.motion_import"), sys.modules["stage"].snapshot
for way in ("CONTROLS", "POINTS", "FRAMES"):
    options = motion_import.ImportOptions(
        Path(paths[0]), way, 1, "EMPTY", "hold", "fill", None, None, set_rate=True, set_range=True
    )
    before = snapshot()
    steps = motion_import.import_motion_steps(context, actor, options)
    for _, what in steps:
        if what == "Writing":
            steps.close()
    assert snapshot() == before, way
