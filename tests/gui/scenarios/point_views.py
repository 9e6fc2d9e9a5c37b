"""Clicks of the feature-point tool land within a pixel in every view, on the face as it is shown, behind others."""

import bpy
import drive
import numpy as np
import stage
from bpy_extras.view3d_utils import location_3d_to_region_2d, region_2d_to_origin_3d, region_2d_to_vector_3d

TOOL = "facial_retarget.feature_points"
OFFSETS = ([0.3, 0.5], [-0.3, 0.5], [0.0, -0.3], [0.1, -0.6])


def face():
    """The face anew: undo makes new objects of all."""
    return bpy.data.objects["Actor"]


def windows():
    """The 3D view's regions with their views: four of each in quad view."""
    editor = drive.area()
    space = editor.spaces.active
    shown = [region for region in editor.regions if region.type == "WINDOW"]
    return list(zip(shown, space.region_quadviews or [space.region_3d], strict=True))


def pixel(name, region, view):
    """(2,) pixels of the window where a view shows a stored point."""
    names, places = stage.part("bridge.points.point_places").world_places(face(), bpy.context.evaluated_depsgraph_get())
    return np.array(location_3d_to_region_2d(region, view, places[names.index(name)])) + [region.x, region.y]


def spot(region, view, offset):
    """(2,) whole pixels of the window beside the middle of the face in a view, `offset` in shares of its height."""
    middle = location_3d_to_region_2d(region, view, (0.0, 0.0, 0.0))
    top = location_3d_to_region_2d(region, view, (0.0, 0.0, 1.0))
    return np.round(np.array(middle) + (top - middle).length * np.array(offset) + [region.x, region.y])


def depth_off(name, region, view):
    """How far from the place, where Blender itself finds the surface behind its pixel, a point lies."""
    names, places = stage.part("bridge.points.point_places").world_places(face(), bpy.context.evaluated_depsgraph_get())
    at = pixel(name, region, view) - [region.x, region.y]
    to_own = face().matrix_world.inverted()
    origin = to_own @ region_2d_to_origin_3d(region, view, at)
    along = to_own.to_3x3() @ region_2d_to_vector_3d(region, view, at)
    found, hit, *_ = face().ray_cast(origin, along, depsgraph=bpy.context.evaluated_depsgraph_get())
    return np.linalg.norm(places[names.index(name)] - np.array(face().matrix_world @ hit)) if found else np.inf


def click(region, view, offset):
    """Click, and tell how many pixels off the point is that was placed."""
    name = face().facial_retarget.turn
    at = spot(region, view, offset)
    yield from drive.click(*at)
    assert name in face().facial_retarget.points, (name, offset)
    assert depth_off(name, region, view) < 0.02, name
    return np.abs(pixel(name, region, view) - at).max()


def clicks(window):
    """Click some places of the face in a view."""
    off = []
    for offset in OFFSETS:
        off.append((yield from click(*window, offset)))
    return off


def start(turns):
    """No points, and some turns for the window."""
    face().facial_retarget.points.clear()
    face().facial_retarget.proposals.clear()
    stage.remember()
    yield from drive.wait(turns)


def scenario():
    """Play it."""
    stage.clear()
    thing = stage.add_face(stage.part("demo").actor(3_000), "Actor", points=False)
    thing.facial_retarget.point_set = "MINIMAL"
    yield from drive.look("FRONT", [thing])
    with drive.override():
        bpy.ops.wm.tool_set_by_id(name=TOOL, space_type="VIEW_3D")
    space = drive.area().spaces.active
    # The face as it is shown: a shape key that is on, a lattice, a turn, an uneven scale; and an object in front.
    thing.shape_key_add(name="Basis", from_mix=False)
    wide = thing.shape_key_add(name="wide", from_mix=False)
    wide.points.foreach_set(
        "co", (stage.part("bridge.meshes").read_positions(thing.data) * np.float32([1.2, 1, 1])).ravel()
    )
    wide.value = 1.0
    cage = bpy.data.objects.new("Cage", bpy.data.lattices.new("Cage"))
    bpy.context.scene.collection.objects.link(cage)
    cage.scale = (3, 3, 3)
    cage.data.points[0].co_deform.x -= 0.4
    cage.data.points[7].co_deform.z += 0.3
    thing.modifiers.new("Bend", "LATTICE").object = cage
    thing.rotation_euler.z = 0.2
    thing.scale.x *= 1.3
    wall = bpy.data.objects.new("Wall", bpy.data.meshes.new("Wall"))
    wall.data.from_pydata([(-9, -3, -9), (9, -3, -9), (9, -3, 9), (-9, -3, 9)], [], [(0, 1, 2, 3)])
    bpy.context.scene.collection.objects.link(wall)
    wall.display_type = "WIRE"
    stage.choose(thing)
    off = {}

    space.region_3d.view_perspective = "ORTHO"
    yield from start(5)
    off["orthographic"] = yield from clicks(windows()[0])
    space.region_3d.view_perspective = "PERSP"
    space.lens = 35
    yield from start(5)
    off["perspective"] = yield from clicks(windows()[0])
    drive.screenshot("point_views_perspective")

    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    bpy.context.scene.collection.objects.link(camera)
    camera.location, camera.rotation_euler, camera.data.shift_x = (0.6, -6, 0.4), (1.5, 0.0, 0.1), 0.1
    bpy.context.scene.camera = camera
    space.region_3d.view_perspective = "CAMERA"
    yield from start(5)
    off["camera"] = yield from clicks(windows()[0])

    with drive.override():
        bpy.ops.view3d.view_axis(type="FRONT")
        bpy.ops.screen.region_quadview()
    yield from start(10)
    with drive.override():
        bpy.ops.view3d.view_all()
    yield from drive.wait(5)
    off["quad"] = []
    for (region, view), offset in zip(windows(), ([0.2, 0.2], [0.1, 0.3], [0.1, 0.1], [0.0, -0.2]), strict=True):
        off["quad"].append((yield from click(region, view, offset)))
    drive.screenshot("point_views_quad")
    with drive.override():
        bpy.ops.screen.region_quadview()

    # Subdivision moves the surface that is drawn; the pixel is the same.
    thing.modifiers.new("Smooth", "SUBSURF").levels = 1
    with drive.override():
        bpy.ops.view3d.view_axis(type="FRONT")
    yield from start(5)
    off["subdivided"] = yield from clicks(windows()[0])
    for view, pixels in off.items():
        drive.log(view, "pixels off:", *(f"{one:.4f}" for one in pixels))
        assert max(pixels) < 1, (view, pixels)
    stored = len(face().facial_retarget.points)

    # A face that is hidden, or out of local view, takes no click.
    stage.choose(wall)
    with drive.override():
        bpy.ops.view3d.localview()
    stage.choose(thing)
    yield from drive.wait(5)
    yield from drive.click(*spot(*windows()[0], [0.2, 0.1]))
    assert len(face().facial_retarget.points) == stored
