"""Wired normal maps, seen through renders: the right picture at each frame and in each UDIM tile, no seam."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import empty_scene, enable, grid, part

FOLDER = Path(sys.argv[-1])
WIDTH = 32


def strip(tiles: int = 1, name: str = "strip") -> bpy.types.Object:
    """A flat strip of squares, one for each UDIM tile, up to its borders; its second UV map is active."""
    vertices = np.array([[x, y, 0.0] for x in range(tiles + 1) for y in (0, 1)])
    first = 2 * np.arange(tiles)
    corners = (first[:, None] + [0, 2, 3, 1]).ravel()
    made = part("bridge.meshes").new_object(name, vertices, np.full(tiles, 4), corners)
    uvs = vertices[corners, :2].copy()
    made.data.uv_layers.new(name="rendered")
    made.data.uv_layers["rendered"].active_render = True
    made.data.uv_layers.new(name='Gesicht "ä"').uv.foreach_set("vector", uvs.astype(np.float32).ravel())
    made.data.uv_layers.active = made.data.uv_layers['Gesicht "ä"']
    made.data.shade_smooth()
    return made


def normal_of(number: int) -> np.ndarray:
    """The normal of all pixels of a numbered picture."""
    slope = np.array([0.1 * number - 0.3, 0.05 * number, 1.0])
    return slope / np.linalg.norm(slope)


def sequence(frames: range, tiles: int = 1, depth: str = "png16", convention: str = "opengl") -> object:
    """Maps of one colour each, written as the add-on writes them; each tile's numbers go on from the last one's."""
    files, settings = part("files.normal_map_files"), part("core.methods.settings").MapSettings
    made = settings(depth=depth, convention=convention, pixels=16)
    folder = FOLDER / f"maps_{frames.start}_{len(frames)}_{tiles}_{depth}_{convention}"
    folder.mkdir(exist_ok=True)
    places = [(tile, 0) for tile in range(tiles)]
    for row in range(len(frames)):
        for tile in range(tiles):
            vectors = np.broadcast_to(normal_of(row + 3 * tile), (16, 16, 3)).astype(np.float32)
            picture = part("core.normal_maps.encoding").as_picture(vectors, convention == "directx")
            number = files.first_number(frames.start) + row
            name = files.map_name(depth, number, places[tile] if tiles > 1 else None)
            part("files.images").write_image(picture, folder / name, depth)
    return part("bridge.maps.map_nodes").MapSequence(folder, made, tuple(places), frames)


def stage(wide: int = 1) -> None:
    """A camera above the strip, and a film of floats."""
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale, camera.location = "ORTHO", wide, (wide / 2, 0.5, 1)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine, scene.cycles.samples, scene.cycles.device = "CYCLES", 1, "CPU"
    scene.cycles.use_denoising, scene.cycles.use_adaptive_sampling, scene.cycles.filter_width = False, False, 0.01
    scene.render.resolution_x, scene.render.resolution_y = WIDTH * wide, WIDTH
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(FOLDER / "seen.exr")


def seen(material: bpy.types.Material) -> np.ndarray:
    """(WIDTH, ., 3) normals that the shader of a material gets, as Cycles renders them now."""
    tree = material.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    whole, light = tree.nodes.new("ShaderNodeVectorMath"), tree.nodes.new("ShaderNodeEmission")
    whole.operation = "MULTIPLY_ADD"
    whole.inputs[1].default_value, whole.inputs[2].default_value = (0.5,) * 3, (0.5,) * 3
    tree.links.new(shader.inputs["Normal"].links[0].from_socket, whole.inputs[0])
    tree.links.new(whole.outputs[0], light.inputs["Color"])
    tree.links.new(light.outputs[0], output.inputs["Surface"])
    bpy.ops.render.render(write_still=True)
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    tree.nodes.remove(whole)
    tree.nodes.remove(light)
    image = bpy.data.images.load(bpy.context.scene.render.filepath)
    image.colorspace_settings.name = "Non-Color"
    flat = np.empty(4 * image.size[0] * image.size[1], np.float32)
    image.pixels.foreach_get(flat)
    pixels = flat.reshape(image.size[1], image.size[0], 4)[..., :3]
    bpy.data.images.remove(image)
    return 2 * pixels - 1


def same(pixels: np.ndarray, number: int, what: str, off: float = 2e-3) -> None:
    """Demand the normal of a numbered picture of all pixels."""
    worst = np.abs(pixels - normal_of(number)).max()
    assert worst < off, f"{what}: {pixels.reshape(-1, 3).mean(axis=0)}, not {normal_of(number)} of picture {number}"


def each_frame_has_its_picture() -> None:
    """The first and last, those before and after, at every start, depth and convention."""
    wire = part("bridge.maps.map_nodes").wire
    cases = [
        (range(1, 4), "png16", "opengl"),
        (range(1, 4), "png8", "directx"),
        (range(101, 104), "exr", "directx"),
        (range(0, 3), "png16", "opengl"),
        (range(-2, 1), "png16", "opengl"),
        (range(7, 8), "png16", "directx"),
        (range(9_998, 10_001), "png16", "opengl"),
    ]
    for frames, depth, convention in cases:
        empty_scene()
        thing = strip()
        stage()
        assert wire(thing, sequence(frames, 1, depth, convention)) == []
        for frame, row in (
            (frames.start - 3, 0),
            *zip(frames, range(9), strict=False),
            (frames.stop + 5, len(frames) - 1),
        ):
            bpy.context.scene.frame_set(frame)
            what = f"{frames}, {depth}, {convention}, frame {frame}"
            same(seen(thing.data.materials[0]), row, what, 2e-2 if depth == "png8" else 2e-3)
        # Below 0 Blender cuts towards the next frame.
        if len(frames) == 3 and frames.start >= 0:
            bpy.context.scene.frame_set(frames.start + 1, subframe=0.75)
            same(seen(thing.data.materials[0]), 1, f"{frames} between frames", 2e-2)


def each_tile_has_its_picture() -> None:
    """Up to the borders of the tiles, where none bleeds into another; also after save and reopen."""
    empty_scene()
    thing = strip(3)
    stage(3)
    made = sequence(range(5, 8), 3)
    assert part("bridge.maps.map_nodes").wire(thing, made) == []
    bpy.ops.wm.save_as_mainfile(filepath=str(FOLDER / "tiles.blend"))
    for again in (False, True):
        if again:
            bpy.ops.wm.open_mainfile(filepath=str(FOLDER / "tiles.blend"))
            enable()
        material = bpy.data.objects["strip"].data.materials[0]
        for row, frame in enumerate(made.frames):
            bpy.context.scene.frame_set(frame)
            pixels = seen(material)
            for tile in range(3):
                same(pixels[:, WIDTH * tile : WIDTH * (tile + 1)], row + 3 * tile, f"tile {tile}, frame {frame}")


def materials_of_others_stay_or_are_named() -> None:
    """Only the mapped polygons' materials change; bumps stay; other objects with them are named."""
    empty_scene()
    nodes = part("bridge.maps.map_nodes")
    thing, other = strip(3), strip(1, "other")
    own, shared, eye = (bpy.data.materials.new(name) for name in ("own", "shared", "eye"))
    for material in (own, shared, eye):
        nodes.node_tree(material)
        thing.data.materials.append(material)
    thing.data.materials.append(None)
    other.data.materials.append(shared)
    thing.data.polygons.foreach_set("material_index", [0, 1, 2])
    bump = own.node_tree.nodes.new("ShaderNodeBump")
    shader = next(node for node in own.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    own.node_tree.links.new(bump.outputs["Normal"], shader.inputs["Normal"])
    made = sequence(range(1, 4))._replace(polygons=np.array([True, True, False]))
    for _ in range(2):
        assert nodes.wire(thing, made) == ["material 'shared' shows the normal map on 'other' too"]
        assert shader.inputs["Normal"].links[0].from_node == bump
        assert bump.inputs["Normal"].links[0].from_node.label == nodes.LABEL
        assert len([node for node in own.node_tree.nodes if node.type == "TEX_IMAGE"]) == 1
        assert not [node for node in eye.node_tree.nodes if node.label == nodes.LABEL]
    # What the artist puts between our normal and the shader gets the new one too.
    between = shared.node_tree.nodes.new("ShaderNodeVectorMath")
    plain = next(node for node in shared.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shared.node_tree.links.new(plain.inputs["Normal"].links[0].from_socket, between.inputs[0])
    shared.node_tree.links.new(between.outputs[0], plain.inputs["Normal"])
    assert len(nodes.wire(thing, made)) == 1
    assert between.inputs[0].links[0].from_node.label == nodes.LABEL
    assert plain.inputs["Normal"].links[0].from_node == between
    # An empty slot of the mapped polygons gets a material, and so does a mesh without any.
    thing.data.polygons.foreach_set("material_index", [3, 3, 2])
    assert nodes.wire(thing, made) == []
    assert thing.material_slots[3].material is not None
    bare = strip(1, "bare")
    assert nodes.wire(bare, made._replace(polygons=None)) == []
    assert len(bare.data.materials) == 1


def a_librarys_material_is_left_as_it_is() -> None:
    """It cannot keep nodes: the message says so."""
    empty_scene()
    kept = bpy.data.materials.new("kept")
    part("bridge.maps.map_nodes").node_tree(kept)
    bpy.data.libraries.write(str(FOLDER / "library.blend"), {kept}, fake_user=True)
    empty_scene()
    with bpy.data.libraries.load(str(FOLDER / "library.blend"), link=True) as (_, wanted):
        wanted.materials = ["kept"]
    thing = strip()
    thing.data.materials.append(bpy.data.materials["kept"])
    said = part("bridge.maps.map_nodes").wire(thing, sequence(range(1, 4)))
    assert said == ["material 'kept' is linked from a library: the normal map is not wired there"]
    assert not [node for node in thing.data.materials[0].node_tree.nodes if node.type == "TEX_IMAGE"]


def bowl(name: str, side: int, height: float) -> bpy.types.Object:
    """A bowl with waves of a height, in front of the camera of `stage`."""
    made = grid(name, side)
    places = part("bridge.meshes").read_positions(made.data).copy()
    places[:, 2] += height * np.sin(9 * places[:, 0] + 4 * places[:, 1]) * np.cos(7 * places[:, 1] - 2 * places[:, 0])
    made.data.vertices.foreach_set("co", places.ravel())
    made.data.update()
    made.data.shade_smooth()
    made.scale, made.location = (0.5, 0.5, 0.5), (0.5, 0.5, -1)
    return made


def cut_in_four(thing: bpy.types.Object) -> None:
    """Give a bowl UVs in four islands: as it is, turned by 90 degrees, mirrored, aslant and smaller."""
    _, corners = part("bridge.meshes").read_polygons(thing.data)
    places = part("bridge.meshes").read_positions(thing.data)[corners, :2].reshape(-1, 4, 2).astype(float)
    quarter = (places.mean(axis=1) > 0) @ [1, 2]
    slant = 0.7 * np.array([[0.8, -0.6], [0.6, 0.8]])
    ways = np.eye(2), np.array([[0, -1], [1, 0]]), np.diag([-1, 1]), slant
    for number, (way, x, y) in enumerate(zip(ways, (0.27, 0.73, 0.27, 0.73), (0.27, 0.27, 0.73, 0.73), strict=True)):
        mine = quarter == number
        centre = places[mine].reshape(-1, 2).mean(axis=0)
        places[mine] = (places[mine] - centre) @ way.T * 0.37 + [x, y]
    thing.data.uv_layers.new(name="UVMap").uv.foreach_set("vector", places.astype(np.float32).ravel())


def no_seam_shows_in_a_render() -> None:
    """Where islands meet the light mesh is as near to the fine one as elsewhere; without a margin it is not."""
    empty_scene()
    stage()
    bpy.context.scene.render.resolution_x = bpy.context.scene.render.resolution_y = 4 * WIDTH
    light, fine = bowl("light", 17, 0.0), bowl("fine", 161, 0.02)
    cut_in_four(light)
    meshes, nodes = part("bridge.meshes"), part("bridge.maps.map_nodes")
    surface = part("files.normal_map_files").textured(meshes.read_face(light), "light")
    material = bpy.data.materials.new("fine")
    tree = nodes.node_tree(material)
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    tree.links.new(tree.nodes.new("ShaderNodeNewGeometry").outputs["Normal"], shader.inputs["Normal"])
    fine.data.materials.append(material)
    light.hide_render = True
    truth = seen(material)
    light.hide_render, fine.hide_render = False, True
    across = np.abs(np.arange(4 * WIDTH) - 2 * WIDTH + 0.5) < 2
    band = across[:, None] | across
    off = {}
    for margin in (0, 8):
        made = part("core.normal_maps.normal_map").fit_normal_map(
            surface, meshes.neutral_mesh(fine), 256, margin_width=margin
        )
        vectors = made.vectors(surface.mesh.vertices, meshes.neutral_mesh(fine).vertices)
        maps = sequence(range(20 + margin, 21 + margin))
        path = maps.folder / part("files.normal_map_files").map_name("png16", maps.frames.start)
        part("files.images").write_image(part("core.normal_maps.encoding").as_picture(vectors), path, "png16")
        nodes.wire(light, maps)
        pixels = seen(light.data.materials[0])
        angle = np.degrees(np.arccos(np.clip((pixels * truth).sum(axis=2), -1, 1)))[4:-4, 4:-4]
        off[margin] = [np.quantile(angle[some], 0.95) for some in (band[4:-4, 4:-4], ~band[4:-4, 4:-4])]
        print(f"margin {margin}: 95 % within {off[margin]} degrees of the fine mesh at seams and elsewhere")
    assert off[8][0] < 1.2 * off[8][1]
    assert off[0][0] > 2 * off[0][1]


no_seam_shows_in_a_render()
materials_of_others_stay_or_are_named()
a_librarys_material_is_left_as_it_is()
each_frame_has_its_picture()
each_tile_has_its_picture()
