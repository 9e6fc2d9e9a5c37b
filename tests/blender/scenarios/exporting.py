"""A head through all four formats and back, prepared for others, and what is said before something is lost."""

import re
import resource
import signal
import sys
from pathlib import Path
from typing import NamedTuple

import bpy
import numpy as np
from stage import demo_object, differences, empty_scene, everything, part, refused, shown, snapshot

FOLDER = Path(sys.argv[-1])
FIRST, LAST, RATE = 5, 9, (30, 1.001)
TIMES = np.arange(FIRST, LAST + 0.1, 0.5)
FORMATS = {"gltf": "glb", "fbx": "fbx", "usd": "usda", "alembic": "abc"}
NAMES = ('smile "x"', "a b", "a.b", "a/b", "1 Ünï", 61 * "n" + "é", "driven", "muted", "masked", "corrective", "beyond")
NEAR = 2e-6
"""Share of the head's size: float32 coordinates, turned into the file's axes and back, came to 5e-7 in Blender 5.2."""


def fresh_scene() -> None:
    """An empty scene in which all formats can be read and written."""
    import addon_utils  # exists once bpy is imported

    empty_scene()
    for name in ("io_scene_gltf2", "io_scene_fbx"):
        addon_utils.enable(name)


def head() -> list[bpy.types.Object]:
    """The built-in actor, of several objects with awkward names, with keys that nothing plain moves, as the target."""
    fresh_scene()
    scene = bpy.context.scene
    scene.render.fps, scene.render.fps_base = RATE
    scene.frame_start, scene.frame_end = FIRST, LAST
    face = demo_object(part("demo").actor(1_500), "He ad.L", pieces=True)
    scene.facial_retarget.target = face
    things = list(part("bridge.heads").read_head(face).things)
    for number, thing in enumerate(things[1:]):
        thing.name = f"eye {number}"
        thing.parent = face
    face.location, face.rotation_euler, face.scale = (1, 2, 3), (0.3, 0.2, 1), (2, 2, 2)
    things[1].keyframe_insert("rotation_euler", frame=FIRST)
    things[1].rotation_euler.x = 0.2
    things[1].keyframe_insert("rotation_euler", frame=LAST)
    face.data.uv_layers.new(name="Skin").uv.foreach_set(
        "vector", np.random.default_rng(2).random(2 * len(face.data.loops))
    )
    group = face.vertex_groups.new(name="half")
    group.add(list(range(len(face.data.vertices) // 2)), 0.5, "REPLACE")
    for thing in things[:2]:
        add_keys(thing)
    push_down(things[1])
    visit(FIRST)
    return things


def add_keys(thing: bpy.types.Object) -> None:
    """Keys of all kinds, animated between frames too."""
    rng, keys = np.random.default_rng(3), part("bridge.shape_keys")
    basis = part("bridge.meshes").read_positions(thing.data)
    size = np.ptp(basis, axis=0).max()
    for name in NAMES:
        assert keys.ensure_key(thing, name).name == name
        keys.write_key(keys.find_key(thing, name), basis + 0.05 * size * rng.standard_normal(basis.shape))
    blocks = thing.data.shape_keys.key_blocks
    blocks["beyond"].slider_min, blocks["beyond"].slider_max = -2, 3
    blocks["masked"].vertex_group = "half" if "half" in thing.vertex_groups else ""
    blocks["corrective"].relative_key = blocks["a b"]
    bag = part("bridge.curves").ensure_curves(thing.data.shape_keys, "acting")
    for name in NAMES:
        low, high = (-2, 3) if name == "beyond" else (0, 1)
        if name not in ("driven", "1 Ünï"):
            values = low + (high - low) * rng.random(len(TIMES))
            part("bridge.curves").write_curve(bag, keys.value_path(name), TIMES, values)
    blocks["1 Ünï"].value = 0.4
    blocks["muted"].mute = True
    keys.ensure_key(thing, keys.PREVIEW_KEY)  # the live preview's, which nobody wants in a file
    driver = thing.data.shape_keys.driver_add(keys.value_path("driven")).driver
    driver.type = "SUM"
    target = driver.variables.new().targets[0]
    target.id_type, target.id, target.data_path = "KEY", thing.data.shape_keys, keys.value_path("a b")


def push_down(thing: bpy.types.Object) -> None:
    """Let the NLA play what an action of an object's keys played."""
    animation = thing.data.shape_keys.animation_data
    action, slot = animation.action, animation.action_slot
    animation.action = None
    animation.nla_tracks.new().strips.new("acting", FIRST, action).action_slot = slot


def visit(time: float) -> None:
    """Show a scene frame, with its part."""
    bpy.context.scene.frame_set(int(time // 1), subframe=time % 1)


def in_world(thing: bpy.types.Object) -> np.ndarray:
    """(V, 3) vertices where they stand in the scene."""
    matrix = np.array(thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world)
    return shown(thing) @ matrix[:3, :3].T + matrix[:3, 3]


def played(things: list[bpy.types.Object]) -> dict[str, np.ndarray]:
    """Name -> (F, V, 3) what a person sees."""
    found: dict[str, list[np.ndarray]] = {thing.name: [] for thing in things}
    for time in TIMES:
        visit(time)
        for thing in things:
            found[thing.name].append(in_world(thing))
    return {name: np.array(frames) for name, frames in found.items()}


def key_values(thing: bpy.types.Object) -> dict[str, list[float]]:
    """Name -> values of an object's keys; a muted one is 0."""
    if thing.data.shape_keys is None:
        return {}
    found: dict[str, list[float]] = {name: [] for name in NAMES}
    for time in TIMES:
        visit(time)
        for name in NAMES:
            key = thing.data.shape_keys.key_blocks[name]
            found[name].append(0.0 if key.mute else key.value)
    return found


def export(form: str, path: Path, **options: object) -> None:
    """Export, which must leave everything as it was, and nothing beside the file."""
    before, known, files = everything(), snapshot(), set(path.parent.iterdir())
    assert getattr(bpy.ops.facial_retarget, f"export_{form}")(filepath=str(path), **options) == {"FINISHED"}
    assert not differences(before, everything()), differences(before, everything())
    assert snapshot() == known
    assert set(path.parent.iterdir()) == files | {path}


def read_back(form: str, path: Path) -> None:
    """Import a file into an empty scene of another rate."""
    fresh_scene()
    bpy.context.scene.render.fps = 24
    if form == "gltf":
        bpy.ops.import_scene.gltf(filepath=str(path))
    elif form == "fbx":
        bpy.ops.import_scene.fbx(filepath=str(path), anim_offset=0)
    elif form == "usd":
        bpy.ops.wm.usd_import(filepath=str(path))
    else:
        bpy.ops.wm.alembic_import(filepath=str(path))


def read_times(form: str) -> np.ndarray:
    """The imported scene's frames of our times."""
    seconds = TIMES * RATE[1] / RATE[0]
    if form == "usd":  # Blender takes the file's frames as they are, and not its rate
        return TIMES * 2
    # The importer of FBX takes the file's rate, and then forgets its base.
    return seconds * (30 if form == "fbx" else 24)


def compare(form: str, thing: bpy.types.Object, wanted: np.ndarray) -> None:
    """An imported object looks at each time as it did."""
    size = np.ptp(wanted[0], axis=0).max()
    row = None
    for time, places in zip(read_times(form), wanted, strict=True):
        visit(time)
        found = in_world(thing)
        if form == "gltf":  # vertices are doubled, and in another order
            row = pairs(found, places) if row is None else row
            assert set(row.tolist()) == set(range(len(places))), thing.name
            places = places[row]
        off = np.abs(found - places).max()
        assert off < NEAR * size, (form, thing.name, time, off / size)


def pairs(found: np.ndarray, places: np.ndarray) -> np.ndarray:
    """For each place found the nearest one."""
    from scipy.spatial import cKDTree

    return cKDTree(places).query(found)[1]


def curve_values(thing: bpy.types.Object, name: str) -> np.ndarray:
    """Keyframes of a key's curve, which may go beyond what the importer lets the slider do."""
    path = part("bridge.shape_keys").value_path(name)
    curve = next(c for c in part("bridge.curves").find_curves(thing.data.shape_keys).fcurves if c.data_path == path)
    return np.array([key.co for key in curve.keyframe_points])


class Seen(NamedTuple):
    """What an object of the head is: its mesh's name, vertices and polygons; how it looks at each time, (F, V, 3), with
    and without the key that goes beyond 1; its keys' values, {} without keys.
    """

    mesh: str
    counts: tuple[int, int]
    frames: np.ndarray
    within: np.ndarray
    values: dict[str, list[float]]


def seen(things: list[bpy.types.Object]) -> dict[str, Seen]:
    """By the objects' names."""
    whole, values = played(things), {thing.name: key_values(thing) for thing in things}
    mute_beyond(things, True)
    within = played(things)
    mute_beyond(things, False)
    return {
        thing.name: Seen(
            thing.data.name,
            (len(thing.data.vertices), len(thing.data.polygons)),
            whole[thing.name],
            within[thing.name],
            values[thing.name],
        )
        for thing in things
    }


def mute_beyond(things: list[bpy.types.Object], mute: bool) -> None:
    """Mute the key that goes beyond 1, or not: Blender's importers clamp it to the range that they give its slider."""
    for thing in things:
        for key in thing.data.shape_keys.key_blocks if thing.data.shape_keys else ():
            key.mute = mute if key.name == "beyond" else key.mute


def keys_and_motion_survive_every_format() -> None:
    """Names, counts, shapes, values, frames and rate, between frames too. The head stays untouched."""
    things = head()
    known = seen(things)
    values = known["He ad.L"].values
    assert np.ptp(values["beyond"]) > 2
    assert np.ptp(values["driven"]) > 0.3
    assert values["1 Ünï"][3] > 0.3
    for form, suffix in FORMATS.items():
        export(form, FOLDER / f"head.{suffix}")
    export("usd", FOLDER / "points.usdc", points=True)
    for form, suffix in FORMATS.items():
        read_back(form, FOLDER / f"head.{suffix}")
        for name, was in known.items():
            check(form, imported(form, name, was.mesh), was)
        scene = bpy.context.scene
        if form == "fbx":
            assert (scene.render.fps, round(scene.render.fps_base, 4)) == RATE
        if form == "usd":
            assert (scene.frame_start, scene.frame_end) == (2 * FIRST, 2 * LAST)
            (rate,) = re.findall(r"timeCodesPerSecond = ([\d.]+)", (FOLDER / "head.usda").read_text())
            assert abs(float(rate) - 2 * RATE[0] / RATE[1]) < 1e-4, rate
    the_newer_fbx_importer_misses_quoted_names()
    read_back("usd", FOLDER / "points.usdc")
    for name, was in known.items():
        compare("usd", imported("usd", name, was.mesh), was.frames)


def the_newer_fbx_importer_misses_quoted_names() -> None:
    """As we tell the artist; the file has their curves."""
    fresh_scene()
    bpy.ops.wm.fbx_import(filepath=str(FOLDER / "head.fbx"), anim_offset=0)
    keys = imported("fbx", "He ad.L", "He ad.L").data.shape_keys
    assert keys.key_blocks.keys() == ["Basis", *NAMES]
    paths = {curve.data_path for curve in part("bridge.curves").find_curves(keys).fcurves}
    lost = [name for name in NAMES if part("bridge.shape_keys").value_path(name) not in paths]
    assert lost == ['smile "x"'], lost


def imported(form: str, name: str, mesh: str) -> bpy.types.Object:
    """The object that has come of one of ours; Blender puts USD's meshes below an empty that has the object's name."""
    if form == "usd":
        name = part("export_losses").usd_names([mesh])[mesh]
    elif form == "alembic":
        name = name.replace(" ", "_").replace(".", "_")
    found = [thing for thing in bpy.data.objects if thing.type == "MESH" and name in (thing.name, thing.data.name)]
    assert len(found) == 1, (form, name, bpy.data.objects.keys())
    return found[0]


def check(form: str, thing: bpy.types.Object, was: Seen) -> None:
    """An imported object is what it was."""
    if form != "gltf":  # it has triangles, and doubles vertices
        assert (len(thing.data.vertices), len(thing.data.polygons)) == was.counts, (form, thing.name)
    if form in ("gltf", "fbx"):
        assert thing.data.name == was.mesh, (form, thing.data.name)
    if form == "alembic":
        assert thing.data.shape_keys is None
        compare(form, thing, was.frames)
        return
    if was.values:
        check_keys(form, thing, was.values)
    mute_beyond([thing], True)
    compare(form, thing, was.within)


def check_keys(form: str, thing: bpy.types.Object, values: dict[str, list[float]]) -> None:
    """Names, order and curves of an imported object's keys."""
    safe = part("export_losses").usd_names(NAMES)
    called = [safe[name] if form == "usd" else name for name in NAMES]
    assert thing.data.shape_keys.key_blocks.keys() == ["Basis", *called], (
        form,
        thing.data.shape_keys.key_blocks.keys(),
    )
    times = read_times(form)
    for old, new in zip(NAMES, called, strict=True):
        curve = curve_values(thing, new)
        assert np.abs(curve[[0, -1], 0] - times[[0, -1]]).max() < 1e-3, (form, old, curve)
        # Sub-frames are a half apart, and values go from 0 to 1 there; files count float32 seconds.
        found = np.interp(times, curve[:, 0], curve[:, 1])
        np.testing.assert_allclose(found, values[old], atol=5e-5, err_msg=f"{form}: {old}")


def armatures_go_along_and_other_modifiers_stay_behind() -> None:
    """Bones move what shape keys move; Alembic and USD's vertices are those of all modifiers."""
    things = head()
    face = things[0]
    size = np.ptp(part("bridge.meshes").read_positions(face.data), axis=0).max()
    rig = bpy.data.objects.new("rig", bpy.data.armatures.new("rig"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone = rig.data.edit_bones.new("neck")
    bone.tail = (0, size, 0)
    bpy.ops.object.mode_set(mode="OBJECT")
    rig.matrix_world = face.matrix_world
    rig.pose.bones["neck"].rotation_mode = "XYZ"
    for frame, angle in ((FIRST, 0.0), (LAST, 0.5)):
        rig.pose.bones["neck"].rotation_euler.z = angle
        rig.pose.bones["neck"].keyframe_insert("rotation_euler", frame=frame)
    face.vertex_groups.new(name="neck").add(list(range(len(face.data.vertices))), 1.0, "REPLACE")
    face.modifiers.new("Bones", "ARMATURE").object = rig
    mute_beyond(things, True)
    wanted = played([face])[face.name]
    assert np.abs(wanted[-1] - wanted[0]).max() > 0.2 * size
    face.modifiers.new("Finer", "SUBSURF")
    finer = played([face])[face.name]
    lost = [str(loss) for loss in part("export_losses").export_losses("FBX", face, bpy.context.scene)]
    assert "He ad.L goes without what its modifiers do (Finer)" in lost[0], lost
    rig.hide_select = True
    with refused("'rig' cannot be selected"):
        bpy.ops.facial_retarget.export_fbx(filepath=str(FOLDER / "rigged.fbx"))
    rig.hide_select = False
    rig.hide_set(True)
    with refused("'rig' is hidden"):
        bpy.ops.facial_retarget.export_fbx(filepath=str(FOLDER / "rigged.fbx"))
    rig.hide_set(False)
    for form, suffix in FORMATS.items():
        export(form, FOLDER / f"rigged.{suffix}")
    export("usd", FOLDER / "rigged_points.usdc", points=True)
    for form, suffix in FORMATS.items():
        read_back(form, FOLDER / f"rigged.{suffix}")
        thing = imported(form, "He ad.L", "He ad.L")
        if form != "alembic":
            assert (
                "neck" in next(one for one in bpy.data.objects if one.type == "ARMATURE" and one.pose.bones).pose.bones
            )
            mute_beyond([thing], True)
        compare(form, thing, finer if form == "alembic" else wanted)
    read_back("usd", FOLDER / "rigged_points.usdc")
    compare("usd", imported("usd", "He ad.L", "He ad.L"), finer)


def closing_the_steps_leaves_everything_as_it_was() -> None:
    """Esc, at any moment before Blender's exporter runs."""
    face = head()[0]
    exporting = part("bridge.export.exporting")
    before = everything()
    wish = exporting.ExportWish("FBX", FOLDER / "stopped.fbx")
    for turns in (1, 4, len(TIMES) + 1):
        for steps in (
            exporting.export_steps(bpy.context, face, wish, str),
            exporting.prepare_steps(bpy.context, face),
        ):
            for _ in range(turns):
                next(steps)
            steps.close()
            assert not differences(before, everything()), (turns, differences(before, everything()))
    assert not list(FOLDER.glob("*stopped*"))


def caches_and_absolute_keys_are_exported_as_far_as_they_go() -> None:
    """A cache goes to Alembic and USD, and is missed elsewhere; absolute keys become relative ones."""
    things = head()
    face = things[1]
    bpy.context.scene.facial_retarget.target = face
    face.animation_data_clear()
    face.shape_key_clear()
    basis = part("bridge.meshes").read_positions(face.data)
    frames = basis + 0.1 * np.random.default_rng(4).standard_normal((LAST - FIRST + 1, *basis.shape)).astype(np.float32)
    part("bridge.bakes.frames").write_frames(face, frames, FIRST, absolute=True)
    absolute = played([face])[face.name]
    assert np.abs(absolute[1] - absolute[0]).max() > 0.05
    key = face.data.shape_keys.key_blocks[-1]
    key.interpolation = "KEY_BSPLINE"
    with refused("'frame_0009'", "KEY_BSPLINE", "KEY_LINEAR"):
        bpy.ops.facial_retarget.export_gltf(filepath=str(FOLDER / "absolute.glb"))
    key.interpolation = "KEY_LINEAR"
    mesh = face.data.name
    export("gltf", FOLDER / "absolute.glb")
    part("files.frames").write_frames(frames, FOLDER / "cache.pc2")
    caches, whole = part("bridge.bakes.cache"), part("bridge.heads").read_head(face)
    caches.play_caches(whole, {face: caches.Place(FOLDER / "cache.pc2")}, range(FIRST, LAST + 1))
    cached = played([face])[face.name]
    lost = [str(loss) for loss in part("export_losses").export_losses("GLTF", face, bpy.context.scene)]
    assert "The motion that Facial Retarget plays on eye 0 is lost: glTF takes shape keys only" in lost[0], lost
    export("alembic", FOLDER / "cache.abc", samples=2)
    export("usd", FOLDER / "cache.usdc", samples=2, points=True)
    read_back("gltf", FOLDER / "absolute.glb")
    found = imported("gltf", "eye 0", mesh)
    assert found.data.shape_keys.key_blocks.keys()[1:] == [f"frame_{frame:04d}" for frame in range(FIRST, LAST + 1)]
    compare("gltf", found, absolute)
    for form, name in (("alembic", "cache.abc"), ("usd", "cache.usdc")):
        read_back(form, FOLDER / name)
        compare(form, imported(form, "eye 0", mesh), cached)


def what_is_lost_is_said_before_anything_is_written() -> None:
    """In words, by script and panel alike; a script may refuse it; a failing exporter leaves everything as it was."""
    things = head()
    face, scene = things[0], bpy.context.scene
    exporting, losses = part("bridge.export.exporting"), part("export_losses")
    wanted = {
        "GLTF": ("triangles", "29.970", "Driven shape keys become curves: driven", "at 0: muted", "beyond", "UV maps"),
        "FBX": ("Driven", "Muted", "FBX carries values", 'have a " in their names: smile "x"'),
        "USD": ("objects otherwise: He ad.L → He_ad_L", "a b → a_b", "called st"),
        "ALEMBIC": ("moving vertices", "... (11)", "He ad.L → He_ad_L"),
    }
    for form, words in wanted.items():
        said = " | ".join(str(loss) for loss in losses.export_losses(form, face, scene))
        assert all(word in said for word in words), (form, said)
    still = demo_object(part("demo").actor(1_500), "still")
    assert "Nothing of still will move" in str(losses.export_losses("FBX", still, scene)[0])
    bpy.data.objects.remove(still)
    scene.frame_end = LAST - 2
    said = str(losses.export_losses("FBX", face, scene)[0])
    assert said == "Only the scene's frames 5 to 7 are exported: the keyframes reach from 5 to 9", said
    scene.frame_end = LAST

    told: list[object] = []
    for samples, missed in ((0, False), (1, True), (2, False), (3, True), (4, False)):
        told.clear()
        wish = exporting.ExportWish("FBX", FOLDER / "samples.fbx", samples)
        part("bridge.background").finished(exporting.export_steps(bpy.context, face, wish, told.append))
        assert (losses.UNSAMPLED in told) == missed, (samples, told)
    told.clear()
    path = FOLDER / "told.fbx"
    path.write_text("an earlier file")

    def failing(*_: object) -> set[str]:
        assert len(told) == 4, told
        assert scene.facial_retarget.target.name != "He ad.L"
        raise RuntimeError("Error: out of paint")

    kept = part("bridge.export.formats")._call
    part("bridge.export.formats")._call = failing
    before, files = everything(), set(FOLDER.iterdir())
    with refused(f"{path} cannot be written: Blender's FBX exporter has failed: out of paint"):
        part("bridge.background").finished(
            exporting.export_steps(bpy.context, face, exporting.ExportWish("FBX", path), told.append)
        )
    part("bridge.export.formats")._call = kept
    assert not differences(before, everything()), differences(before, everything())
    assert set(FOLDER.iterdir()) == files
    assert path.read_text() == "an earlier file"

    with refused("FBX would lose something of 'He ad.L', and nothing was written"):
        bpy.ops.facial_retarget.export_fbx(filepath=str(path), only_lossless=True)
    with refused("head.gltf is no name for glTF, expected one that ends in .glb"):
        bpy.ops.facial_retarget.export_gltf(filepath=str(FOLDER / "head.gltf"))
    with refused("there is no folder"):
        bpy.ops.facial_retarget.export_usd(filepath=str(FOLDER / "nowhere" / "head.usdc"))
    face.hide_set(True)
    with refused("'He ad.L' is hidden"):
        bpy.ops.facial_retarget.export_fbx(filepath=str(path))
    face.hide_set(False)
    assert path.read_text() == "an earlier file"
    face.data.shape_keys.key_blocks["driven"].driver_remove("value")
    for name in ("muted", "beyond", 'smile "x"'):
        for thing in things[:2]:
            thing.shape_key_remove(thing.data.shape_keys.key_blocks[name])
    things[1].data.shape_keys.key_blocks["driven"].driver_remove("value")
    assert bpy.ops.facial_retarget.export_fbx(filepath=str(path), only_lossless=True) == {"FINISHED"}


def a_full_disk_leaves_an_earlier_file_and_blender_alive() -> None:
    """Blender's USD exporter says nothing of it, its Alembic exporter would end Blender."""
    head()
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    for form, suffix in FORMATS.items():
        path = FOLDER / f"full.{suffix}"
        path.write_text("an earlier file")
        before, files = everything(), set(FOLDER.iterdir())
        resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, limits[1]))
        try:
            with refused(f"{path} cannot be written"):
                getattr(bpy.ops.facial_retarget, f"export_{form}")(filepath=str(path))
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        assert not differences(before, everything()), differences(before, everything())
        assert set(FOLDER.iterdir()) == files
        assert path.read_text() == "an earlier file"


def a_prepared_head_is_plain_and_moves_alike() -> None:
    """Keys relative to the Basis, each keyed from the first frame to the last, in one action, without drivers."""
    things = head()
    wanted, values = played(things), key_values(things[0])
    kept = [name for name in everything() if name.startswith(("object", "mesh", "keys"))]
    before = everything()
    for _ in range(2):  # the second time replaces the first
        assert bpy.ops.facial_retarget.prepare_export() == {"FINISHED"}
        after = everything()
        changed = [name for name in kept if before[name] != after[name] and name.startswith(("mesh", "keys"))]
        assert not changed, changed
        copies = list(bpy.data.collections["Export"].objects)
        assert sorted(copy.name for copy in copies) == sorted(f"{thing.name}_export" for thing in things)
        assert (len(bpy.data.meshes), len(bpy.data.shape_keys)) == (2 * len(things), 4), bpy.data.meshes.keys()
    assert set(bpy.context.selected_objects) == set(copies)
    by_name = {copy.name.removesuffix("_export"): copy for copy in copies}
    actions = set()
    for thing in things[:2]:
        keys = by_name[thing.name].data.shape_keys
        actions.add(keys.animation_data.action)
        assert keys.use_relative
        assert not len(keys.animation_data.drivers)
        for name in NAMES:
            key = keys.key_blocks[name]
            assert (key.relative_key, key.mute, key.vertex_group) == (keys.reference_key, False, ""), name
            curve = curve_values(by_name[thing.name], name)
            assert (curve[0, 0], curve[-1, 0]) == (FIRST, LAST), (name, curve)
    assert len(actions) == 1
    found = played(copies)
    size = np.ptp(wanted["He ad.L"][0], axis=0).max()
    for name, frames in wanted.items():
        assert np.abs(found[f"{name}_export"] - frames).max() < NEAR * size, name
    plain = key_values(by_name["He ad.L"])
    for name in NAMES:
        np.testing.assert_allclose(plain[name], values[name], atol=1e-6, err_msg=name)
    assert len(curve_values(by_name["He ad.L"], "1 Ünï")) == 2  # what does not change needs no more


keys_and_motion_survive_every_format()
armatures_go_along_and_other_modifiers_stay_behind()
caches_and_absolute_keys_are_exported_as_far_as_they_go()
what_is_lost_is_said_before_anything_is_written()
closing_the_steps_leaves_everything_as_it_was()
a_full_disk_leaves_an_earlier_file_and_blender_alive()
a_prepared_head_is_plain_and_moves_alike()
