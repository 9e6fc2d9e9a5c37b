"""Figure 11 of Na and Jung 2004 on the built-in faces: level 2, level 5, and level 2 with the normal map of level 5.

    python docs/samples/10_figure_11.py FOLDER

Retargets two expressions of the actor onto the ape, five levels deep, makes their normal maps for level 2, renders all
three meshes lit from the side, and leaves FOLDER/figure_11.png and FOLDER/figure_11/ with the maps. Ends with status 1
if the maps bring the pictures less than 70 % of the way from level 2 to level 5, where both meshes cover the picture
and away from their outlines, which no map can move.
"""

import sys
from math import radians
from pathlib import Path
from typing import cast

import bpy
import numpy as np
from scipy.ndimage import binary_erosion

from facial_retarget_addon import demo
from facial_retarget_addon.bridge.bakes.frames import write_frames
from facial_retarget_addon.bridge.maps.map_nodes import MapSequence, wire
from facial_retarget_addon.bridge.meshes import new_object
from facial_retarget_addon.core.level_retargeter import LevelRetargeter
from facial_retarget_addon.core.methods.base import fit
from facial_retarget_addon.core.methods.settings import HierarchicalSettings, MapSettings
from facial_retarget_addon.core.normal_maps.frame_maps import FrameMaps
from facial_retarget_addon.core.problem import Problem
from facial_retarget_addon.files.images import png_bytes
from facial_retarget_addon.files.normal_map_files import write_frame_maps
from facial_retarget_addon.files.whole import written_whole

EXPRESSIONS = ("joy", "anger")
LEVEL, LEVELS = 2, 5
SETTINGS = MapSettings(level=LEVEL, pixels=1024)
SPACING = 0.012
"""The ape has 115 000 vertices here: triangles of its own must not show on level 5."""
TILE, SAMPLES, OUTLINE, WAY = 512, 8, 3, 0.7
"""Pixels of a picture, rays a pixel, pixels that an outline is wide, and how far the maps must bring the picture."""


def main(folder: Path) -> bool:
    """Make maps and picture; whether the maps bring it far enough."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    actor, ape = demo.actor(), demo.ape(SPACING)
    problem = Problem(actor.face, ape.face)
    fitted = cast(LevelRetargeter, fit("hierarchical", problem, HierarchicalSettings(levels=LEVELS)))
    frames = np.stack([actor.face.examples[name] for name in EXPRESSIONS]).astype(np.float32)
    maps = FrameMaps(fitted, problem, None, SETTINGS)
    with written_whole() as aside:
        pictures = aside.place(folder / "figure_11", replaces=".png")
        pictures.mkdir()
        light = write_frame_maps(pictures, SETTINGS, maps, frames, 1)
    fine, faces = fitted.detail(frames)

    surface, corners = maps.surface, np.full(len(faces), 3)
    coarse = shown("level 2", surface.mesh.vertices, surface.counts, surface.corners, light)
    finest = shown("level 5", fine[0], corners, faces.ravel(), fine)
    mapped = shown("level 2 with its map", surface.mesh.vertices, surface.counts, surface.corners, light)
    mapped.data.uv_layers.new(name="UVMap").uv.foreach_set("vector", np.ravel(surface.uvs).astype(np.float32))
    wire(mapped, MapSequence(folder.absolute() / "figure_11", SETTINGS, tuple(maps.maps), range(1, 1 + len(frames))))

    stage(fine)
    rows, ways = [], []
    for frame, name in enumerate(EXPRESSIONS, start=1):
        bpy.context.scene.frame_set(frame)
        row = [
            picture(thing, (coarse, finest, mapped), folder / "figure_11.tile.png")
            for thing in (coarse, finest, mapped)
        ]
        inside = binary_erosion(np.minimum(row[0], row[1])[..., 3] > 0.99, iterations=OUTLINE)
        before, after = (np.abs(one[..., :3] - row[1][..., :3])[inside].mean() for one in (row[0], row[2]))
        ways.append(1 - after / before)
        print(f"{name}: the map brings the picture {ways[-1]:.0%} of the way from level {LEVEL} to level {LEVELS}")
        rows.append(np.concatenate(row, axis=1))
    whole = np.concatenate(rows)[..., :3]
    (folder / "figure_11.png").write_bytes(png_bytes(np.round(255 * whole).astype(np.uint8)))
    return min(ways) >= WAY


def shown(name: str, vertices: np.ndarray, counts: np.ndarray, corners: np.ndarray, frames: np.ndarray):
    """A smooth object with a shape key per frame."""
    thing = new_object(name, vertices, counts, corners)
    thing.data.shade_smooth()
    material = bpy.data.materials.new(name)
    if bpy.app.version < (5, 0):
        material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value, shader.inputs["Roughness"].default_value = (0.5, 0.4, 0.35, 1), 0.6
    thing.data.materials.append(material)
    write_frames(thing, frames, 1)
    return thing


def stage(frames: np.ndarray) -> None:
    """A camera in front, a hard light from the side and a weak one: direct light alone, so that no noise counts."""
    scene = bpy.context.scene
    low, high = frames.min(axis=(0, 1)), frames.max(axis=(0, 1))
    size, middle = (high - low).max(), 0.5 * (low + high)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale, camera.data.clip_end = "ORTHO", 1.05 * size, 100 * size
    camera.location = middle + np.array([0, 0, 3 * size])
    scene.collection.objects.link(camera)
    scene.camera = camera
    for name, angle, strength in (("key", 60, 3.0), ("fill", -20, 0.6)):
        sun = bpy.data.objects.new(name, bpy.data.lights.new(name, "SUN"))
        sun.rotation_euler.y = radians(angle)
        sun.data.energy, sun.data.angle, sun.data.use_shadow = strength, 0.0, False
        scene.collection.objects.link(sun)
    scene.world = bpy.data.worlds.new("dark")
    scene.world.color = (0, 0, 0)
    scene.render.engine, scene.cycles.device, scene.render.film_transparent = "CYCLES", "CPU", True
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.max_bounces = SAMPLES, False, 0
    scene.render.resolution_x = scene.render.resolution_y = TILE
    scene.view_settings.view_transform = "Standard"


def picture(thing: bpy.types.Object, things: tuple[bpy.types.Object, ...], file: Path) -> np.ndarray:
    """(TILE, TILE, 4) one of some things as it looks now, first row on top."""
    for one in things:
        one.hide_render = one != thing
    scene = bpy.context.scene
    scene.render.filepath = str(file.absolute())
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    pixels = np.empty(TILE * TILE * 4, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    file.unlink()
    return pixels.reshape(TILE, TILE, 4)[::-1]


if __name__ == "__main__":
    sys.exit(0 if main(Path(sys.argv[1])) else 1)
