"""Wrinkle kits: materials that wrinkle as the sliders say, after save and reopen, and gone again without a trace."""

import json
import sys
from pathlib import Path

import bpy
import numpy as np
from stage import empty_scene, part, refused

FOLDER = Path(sys.argv[-1])
SIZE = 128
LEFT, RIGHT = "left", 'the "right" \\'


def sheet(name: str, side: int, fine: bool) -> bpy.types.Object:
    """A flat skin with UVs and two keys that push it together on either side; a fine one folds there."""
    x, y = np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side))
    places = np.stack([x, y, np.zeros_like(x)], axis=-1).reshape(-1, 3)
    if fine:
        places[:, 2] += 0.004 * np.sin(12 * places[:, 0])
    cells = np.arange(side * side).reshape(side, side)
    corners = np.stack([cells[:-1, :-1], cells[:-1, 1:], cells[1:, 1:], cells[1:, :-1]], axis=-1).ravel()
    made = part("bridge.meshes").new_object(name, places, np.full(len(corners) // 4, 4), corners)
    made.data.shade_smooth()
    uvs = (places[corners, :2] * 0.49 + 0.5).astype(np.float32)
    made.data.uv_layers.new(name="Skin").uv.foreach_set("vector", uvs.ravel())
    made.shape_key_add(name="Basis", from_mix=False)
    for key, middle in ((LEFT, -0.5), (RIGHT, 0.5)):
        near = np.clip(1 - ((places[:, 0] - middle) ** 2 + places[:, 1] ** 2) / 0.16, 0, None) ** 2
        moved = places.copy()
        moved[:, 1] -= 0.15 * places[:, 1] * near
        if fine:
            moved[:, 2] += 0.02 * np.sin(25 * places[:, 1]) * near
        block = made.shape_key_add(name=key, from_mix=False)
        block.value = 0.0
        part("bridge.shape_keys").write_key(block, moved)
    return made


def sheets(depth: str = "png16", convention: str = "opengl") -> bpy.types.Object:
    """A light sheet as the target, a fine one that stands turned as high-poly object, and a folder."""
    empty_scene()
    light, fine = sheet("skin", 21, False), sheet("sculpt", 161, True)
    for thing in (light, fine):
        thing.rotation_euler, thing.location = (0.3, -0.2, 0.5), (1.0, 2.0, 3.0)
    bpy.context.view_layer.update()
    task = bpy.context.scene.facial_retarget
    task.target, task.wrinkle_kit.detail, task.wrinkle_kit.fine = light, "OBJECT", fine
    task.wrinkle_kit.folder = str(FOLDER / f"{depth}_{convention}")
    task.wrinkle_kit.pixels, task.wrinkle_kit.depth, task.wrinkle_kit.convention = SIZE, depth, convention
    bpy.context.view_layer.objects.active = light
    return light


def values_of(image: bpy.types.Image) -> np.ndarray:
    """(H, W, 4) of an image, row 0 at the bottom."""
    flat = np.empty(4 * image.size[0] * image.size[1], np.float32)
    image.pixels.foreach_get(flat)
    return flat.reshape(image.size[1], image.size[0], 4)


def blended(folder: Path, values: dict[str, float]) -> np.ndarray:
    """Unit normals (H, W, 3), green up, that the document says a folder's pictures are at some values."""
    said = json.loads((folder / "wrinkles.json").read_text())

    def picture(name: str) -> np.ndarray:
        image = bpy.data.images.load(str(folder / name))
        image.colorspace_settings.name, image.alpha_mode = "Non-Color", "CHANNEL_PACKED"
        found = values_of(image)
        bpy.data.images.remove(image)
        return found

    neutral = 2 * picture(said["neutral"])[..., :3] - 1
    slope = neutral[..., :2] / np.maximum(neutral[..., 2:], 0.1)
    for key in said["keys"]:
        pair = 2 * picture(key["wrinkle"]["file"])[..., ["RGBA".index(c) for c in key["wrinkle"]["channels"]]] - 1
        mask = picture(key["mask"]["file"])[..., "RGBA".index(key["mask"]["channel"])]
        weight = values.get(key["name"], 0.0) * mask / np.sqrt(np.maximum(1 - (pair**2).sum(axis=-1), 0.01))
        slope = slope + weight[..., None] * pair
    normal = np.concatenate([slope, np.ones_like(slope[..., :1])], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    return normal * [1, -1 if said["green"] == "down" else 1, 1]


def shaded(thing: bpy.types.Object) -> np.ndarray:
    """(H, W, 3) normals in tangent space that Cycles makes of an object's material as its keys stand."""
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.samples = "CYCLES", 1
    tree = thing.material_slots[0].material.node_tree
    image = bpy.data.images.new("shaded", SIZE, SIZE, float_buffer=True, is_data=True)
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    tree.nodes.active = node
    for one in scene.objects:
        one.select_set(one == thing)
        one.hide_render = one != thing
    bpy.context.view_layer.objects.active = thing
    bpy.ops.object.bake(type="NORMAL", margin=0)
    normals = 2 * values_of(image)[..., :3] - 1
    tree.nodes.remove(node)
    bpy.data.images.remove(image)
    return normals


def check_shading(thing: bpy.types.Object, folder: Path, most: float) -> None:
    """The shader shows what the pictures are meant to be, at values of the sliders alone."""
    keys = thing.data.shape_keys.key_blocks
    neutral = blended(folder, {})
    for values in ({}, {LEFT: 1.0}, {LEFT: 0.5, RIGHT: 0.8}):
        for name in (LEFT, RIGHT):
            keys[name].value = values.get(name, 0.0)
        wanted, found = blended(folder, values), shaded(thing)
        inside = (slice(4, -4), slice(4, -4))
        agree = np.einsum("hwi,hwi->hw", wanted, found)[inside] / np.linalg.norm(found[inside], axis=-1)
        off = np.degrees(np.arccos(np.clip(agree, -1, 1)))
        assert off.max() < most, (values, off.max())
        changed = np.degrees(np.arccos(np.clip(np.einsum("hwi,hwi->hw", wanted, neutral), -1, 1))).max()
        assert (changed > 8) == bool(values), changed


def sliders_move_the_wrinkles() -> None:
    """In Cycles as the document says, for every depth and both conventions, also from a saved file without scripts."""
    for depth, convention, most in (("png8", "directx", 1.0), ("exr", "opengl", 0.3), ("png16", "opengl", 0.3)):
        skin = sheets(depth, convention)
        assert bpy.ops.facial_retarget.make_wrinkle_kit() == {"FINISHED"}
        check_shading(skin, FOLDER / f"{depth}_{convention}", most)
    bpy.ops.wm.save_as_mainfile(filepath=str(FOLDER / "kit.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(FOLDER / "kit.blend"), use_scripts=False)
    skin = bpy.data.objects["skin"]
    drivers = skin.material_slots[0].material.node_tree.animation_data.drivers
    assert len(drivers) == 2
    assert all(curve.driver.is_valid and curve.driver.type == "SUM" for curve in drivers)
    check_shading(skin, FOLDER / "png16_opengl", 0.3)
    # A renamed key goes on.
    skin.data.shape_keys.key_blocks[RIGHT].name = "renamed"
    skin.data.shape_keys.key_blocks["renamed"].value = 0.7
    bpy.context.view_layer.update()
    tree = skin.material_slots[0].material.evaluated_get(bpy.context.evaluated_depsgraph_get()).node_tree
    assert abs(tree.nodes["Wrinkle Kit"].inputs[2].default_value - 0.7) < 1e-6


def what_the_artist_has_wired_stays() -> None:
    """A normal map of one's own stays and is named; bumps get the wrinkles beneath them; making it again is once."""
    skin = sheets()
    trees = {}
    for name in ("own", "bump", "plain"):
        material = bpy.data.materials.new(name)
        if bpy.app.version < (5, 0):
            material.use_nodes = True
        skin.data.materials.append(material)
        trees[name] = material.node_tree
    shader = {name: next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED") for name, tree in trees.items()}
    for name, kind in (("own", "ShaderNodeNormalMap"), ("bump", "ShaderNodeBump")):
        node = trees[name].nodes.new(kind)
        trees[name].links.new(node.outputs["Normal"], shader[name].inputs["Normal"])
    before = {name: len(tree.nodes) for name, tree in trees.items()}
    for _ in range(2):
        assert bpy.ops.facial_retarget.make_wrinkle_kit() == {"FINISHED"}
        assert shader["own"].inputs["Normal"].links[0].from_node.type == "NORMAL_MAP"
        bump = shader["bump"].inputs["Normal"].links[0].from_node
        assert (bump.type, bump.inputs["Normal"].links[0].from_node.type) == ("BUMP", "GROUP")
        assert shader["plain"].inputs["Normal"].links[0].from_node.type == "GROUP"
        added = {name: len(tree.nodes) - before[name] for name, tree in trees.items()}
        assert added == {"own": 0, "bump": 1, "plain": 1}
        assert len(bpy.data.node_groups) == 2
        assert len([image for image in bpy.data.images if image.source == "FILE"]) == 3
    assert bpy.ops.facial_retarget.remove_wrinkle_kit() == {"FINISHED"}
    assert {name: len(tree.nodes) for name, tree in trees.items()} == before
    assert not bpy.data.node_groups
    assert not [image for image in bpy.data.images if image.source == "FILE"]
    assert not any(tree.animation_data and tree.animation_data.drivers for tree in trees.values())
    assert (FOLDER / "png16_opengl" / "wrinkles.json").exists()


def gltf_gets_the_neutrals_map() -> None:
    """An exporter that knows no node groups takes the normal map that fits a still face."""
    import addon_utils

    sheets()
    addon_utils.enable("io_scene_gltf2")
    assert bpy.ops.facial_retarget.make_wrinkle_kit() == {"FINISHED"}
    bpy.ops.export_scene.gltf(filepath=str(FOLDER / "skin.glb"))
    data = (FOLDER / "skin.glb").read_bytes()
    said = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    assert [image["name"] for image in said["images"]] == ["neutral"], said["images"]
    assert [material["normalTexture"]["index"] for material in said["materials"]] == [0]


def udim_tiles_have_pictures_of_their_own() -> None:
    """A sheet whose right half lies in tile 1002 shades there as in tile 1001."""
    skin = sheets()
    layer = skin.data.uv_layers["Skin"].uv
    flat = np.empty(2 * len(layer), np.float32)
    layer.foreach_get("vector", flat)
    uvs = flat.reshape(-1, 4, 2)
    uvs[uvs[..., 0].mean(axis=1) > 0.5] += [1, 0]
    layer.foreach_set("vector", uvs.ravel())
    skin.data.update()
    bpy.context.scene.facial_retarget.wrinkle_kit.folder = str(FOLDER / "tiles")
    assert bpy.ops.facial_retarget.make_wrinkle_kit() == {"FINISHED"}
    names = {path.name for path in (FOLDER / "tiles").iterdir()}
    kinds = ("neutral", "wrinkle_1", "mask_1")
    assert names == {f"{kind}.{tile}.png" for kind in kinds for tile in (1001, 1002)} | {"wrinkles.json"}
    (group,) = {node.node_tree for node in skin.material_slots[0].material.node_tree.nodes if node.type == "GROUP"}
    images = {node.image for node in group.nodes if node.type == "TEX_IMAGE"}
    assert {image.source for image in images} == {"TILED"}
    assert all([tile.number for tile in image.tiles] == [1001, 1002] for image in images)
    # What is baked lies in one tile, by a second UV map; the kit goes on reading its own.
    whole = skin.data.uv_layers.new(name="Bake")
    uvs[uvs[..., 0].mean(axis=1) > 1] -= [1, 0]
    whole.uv.foreach_set("vector", uvs.ravel())
    skin.data.uv_layers.active, whole.active_render = whole, True
    for name in (LEFT, RIGHT):
        skin.data.shape_keys.key_blocks[name].value = 1.0
    wanted, found = blended(FOLDER / "png16_opengl", {LEFT: 1.0, RIGHT: 1.0}), shaded(skin)
    agree = np.einsum("hwi,hwi->hw", wanted, found) / np.linalg.norm(found, axis=-1)
    off = np.degrees(np.arccos(np.clip(agree, -1, 1)))
    middle = SIZE // 2
    assert max(off[4:-4, 4 : middle - 4].max(), off[4:-4, middle + 4 : -4].max()) < 0.5, off.max()


def a_level_gets_keys_and_wrinkles_as_the_command_line_makes_them() -> None:
    """The retargeted kit: a light object with sliders, and the same pictures from the saved clone job."""
    empty_scene()
    demo, files = part("demo"), part("files.mesh_file")
    task = bpy.context.scene.facial_retarget
    for role, face in (("source", demo.actor(8_000)), ("target", demo.child())):
        file = files.MeshFile(face.face.mesh, face.counts, face.corners, face.uvs[face.corners])
        made = part("bridge.meshes").new_face(role, file)
        part("bridge.points.points").write_points(made, face.face.points)
        setattr(task, role, made)
        if role == "source":
            shapes = demo.face_shapes(face, ["arkit"])
            rest = face.face.mesh.vertices
            moves = {name: shapes[name] - rest for name in ("browInnerUp", "mouthSmileLeft", "eyeLookInLeft")}
            part("bridge.key_sets").write_keys(made, moves, {})
    task.hierarchical.levels, task.cloning.method = 4, "hierarchical"
    kit = task.wrinkle_kit
    kit.light, kit.level, kit.pixels, kit.folder = "LEVEL", 2, SIZE, str(FOLDER / "panel")
    assert bpy.ops.facial_retarget.make_wrinkle_kit() == {"FINISHED"}
    light = bpy.data.objects["target level 2 wrinkles"]
    names = [key.name for key in light.data.shape_keys.key_blocks][1:]
    assert names == list(moves)
    said = json.loads((FOLDER / "panel" / "wrinkles.json").read_text())
    assert "browInnerUp" in [key["name"] for key in said["keys"]]
    assert "eyeLookInLeft" in said["dropped"]
    node = light.material_slots[0].material.node_tree.nodes["Wrinkle Kit"]
    light.data.shape_keys.key_blocks["browInnerUp"].value = 0.4
    tree = light.material_slots[0].material.evaluated_get(bpy.context.evaluated_depsgraph_get()).node_tree
    place = node.inputs.find("browInnerUp")
    assert abs(tree.nodes[node.name].inputs[place].default_value - 0.4) < 1e-6
    # The target itself has no keys yet.
    kit.light = "TARGET"
    with refused("none of the 3 shape keys", "clone them first"):
        bpy.ops.facial_retarget.make_wrinkle_kit()
    kit.light = "LEVEL"
    assert bpy.ops.facial_retarget.save_clone_job(filepath=str(FOLDER / "clone.toml")) == {"FINISHED"}
    assert "[wrinkle_kit]" in (FOLDER / "clone.toml").read_text()
    part("files.clone_task").run_clone_file(FOLDER / "clone.toml")
    (made,) = FOLDER.rglob("*target_1_wrinkles")
    for path in sorted((FOLDER / "panel").glob("*.png")):
        assert path.read_bytes() == (made / path.name).read_bytes(), path.name


def what_cannot_be_done_is_said() -> None:
    """No high-poly object, no common keys, no UVs, keys without wrinkles, a folder with the artist's own pictures."""
    skin = sheets()
    task = bpy.context.scene.facial_retarget
    sculpt, task.wrinkle_kit.fine = task.wrinkle_kit.fine, None
    with refused("Choose the high-poly object"):
        bpy.ops.facial_retarget.make_wrinkle_kit()
    task.wrinkle_kit.fine = skin
    with refused("expected another mesh than the target"):
        bpy.ops.facial_retarget.make_wrinkle_kit()
    task.wrinkle_kit.fine, task.wrinkle_kit.least = sculpt, 1.5
    with refused("none of the 2 shape keys turns normals by 85.9"):
        bpy.ops.facial_retarget.make_wrinkle_kit()
    (FOLDER / "mine").mkdir()
    (FOLDER / "mine" / "skin.png").write_bytes(b"mine")
    task.wrinkle_kit.folder = str(FOLDER / "mine")
    with refused("skin.png", "wrinkle kit and nothing else"):
        bpy.ops.facial_retarget.make_wrinkle_kit()
    task.wrinkle_kit.folder = str(FOLDER / "none")
    for key in list(sculpt.data.shape_keys.key_blocks)[1:]:
        key.name = f"other {key.name}"
    with refused("no shape key of the same name"):
        bpy.ops.facial_retarget.make_wrinkle_kit()
    skin.data.uv_layers.remove(skin.data.uv_layers.active)
    for key in list(sculpt.data.shape_keys.key_blocks)[1:]:
        key.name = key.name.removeprefix("other ")
    with refused("skin", "no texture coordinates"):
        bpy.ops.facial_retarget.make_wrinkle_kit()
    task.wrinkle_kit.detail, task.method = "RETARGETED", "motion_cloning"
    with refused("no levels"):
        bpy.ops.facial_retarget.make_wrinkle_kit()
    assert not (FOLDER / "none").exists()
    assert not [path for path in FOLDER.iterdir() if path.name.startswith(".")]


sliders_move_the_wrinkles()
what_the_artist_has_wired_stays()
gltf_gets_the_neutrals_map()
udim_tiles_have_pictures_of_their_own()
a_level_gets_keys_and_wrinkles_as_the_command_line_makes_them()
what_cannot_be_done_is_said()
