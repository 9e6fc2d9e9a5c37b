"""Names with quotes, brackets, backslashes, letters of several bytes, and as long as Blender keeps them."""

import csv
import json
import sys
from pathlib import Path

import bpy
import numpy as np
from stage import bake_as, empty_scene, enable, grid, part, refused, shown

FOLDER = Path(sys.argv[-1])
SUFFIXES = {"pc2": "pc2", "mdd": "mdd", "alembic": "abc", "usd": "usdc"}
KINDS = ("frames", "compact", "rig", *SUFFIXES)
FIRST, COUNT = 3, 4
KEYS = ('it\'s "said" \\ back', "dot.001", 31 * "ä" + "x", '"]', "[0].value", 63 * "k")
"""Of shape keys; two of them as long as can be."""
LONG = 63 if bpy.app.version < (5, 0) else 255
"""Bytes that Blender keeps of an object's name."""


def odd(end: str) -> str:
    """A name of an object as long as can be, of everything."""
    name = f'it\'s "said" \\ [0]./ % # {end} '
    return name + (LONG - len(name)) // 2 * "ä" + (LONG - len(name)) % 2 * "x"


def head() -> bpy.types.Object:
    """A face and three parts, whose names are one name on some systems, with the artist's own keys, one animated."""
    empty_scene()
    face = grid(odd("face"), 6)
    for side, name in enumerate(("a b", "a_b", "A_B"), start=3):
        face.facial_retarget.parts.add().thing = grid(name, side)
    assert len(face.name.encode()) == LONG, face.name
    shape_keys = part("bridge.shape_keys")
    for thing in (face, *part("bridge.heads").head_parts(face)):
        rest = part("bridge.meshes").read_positions(thing.data)
        for number, name in enumerate(KEYS):
            moved = rest.copy()
            moved[number :: len(KEYS), number % 3] += 1
            shape_keys.write_key(shape_keys.ensure_key(thing, name), moved)
        assert thing.data.shape_keys.key_blocks.keys()[1:] == [*KEYS]
    return face


def played(face: bpy.types.Object, time: float) -> np.ndarray:
    """(V, 3) the head at a scene frame."""
    bpy.context.scene.frame_set(int(time // 1), subframe=time % 1)
    return np.concatenate([shown(thing) for thing in (face, *part("bridge.heads").head_parts(face))])


def acted(face: bpy.types.Object) -> np.ndarray:
    """(COUNT, V, 3) frames that the head's own keys can reach, each object on its own."""
    read = part("bridge.heads").read_head(face)
    frames = np.repeat(read.face.mesh.vertices[None].astype(np.float32), COUNT, axis=0)
    shapes = read.displacements(KEYS)
    weights = np.random.default_rng(2).uniform(0, 1, (COUNT, len(KEYS))).astype(np.float32)
    return frames + np.einsum("fk,kvi->fvi", weights, shapes)


def every_bake_of_a_head_with_odd_names() -> None:
    """Plays what was baked, on each object its own, before and after saving; the artist's keys stay."""
    for kind in KINDS:
        face = head()
        frames, times = acted(face), [FIRST + i for i in range(COUNT)]
        cache = FOLDER / f"it's \"a\" 'cache' ä.{SUFFIXES.get(kind, '')}"
        bake_as(face, kind, frames, times, cache, 'it\'s "#" \\', smoothness=0.0, sparsity=0.0, tolerance=0.002)
        most = {"rig": 0.01, "compact": 0.02}.get(kind, 1e-5)
        for after in ("bake", "saving"):
            for time, frame in zip(times, frames, strict=True):
                np.testing.assert_allclose(played(face, time), frame, atol=most, err_msg=f"{kind} {time} {after}")
            for thing in (face, *part("bridge.heads").head_parts(face)):
                assert thing.data.shape_keys.key_blocks.keys()[1 : 1 + len(KEYS)] == [*KEYS], kind
            saved = str(FOLDER / "odd.blend")
            bpy.ops.wm.save_as_mainfile(filepath=saved)
            bpy.ops.wm.open_mainfile(filepath=saved)
            enable()
            face = next(thing for thing in bpy.data.objects if thing.facial_retarget.parts)
        if kind == "frames":
            names = face.data.shape_keys.key_blocks.keys()[1 + len(KEYS) :]
            assert names == [f'it\'s "{time}" \\' for time in times], names


def patterns_as_long_as_can_be() -> None:
    """A byte more is refused, whichever frame it is of; numbers below zero and of parts of frames are told apart."""
    face = grid("face")
    pattern = 29 * "ä" + "##x"
    times = [-1.0, -0.5, 0, 0.5, 1]
    frames = np.stack([shown(face) + np.float32([0, 0, number]) for number in range(len(times))])
    bake_as(face, "frames", frames, times, pattern=pattern)
    start = 29 * "ä"
    wanted = [start + digits + "x" for digits in ("-1", "-0.5", "00", "00.5", "01")]
    assert face.data.shape_keys.key_blocks.keys()[1:] == wanted
    for time, frame in zip(times, frames, strict=True):
        np.testing.assert_allclose(played(face, time), frame, atol=1e-6)
    with refused("64 bytes", "at most 63"):
        bake_as(face, "frames", frames[:3], [9_999, 10_000, 10_001], pattern=29 * "ä" + "#x")
    with refused("line break"):
        bake_as(face, "frames", frames, times, pattern="frame\n#")


def own_keys_are_never_written_over() -> None:
    """Whatever bake it is whose key would have the name of one of the artist's."""
    for kind, name, how in (
        ("frames", "frame_0004", {}),
        ("compact", "retargeted_1", {}),
        ("rig", "retargeted_residual_1", {"residual": 2}),
    ):
        empty_scene()
        face = grid("face")
        rest = part("bridge.meshes").read_positions(face.data)
        keys = part("bridge.shape_keys")
        keys.write_key(keys.ensure_key(face, name), rest + 1)
        frames = np.stack([rest + np.float32([0, 0, i]) for i in range(4)])
        with refused(repr(name)):
            bake_as(face, kind, frames, [2, 3, 4, 5], **how)
        bake_as(face, "pc2", frames, [2, 3, 4, 5], FOLDER / "own.pc2")
        assert face.data.shape_keys.key_blocks.keys() == ["Basis", name]
        np.testing.assert_allclose(keys.key_displacement(keys.find_key(face, name)), 1, atol=1e-6)


def tables_keep_odd_names() -> None:
    """The curves of keys, as a table and as a document."""
    face = head()
    task = bpy.context.scene.facial_retarget
    task.source, task.target = face.facial_retarget.parts[0].thing, face
    face.facial_retarget.parts.clear()
    for number, name in enumerate(KEYS):
        face.data.shape_keys.key_blocks[name].value = number / 8
    for suffix in ("csv", "json"):
        path = str(FOLDER / f'cur"ves.{suffix}')
        assert bpy.ops.facial_retarget.export_curves(filepath=path, frame_start=1, frame_end=2) == {"FINISHED"}
    with open(FOLDER / 'cur"ves.csv', newline="", encoding="utf-8") as file:
        head_row, first, _ = csv.reader(file)
    assert [float(first[head_row.index(name)]) for name in KEYS] == [number / 8 for number in range(len(KEYS))]
    document = json.dumps(json.loads((FOLDER / 'cur"ves.json').read_text("utf-8")), ensure_ascii=False)
    assert all(json.dumps(name, ensure_ascii=False) in document for name in KEYS)
    bpy.context.view_layer.objects.active = face
    path = FOLDER / "shapes.json"
    assert bpy.ops.facial_retarget.save_shapes(filepath=str(path)) == {"FINISHED"}
    assert set(KEYS) <= set(part("files.shape_files").read_shapes(path, part("bridge.meshes").neutral_mesh(face)).names)


def textured(face: object, name: str) -> bpy.types.Object:
    """A built-in face as an object with points and UVs."""
    file = part("files.mesh_file").MeshFile(face.face.mesh, face.counts, face.corners, face.uvs[face.corners])
    made = part("bridge.meshes").new_face(name, file)
    part("bridge.points.points").write_points(made, face.face.points)
    return made


def maps_of_a_face_with_odd_names() -> None:
    """Nodes name the UV map; a level's object is replaced, not doubled, however long its name; drivers work."""
    empty_scene()
    actor = part("demo").actor(1_500)
    task = bpy.context.scene.facial_retarget
    task.source, task.target = textured(actor, odd("source")), textured(actor, odd("target"))
    task.hierarchical.levels = 1
    bpy.context.scene.frame_start = bpy.context.scene.frame_end = 1
    task.target.data.materials.append(bpy.data.materials.new(odd("material")))
    task.target.data.uv_layers[0].name = KEYS[2]
    maps = task.normal_maps
    maps.folder, maps.pixels = str(FOLDER / 'it\'s "maps" ä #1'), 64
    assert bpy.ops.facial_retarget.make_normal_maps() == {"FINISHED"}
    tree = task.target.data.materials[0].node_tree
    assert {node.uv_map for node in tree.nodes if node.type in ("UVMAP", "NORMAL_MAP")} == {KEYS[2]}
    (image,) = (node.image for node in tree.nodes if node.type == "TEX_IMAGE")
    assert tuple(image.size) == (64, 64)

    maps.light, maps.level = "LEVEL", 1
    counts = []
    for _ in range(2):
        assert bpy.ops.facial_retarget.make_normal_maps() == {"FINISHED"}
        assert bpy.ops.facial_retarget.show_levels() == {"FINISHED"}
        assert bpy.ops.facial_retarget.show_base() == {"FINISHED"}
        counts.append(len(bpy.data.objects))
    assert counts[0] == counts[1], [thing.name for thing in bpy.data.objects]

    fine = task.target.copy()
    fine.data = task.target.data.copy()
    bpy.context.scene.collection.objects.link(fine)
    keys = part("bridge.shape_keys")
    for thing in (task.target, fine):
        for name in (KEYS[0], KEYS[2]):
            keys.write_key(keys.ensure_key(thing, name), actor.face.examples["joy"])
    kit = task.wrinkle_kit
    kit.detail, kit.fine, kit.folder, kit.pixels, kit.least = "OBJECT", fine, str(FOLDER / "kit"), 64, 0.0
    assert bpy.ops.facial_retarget.make_wrinkle_kit() == {"FINISHED"}
    bpy.context.view_layer.update()
    drivers = [
        curve
        for tree in [*bpy.data.node_groups, *(material.node_tree for material in bpy.data.materials)]
        for curve in (tree.animation_data.drivers if tree and tree.animation_data else ())
    ]
    paths = {target.data_path for curve in drivers for v in curve.driver.variables for target in v.targets}
    assert paths == {keys.value_path(name) for name in (KEYS[0], KEYS[2])}, paths
    assert all(curve.is_valid and curve.driver.is_valid for curve in drivers)

    task.target.data.uv_layers[0].name = 70 * "u"
    if len(task.target.data.uv_layers[0].name) > 63:
        maps.light = "TARGET"
        for operator in (bpy.ops.facial_retarget.make_normal_maps, bpy.ops.facial_retarget.make_wrinkle_kit):
            with refused("at most 63", "cannot name it"):
                operator()


every_bake_of_a_head_with_odd_names()
patterns_as_long_as_can_be()
own_keys_are_never_written_over()
tables_keep_odd_names()
maps_of_a_face_with_odd_names()
