"""Normal maps: pictures on disk, wired into materials; against Blender's tangents and Cycles' own bake."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import empty_scene, grid, part, refused

FOLDER = Path(sys.argv[-1])
SIZE = 256


def textured(face: object, name: str) -> bpy.types.Object:
    """A built-in face as an object with points and UVs."""
    file = part("files.mesh_file").MeshFile(face.face.mesh, face.counts, face.corners, face.uvs[face.corners])
    made = part("bridge.meshes").new_face(name, file)
    part("bridge.points.points").write_points(made, face.face.points)
    return made


def pair() -> None:
    """The built-in actor, who acts for three frames, and the child, as the task's faces."""
    empty_scene()
    demo = part("demo")
    actor, child = demo.actor(4_000), demo.child()
    task = bpy.context.scene.facial_retarget
    task.source, task.target = textured(actor, "actor"), textured(child, "child")
    performance = demo.performance(actor)
    order = np.argsort(np.abs(performance - performance[0]).max(axis=(1, 2)))
    part("bridge.bakes.frames").write_frames(task.source, performance[order[[0, len(order) // 2, -1]]], 1)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 3
    task.hierarchical.levels = 4
    bpy.context.scene.frame_set(1)


def pixels_of(image: bpy.types.Image) -> np.ndarray:
    """(H, W, 3) of an image, row 0 at the bottom."""
    flat = np.empty(4 * image.size[0] * image.size[1], np.float32)
    image.pixels.foreach_get(flat)
    return flat.reshape(image.size[1], image.size[0], 4)[..., :3]


def tangents_are_blenders() -> None:
    """Ours and `calc_tangents`, on a head with seams, quads and a mirrored half."""
    bpy.ops.mesh.primitive_monkey_add(calc_uvs=True)
    thing = bpy.context.object
    thing.data.shade_smooth()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.quads_convert_to_tris()
    bpy.ops.object.mode_set(mode="OBJECT")
    uvs = thing.data.uv_layers.active.uv
    flat = np.empty(2 * len(uvs), np.float32)
    uvs.foreach_get("vector", flat)
    flat[::2] = np.abs(flat[::2] - 0.5)
    uvs.foreach_set("vector", flat)
    surface = part("files.normal_map_files").textured(part("bridge.meshes").read_face(thing), "suzanne")
    space = part("core.normal_maps.tangents").TangentSpace(surface.mesh.faces, surface.triangle_uvs)
    thing.data.calc_tangents(uvmap=thing.data.uv_layers.active.name)
    theirs, sign = np.empty(3 * len(uvs), np.float32), np.empty(len(uvs), np.float32)
    thing.data.loops.foreach_get("tangent", theirs)
    thing.data.loops.foreach_get("bitangent_sign", sign)
    rows = surface.triangle_corners
    flat_ones = np.abs(np.linalg.det(np.diff(surface.triangle_uvs, axis=1))) < 1e-9
    ours = space.tangents(surface.mesh.vertices, surface.normals(surface.mesh.vertices))[space.group]
    agree = np.einsum("fki,fki->fk", ours, theirs.reshape(-1, 3)[rows])[~flat_ones]
    assert np.degrees(np.arccos(np.clip(agree, -1, 1))).max() < 0.1, agree.min()
    np.testing.assert_array_equal(np.repeat(space.sign[:, None], 3, axis=1)[~flat_ones], sign[rows][~flat_ones])
    assert {-1.0, 1.0} == set(sign.tolist())


def textures_are_covered_as_cycles_covers_them() -> None:
    """Halves over one another, UVs past the tile's borders, warped quads, a hexagon, polygons without UV area."""
    empty_scene()
    mesh = grid("high", 65)
    places = np.empty(3 * len(mesh.data.vertices), np.float32)
    mesh.data.vertices.foreach_get("co", places)
    places = places.reshape(-1, 3)
    places[:, 2] += 0.03 * np.sin(9 * places[:, 0]) * np.cos(7 * places[:, 1])
    mesh.data.vertices.foreach_set("co", places.ravel())
    mesh.data.update()
    mesh.data.shade_smooth()
    plain = grid("plain", 9)
    counts, corners = part("bridge.meshes").read_polygons(plain.data)
    vertices = part("bridge.meshes").read_positions(plain.data).astype(float)
    vertices[:, :2] += np.random.default_rng(1).uniform(-0.06, 0.06, (81, 2)) * (np.abs(vertices[:, :2]) < 0.9)
    quads = corners.reshape(-1, 4)
    # The first two quads, side by side, become a hexagon.
    (a, b, c, d), (_, e, f, _) = quads[:2]
    counts, corners = np.r_[6, counts[2:]], np.r_[a, b, e, f, c, d, quads[2:].ravel()]
    low = part("bridge.meshes").new_object("low", vertices, counts, corners)
    low.data.shade_smooth()
    low.data.materials.append(bpy.data.materials.new("baked"))
    part("bridge.maps.map_nodes").node_tree(low.data.materials[0])
    uvs = 0.5 + 0.56 * vertices[corners, :2]
    owner = np.repeat(np.arange(len(counts)), counts)
    middle = np.stack([np.bincount(owner, vertices[corners, k]) / counts for k in (0, 1)], axis=1)
    right = middle[owner, 0] > 0
    uvs[right, 0] = 1 - uvs[right, 0]
    uvs[owner == 20] = uvs[owner == 20].mean(axis=0)
    uvs[owner == 30, 1] = 0.4
    low.data.uv_layers.new(name="UVMap").uv.foreach_set("vector", uvs.astype(np.float32).ravel())
    surface = part("files.normal_map_files").textured(part("bridge.meshes").read_face(low), "low")
    fine = part("bridge.meshes").neutral_mesh(mesh)
    made = part("core.normal_maps.normal_map").fit_normal_map(surface, fine, SIZE, margin_width=0)
    baked, theirs = cycles_bake(low, mesh)
    covered = np.zeros((SIZE, SIZE), bool)
    covered.ravel()[made.pixel] = True
    assert (covered != baked).mean() < 0.002, (covered != baked).sum()
    ours = made.vectors(surface.mesh.vertices, fine.vertices)[baked]
    off = np.degrees(np.arccos(np.clip(np.einsum("pi,pi->p", ours, theirs) / np.linalg.norm(theirs, axis=1), -1, 1)))
    print(f"one half over the other: {np.median(off):.2f} degrees from Cycles, 98 % {np.quantile(off, 0.98):.2f}")
    assert np.median(off) <= 0.3
    assert np.quantile(off, 0.98) <= 1.5


def maps_of_a_level_are_cycles() -> None:
    """What is written for a level's object is what Cycles bakes from the finest mesh to it, at every frame."""
    pair()
    task = bpy.context.scene.facial_retarget
    task.normal_maps.light, task.normal_maps.level, task.normal_maps.pixels = "LEVEL", 2, SIZE
    task.normal_maps.folder, task.normal_maps.margin = str(FOLDER / "level"), 0
    assert bpy.ops.facial_retarget.make_normal_maps() == {"FINISHED"}
    (material,) = bpy.data.objects["child level 2"].data.materials
    assert bpy.ops.facial_retarget.make_normal_maps() == {"FINISHED"}
    assert list(bpy.data.objects["child level 2"].data.materials) == [material]
    assert list(bpy.data.materials) == [material]
    assert sorted(path.name for path in (FOLDER / "level").iterdir()) == [f"normal.000{n}.png" for n in (1, 2, 3)]
    level = bpy.data.objects["child level 2"]
    assert [key.name for key in level.data.shape_keys.key_blocks][1:] == ["frame_0001", "frame_0002", "frame_0003"]
    source = part("bridge.background").finished(
        part("bridge.performance").read_frames(bpy.context, task.source, range(1, 4))
    )
    fitted = part("core.methods.base").fit(
        "hierarchical", part("bridge.task").read_problem(bpy.context), part("bridge.settings").read_task_settings(task)
    )
    fine, faces = fitted.detail(source)
    corners = np.full(len(faces), 3), faces.ravel()
    for row, frame in enumerate((1, 2, 3)):
        bpy.context.scene.frame_set(frame)
        high = part("bridge.meshes").new_object("high", fine[row], *corners)
        high.data.shade_smooth()
        baked, theirs = cycles_bake(level, high)
        bpy.data.meshes.remove(high.data)
        image = bpy.data.images.load(str(FOLDER / "level" / f"normal.000{frame}.png"))
        image.colorspace_settings.name = "Non-Color"
        ours = 2 * pixels_of(image)[baked] - 1
        agree = np.einsum("pi,pi->p", ours, theirs) / np.linalg.norm(ours, axis=1) / np.linalg.norm(theirs, axis=1)
        off = np.degrees(np.arccos(np.clip(agree, -1, 1)))
        print(f"frame {frame}: {np.median(off):.2f} degrees from Cycles, 95 % {np.quantile(off, 0.95):.2f}")
        assert np.median(off) <= 1.0, np.median(off)
        assert np.quantile(off, 0.95) <= 4.0, np.quantile(off, 0.95)


def cycles_bake(low: bpy.types.Object, high: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """Pixels (H, W) that Cycles has baked, and the normals (P, 3) there."""
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.samples = "CYCLES", 1
    image = bpy.data.images.new("baked", SIZE, SIZE, alpha=True, float_buffer=True, is_data=True)
    image.generated_color = (0, 0, 0, 0)
    tree = low.material_slots[0].material.node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    tree.nodes.active = node
    for thing in scene.objects:
        thing.select_set(thing in (low, high))
    bpy.context.view_layer.objects.active = low
    reach = 0.05 * max(low.dimensions)
    # Cleared, pixels that nothing covers would be flat, and count as baked.
    bpy.ops.object.bake(
        type="NORMAL",
        use_selected_to_active=True,
        cage_extrusion=reach,
        max_ray_distance=2 * reach,
        margin=0,
        use_clear=False,
    )
    normals = 2 * pixels_of(image) - 1
    baked = np.abs(np.linalg.norm(normals, axis=2) - 1) < 0.05
    tree.nodes.remove(node)
    return baked, normals[baked]


def materials_show_them() -> None:
    """The target's own materials get the nodes once, for each UDIM tile, and keep the artist's."""
    pair()
    task = bpy.context.scene.facial_retarget
    task.normal_maps.pixels, task.normal_maps.folder = SIZE, str(FOLDER / "own")
    own = bpy.data.materials.new("own")
    if bpy.app.version < (5, 0):
        own.use_nodes = True
    bump = own.node_tree.nodes.new("ShaderNodeBump")
    shader = next(node for node in own.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    own.node_tree.links.new(bump.outputs["Normal"], shader.inputs["Normal"])
    plain = bpy.data.materials.new("plain")
    for material in (own, plain):
        task.target.data.materials.append(material)
    polygons = task.target.data.polygons
    polygons.foreach_set("material_index", np.arange(len(polygons)) % 2)
    uvs = task.target.data.uv_layers.active.uv
    flat = np.empty(2 * len(uvs), np.float32)
    uvs.foreach_get("vector", flat)
    for convention, tiles in (("opengl", 1), ("directx", 2)):
        task.normal_maps.convention = convention
        # Twice as wide, the halves of the face lie in UDIM tiles 1001 and 1002.
        uvs.foreach_set("vector", (flat.reshape(-1, 2) * [tiles, 1]).astype(np.float32).ravel())
        assert bpy.ops.facial_retarget.make_normal_maps() == {"FINISHED"}
        assert shader.inputs["Normal"].links[0].from_node == bump
        assert bump.inputs["Normal"].links[0].from_node.type == "NORMAL_MAP"
        nodes = [node for node in plain.node_tree.nodes if node.label == "Facial Retarget Normal Map"]
        pictures = [node for node in nodes if node.type == "TEX_IMAGE"]
        assert len(pictures) == tiles
        assert pictures[0].image.source == "SEQUENCE"
        assert pictures[0].image.colorspace_settings.name == "Non-Color"
    names = [f"normal.{udim}.000{frame}.png" for udim in (1001, 1002) for frame in (1, 2, 3)]
    assert sorted(path.name for path in (FOLDER / "own").iterdir()) == names


def a_job_carries_them() -> None:
    """What the panel says of the maps comes back from a saved job."""
    pair()
    task = bpy.context.scene.facial_retarget
    maps = task.normal_maps
    maps.folder, maps.pixels, maps.convention, maps.light, maps.level = str(FOLDER / "jobs"), 300, "directx", "LEVEL", 3
    path = FOLDER / "job.toml"
    assert bpy.ops.facial_retarget.save_job(filepath=str(path)) == {"FINISHED"}
    assert "[normal_maps]" in path.read_text()
    maps.folder, maps.pixels, maps.convention, maps.light, maps.level = "", 512, "opengl", "TARGET", 2
    assert bpy.ops.facial_retarget.load_job(filepath=str(path)) == {"FINISHED"}
    assert (maps.folder, maps.pixels, maps.convention) == (str(FOLDER / "jobs"), 300, "directx")
    assert (maps.light, maps.level) == ("LEVEL", 3)


def what_cannot_be_done_is_said() -> None:
    """No folder, a folder with other things, no UVs, a method without levels, a level that is not there."""
    pair()
    task = bpy.context.scene.facial_retarget
    with refused("Choose a folder"):
        bpy.ops.facial_retarget.make_normal_maps()
    (FOLDER / "full").mkdir()
    (FOLDER / "full" / "notes.txt").write_text("mine")
    task.normal_maps.folder = str(FOLDER / "full")
    with refused("notes.txt", ".png"):
        bpy.ops.facial_retarget.make_normal_maps()
    assert (FOLDER / "full" / "notes.txt").read_text() == "mine"
    task.normal_maps.folder = "//beside"
    with refused("//beside", "not saved"):
        bpy.ops.facial_retarget.make_normal_maps()
    task.normal_maps.folder = str(FOLDER / "new")
    task.normal_maps.light, task.normal_maps.level = "LEVEL", 6
    with refused("level 6", "levels 1 to 4"):
        bpy.ops.facial_retarget.make_normal_maps()
    task.normal_maps.light = "TARGET"
    task.target.data.uv_layers.remove(task.target.data.uv_layers.active)
    with refused("child", "no texture coordinates"):
        bpy.ops.facial_retarget.make_normal_maps()
    task.method = "motion_cloning"
    with refused("no levels"):
        bpy.ops.facial_retarget.make_normal_maps()
    assert not (FOLDER / "new").exists()
    assert not [path for path in FOLDER.iterdir() if path.name.startswith(".")]


tangents_are_blenders()
textures_are_covered_as_cycles_covers_them()
maps_of_a_level_are_cycles()
materials_show_them()
a_job_carries_them()
what_cannot_be_done_is_said()
