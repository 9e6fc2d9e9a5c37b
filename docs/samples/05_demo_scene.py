"""The built-in faces in one Blender scene: what `make demo` shows.

    facial-retarget demo FOLDER
    python docs/samples/05_demo_scene.py FOLDER

Takes the frames that the command line has retargeted onto the built-in targets, retargets the performance onto
Suzanne in Blender, bakes it all, and leaves FOLDER/demo.blend and FOLDER/contact_sheet.png.
"""

import sys
from math import radians
from pathlib import Path

import bpy
import numpy as np

from facial_retarget_addon import demo, properties
from facial_retarget_addon.bridge.background import finished
from facial_retarget_addon.bridge.bakes.frames import write_frames
from facial_retarget_addon.bridge.meshes import neutral_mesh, new_face, read_polygons, read_positions
from facial_retarget_addon.bridge.points.points import write_points
from facial_retarget_addon.bridge.retargeting import retarget_steps
from facial_retarget_addon.files.frames import read_frames
from facial_retarget_addon.files.images import png_bytes
from facial_retarget_addon.files.mesh_file import MeshFile
from facial_retarget_addon.files.pages.pictures import contact_sheet
from facial_retarget_addon.files.pages.report_pictures import liveliest
from facial_retarget_addon.files.points import read_points

TILE, SAMPLES, MOMENTS = 320, 24, 6
SPACING, TALLNESS = 1.2, 1.08
"""Between two faces, and how much of it a face's height takes."""


def main(folder: Path) -> None:
    """Make the scene, save it, and take its pictures."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    properties.register()
    actor = demo.actor()
    performance = read_frames(folder / "actor" / "performance.npz", len(actor.face.mesh.vertices))
    things = [built_in(actor, performance)]
    for face in demo.targets():
        frames = read_frames(folder / face.name / "frames.npz", len(face.face.mesh.vertices))
        things.append(built_in(face, frames))
    things.append(suzanne())

    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, len(performance)
    scene.render.fps = 24
    for place, thing in enumerate(things):
        stand(thing, place)
    scene.facial_retarget.source, scene.facial_retarget.target = things[0], things[-1]
    scene.facial_retarget.hierarchical.frames = "global"  # Suzanne's chin looks down: motion turns with the head only
    finished(retarget_steps(bpy.context))

    light(len(things))
    moments = liveliest(actor.face.mesh.vertices, performance, MOMENTS)
    scene.frame_set(1 + moments[0])
    bpy.ops.wm.save_as_mainfile(filepath=str(folder.absolute() / "demo.blend"), compress=True)
    rows = [picture(scene, 1 + moment, folder / "moment.png", len(things)) for moment in moments]
    tiles = [row[:, place * TILE : (place + 1) * TILE] for place in range(len(things)) for row in rows]
    (folder / "contact_sheet.png").write_bytes(png_bytes(contact_sheet(tiles, MOMENTS)))


def built_in(face: demo.DemoFace, frames: np.ndarray) -> bpy.types.Object:
    """A built-in face with its colours, points and baked frames."""
    thing = new_face(face.name, MeshFile(face.face.mesh, face.counts, face.corners, face.uvs[face.corners]))
    colours = thing.data.color_attributes.new("skin", "FLOAT_COLOR", "POINT")
    rgba = np.ones((len(face.colours), 4), np.float32)
    rgba[:, :3] = face.colours
    colours.data.foreach_set("color", rgba.ravel())
    thing.data.materials.append(material(face.name, (1, 1, 1, 1), colours.name))
    thing.rotation_euler.x = radians(90)  # the files' faces stand along Y, Blender's along Z
    write_points(thing, face.face.points)
    write_frames(thing, frames, first=1)
    return thing


def suzanne() -> bpy.types.Object:
    """Blender's monkey, finer, with feature points: subdividing keeps the numbers of its coarse vertices."""
    bpy.ops.mesh.primitive_monkey_add()
    coarse = bpy.context.object
    coarse.modifiers.new("finer", "SUBSURF").levels = 2
    fine = bpy.data.meshes.new_from_object(coarse.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    thing = bpy.data.objects.new("Suzanne", fine)
    bpy.context.scene.collection.objects.link(thing)
    bpy.data.objects.remove(coarse)
    fine.shade_smooth()
    mesh = neutral_mesh(thing)
    points = read_points(Path(__file__).with_name("suzanne_points.json"), mesh)
    write_points(thing, points)
    part = mesh.components[read_polygons(fine)[1].reshape(-1, 4)[:, 0]]
    for name, colour in (("Suzanne", (0.42, 0.27, 0.18, 1)), ("Suzanne's eyes", (0.8, 0.8, 0.75, 1))):
        fine.materials.append(material(name, colour))
    fine.polygons.foreach_set("material_index", (part != mesh.components[points.vertices[0, 0]]).astype(np.int32))
    return thing


def material(name: str, colour: tuple[float, float, float, float], attribute: str = "") -> bpy.types.Material:
    """A soft material of one colour, or with the colours of a vertex attribute."""
    made = bpy.data.materials.new(name)
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = 0.55
    shader.inputs["Base Color"].default_value = colour
    if attribute:
        colours = made.node_tree.nodes.new("ShaderNodeVertexColor")
        colours.layer_name = attribute
        made.node_tree.links.new(colours.outputs["Color"], shader.inputs["Base Color"])
    return made


def stand(thing: bpy.types.Object, place: int) -> None:
    """Put a face in its place in the row, all of one height."""
    upright = read_positions(thing.data) @ np.array(thing.rotation_euler.to_matrix()).T
    low, high = upright.min(axis=0), upright.max(axis=0)
    size = TALLNESS / max(high[2] - low[2], high[0] - low[0])
    middle = 0.5 * (low + high)
    thing.scale = (size,) * 3
    thing.location = (place * SPACING - size * middle[0], -size * low[1], -size * middle[2])
    bpy.context.view_layer.update()


def light(count: int) -> None:
    """A camera in front of the row, a sun from the side that shows wrinkles, and a grey room."""
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", count * SPACING
    camera.location = (0.5 * (count - 1) * SPACING, -10, 0)
    camera.rotation_euler.x = radians(90)
    for name, angles, strength in (("key", (55, 0, -50), 2.6), ("fill", (75, 0, 45), 0.5)):
        sun = bpy.data.objects.new(name, bpy.data.lights.new(name, "SUN"))
        sun.rotation_euler = [radians(angle) for angle in angles]
        sun.data.energy, sun.data.angle = strength, radians(6)
        scene.collection.objects.link(sun)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("room")
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.16, 0.16, 0.18, 1)
    scene.render.engine, scene.cycles.device = "CYCLES", "CPU"
    scene.cycles.samples, scene.cycles.use_denoising = SAMPLES, False
    scene.render.resolution_x, scene.render.resolution_y = count * TILE, TILE
    scene.view_settings.view_transform = "Standard"


def picture(scene: bpy.types.Scene, frame: int, file: Path, count: int) -> np.ndarray:
    """(TILE, count * TILE, 3) uint8: the row of faces at a frame, rendered."""
    scene.frame_set(frame)
    scene.render.filepath = str(file.absolute())
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    pixels = np.empty(TILE * count * TILE * 4, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    file.unlink()
    upwards = pixels.reshape(TILE, count * TILE, 4)[::-1, :, :3]
    return np.round(255 * upwards).astype(np.uint8)


if __name__ == "__main__":
    main(Path(sys.argv[-1]))
