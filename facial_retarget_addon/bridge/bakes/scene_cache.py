"""Frames as Alembic or USD: Blender has no writers but its exporters, so a scene aside plays the frames to one."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import bpy
import numpy as np
from bpy.types import CacheFile, Mesh, Object, Scene

from ...core.errors import RetargetError
from ...files.frames import FrameBlocks
from ...files.whole import Aside
from ..curves import ensure_curves, write_curve
from ..exporter_files import check_room, is_complete
from ..meshes import read_polygons, replace_geometry

ROOT = "/root"
"""Where the objects of a USD file lie."""
LONGEST = 40
"""Letters of an object's name that are kept inside a file."""


class Played(NamedTuple):
    """An object of a file: whose faces it has, its name there, and where its vertices are."""

    thing: Object
    name: str
    frames: FrameBlocks


def names_inside(things: Sequence[Object]) -> list[str]:
    """Names for objects inside a file, told apart: letters, digits and _ alone mean the same in Alembic and USD."""
    names: list[str] = []
    for thing in things:
        stem = "retargeted_" + re.sub(r"[^A-Za-z0-9_]", "_", thing.name)[:LONGEST]
        number, name = 1, stem
        # The exporters call objects as the .blend does, where every name is there once.
        while name in names or name in bpy.data.objects or name in bpy.data.meshes:
            number += 1
            name = f"{stem}_{number}"
        names.append(name)
    return names


def object_path(path: Path, name: str) -> str:
    """Where a Mesh Sequence Cache modifier finds an object of a file."""
    return f"/{name}/{name}" if path.suffix == ".abc" else f"{ROOT}/{name}/{name}"


def add_scene_cache(aside: Aside, path: Path, played: Sequence[Played], step: float) -> None:
    """Write objects that move into one file, among others that appear together.

    Parameters
    ----------
    path : .abc, .usdc or .usd. step : scene frames from one of the frames to the next.

    Raises
    ------
    RetargetError : if Blender cannot write it.
    """
    place = aside.place(path)
    check_room(place, sum(12 * frames.shape[0] * frames.shape[1] for _, _, frames in played))
    with _stage(played, step) as (scene, meshes), _shown(scene, meshes):
        try:
            with bpy.context.temp_override(scene=scene, view_layer=scene.view_layers[0]):
                _export(place, len(played[0].frames))
        except RuntimeError as error:
            raise RetargetError(f"{path} cannot be written: {str(error).strip()}") from error
    if not is_complete(place):
        raise RetargetError(f"{path} cannot be written: Blender did not get to its end; the disk may be full")


@contextmanager
def _stage(played: Sequence[Played], step: float) -> Iterator[tuple[Scene, Mapping[Mesh, FrameBlocks]]]:
    """A scene with an object for each one played, and the meshes' frames; gone afterwards."""
    made, meshes = [], {}
    try:
        scene = bpy.data.scenes.new("Facial Retarget")
        made.append(scene)
        now = bpy.context.scene.render
        scene.frame_start, scene.frame_end = 0, len(played[0].frames) - 1
        scene.render.fps, scene.render.fps_base = now.fps, now.fps_base * step
        for thing, name, frames in played:
            mesh = bpy.data.meshes.new(name)
            made.append(mesh)
            replace_geometry(mesh, frames[:1][0], *read_polygons(thing.data))
            shown = bpy.data.objects.new(name, mesh)
            made.append(shown)
            shown.matrix_world = thing.matrix_world
            scene.collection.objects.link(shown)
            _mark_moving(mesh)
            made.append(mesh.animation_data.action)
            meshes[mesh] = frames
        yield scene, meshes
    finally:
        bpy.data.batch_remove(made)


def _mark_moving(mesh: Mesh) -> None:
    """Give a mesh a curve: exporters write meshes without any once only."""
    mesh["moving"] = 0.0
    write_curve(ensure_curves(mesh, mesh.name, None), '["moving"]', np.zeros(1), np.zeros(1))


@contextmanager
def _shown(scene: Scene, meshes: Mapping[Mesh, FrameBlocks]) -> Iterator[None]:
    """Meshes follow their frames while the scene's frame changes. What goes wrong is raised at the end."""
    wrong: list[Exception] = []

    def show(changed: Scene, *_: object) -> None:
        if changed != scene:
            return
        try:
            for mesh, frames in meshes.items():
                row = min(max(scene.frame_current, 0), len(frames) - 1)
                places = np.ascontiguousarray(frames[row : row + 1], np.float32)
                mesh.attributes["position"].data.foreach_set("vector", places.ravel())
                mesh.update()
        except Exception as error:  # Blender would print it and go on
            wrong.append(error)

    bpy.app.handlers.frame_change_pre.append(show)
    try:
        yield
    finally:
        bpy.app.handlers.frame_change_pre.remove(show)
    if wrong:
        raise wrong[0]


def _export(path: Path, count: int) -> None:
    """Let Blender write the scene: vertices and faces, nothing else."""
    common = {"filepath": str(path), "check_existing": False, "export_hair": False, "export_custom_properties": False}
    if path.suffix == ".abc":
        bpy.ops.wm.alembic_export(
            **common,
            start=0,
            end=count - 1,
            uvs=False,
            packuv=False,
            normals=False,
            vcolors=False,
            export_particles=False,
            as_background_job=False,
            evaluation_mode="VIEWPORT",
        )
    else:
        bpy.ops.wm.usd_export(
            **common,
            root_prim_path=ROOT,
            export_animation=True,
            export_uvmaps=False,
            export_normals=False,
            export_mesh_colors=False,
            export_materials=False,
            export_lights=False,
            export_cameras=False,
            export_armatures=False,
            export_shapekeys=False,
            convert_world_material=False,
            evaluation_mode="VIEWPORT",
        )


def load_cache(path: Path, times: Sequence[float], step: float) -> CacheFile:
    """A cache file datablock that plays a file's first frame at the first of some scene frames, and so on."""
    before = set(bpy.data.cache_files)
    # With a region Blender would give the datablock to the field under the mouse.
    with bpy.context.temp_override(area=None, region=None):
        bpy.ops.cachefile.open(filepath=str(path), relative_path=False)
    (cache,) = set(bpy.data.cache_files) - before
    if path.suffix == ".abc" or step == 1:
        cache.frame_offset = times[0]
        return cache
    # Alembic is read by its seconds, USD by the number of the frame: a curve tells it.
    cache.override_frame = True
    ends = np.array([times[0], times[0] + step * max(len(times) - 1, 1)])
    write_curve(ensure_curves(cache, cache.name, None), "frame", ends, np.array([0.0, max(len(times) - 1, 1)]))
    return cache


def drop_cache(cache: CacheFile) -> None:
    """Remove a cache file datablock that nothing plays any more, with the curve that was made for it."""
    if cache.users:
        return
    animation = cache.animation_data
    action = None if animation is None else animation.action
    bpy.data.batch_remove([cache])
    if action is not None and not action.users:
        bpy.data.actions.remove(action)


@contextmanager
def let_go(paths: Sequence[Path]) -> Iterator[None]:
    """Blender holds none of these files open meanwhile: what replaces one is read, and Windows lets it be replaced."""
    held = {
        cache: cache.filepath
        for cache in bpy.data.cache_files
        if Path(bpy.path.abspath(cache.filepath, library=cache.library)) in paths
    }
    for cache in held:
        cache.filepath = ""
    bpy.context.view_layer.update()
    try:
        yield
    finally:
        for cache, path in held.items():
            cache.filepath = path
