"""Normal maps of the task's performance: pictures in a folder, wired into materials."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple, cast

import bpy
import numpy as np
from bpy.types import Context, Object

from ...core.arrays import FloatArray, Progress, progress_part
from ...core.errors import RetargetError
from ...core.level_retargeter import LevelRetargeter
from ...core.methods.settings import LEVELED
from ...core.normal_maps.frame_maps import FrameMaps
from ...core.normal_maps.surface import TexturedSurface
from ...core.retarget import checked_fit
from ...files.images import suffix_of
from ...files.normal_map_files import first_number, textured, write_frame_maps
from ...files.whole import Aside, appear_whole, written_aside
from ..background import Steps, in_thread, part
from ..bakes.frames import write_frames
from ..heads import head_parts, read_head
from ..key_sets import check_targets
from ..meshes import from_face_space, name_beside, new_object, read_face
from ..performance import read_frames
from ..settings import read_task_settings
from ..task import frame_range, read_problem
from .map_nodes import MapSequence, check_uv_name, wire
from .map_output import map_folder, map_settings

UV_NAME = "UVMap"
READING = 0.1


class MadeMaps(NamedTuple):
    """Where the maps went: the folder, the object that they are for, and warnings."""

    folder: Path
    thing: Object
    warnings: list[str]


class _Computed(NamedTuple):
    """The maps, the light mesh (F, V, 3) of the frames, and the pictures, which have not appeared yet."""

    maps: FrameMaps
    light: FloatArray
    aside: Aside

    def discard(self) -> None:
        """Leave no picture behind."""
        self.aside.vanish()


def normal_map_steps(context: Context) -> Steps[MadeMaps]:
    """Make the normal maps of the task's frames, and let materials show them.

    The light mesh is the target itself, or a level of its normal mesh, which becomes an object with the frames as keys.
    Closing the steps at any time leaves scene and disk as they were.

    Raises
    ------
    RetargetError : for bad input, a method without levels, a target without UVs; says what, and on which object.
    """
    task = context.scene.facial_retarget
    wish, method, settings = task.normal_maps, task.method, read_task_settings(task)
    if method not in LEVELED:
        raise RetargetError(f"method {method!r} has no levels, expected one of {', '.join(LEVELED)}")
    folder = map_folder(wish)
    problem = read_problem(context)
    check_targets((task.source, *head_parts(task.source)), read_head(task.target).things)
    made = map_settings(wish)
    surface = None if made.level else textured(read_face(task.target), f"object {task.target.name!r}")
    if surface is not None and wish.wire:
        check_uv_name(task.target)
    frames = frame_range(context)
    source = yield from part(read_frames(context, task.source, frames), 0.0, READING)

    def compute(progress: Progress) -> _Computed:
        with written_aside() as aside:
            place = aside.place(folder, replaces=suffix_of(made.depth))
            place.mkdir()
            fitted = cast(LevelRetargeter, checked_fit(method, problem, settings, progress_part(progress, 0.0, 0.3)))
            maps = FrameMaps(fitted, problem, surface, made, progress_part(progress, 0.3, 0.4))
            writing = progress_part(progress, 0.4, 1.0)
            light = write_frame_maps(place, made, maps, source, first_number(frames.start), writing)
        return _Computed(maps, light, aside)

    computed = yield from part(in_thread(compute, _Computed.discard), READING, 1 - READING)
    appear_whole(computed.aside)
    thing = task.target
    if made.level:
        name = name_beside(task.target, f" level {made.level}")
        thing = level_object(name, task.target, computed.maps.surface)
        write_frames(thing, computed.light, frames.start)
    sequence = MapSequence(folder, made, tuple(computed.maps.maps), frames, computed.maps.mapped.shown_polygons)
    warnings = _shading_warnings(thing) + (wire(thing, sequence) if wish.wire else [])
    return MadeMaps(folder, thing, warnings)


def _shading_warnings(thing: Object) -> list[str]:
    """What an object's shading does to maps that are made for smooth normals."""
    if thing.data.normals_domain == "POINT":
        return []
    return [
        f"object {thing.name!r} has flat faces, sharp edges or custom normals: the maps, which are made for smooth "
        "shading, look wrong there"
    ]


def level_object(name: str, target: Object, surface: TexturedSurface) -> Object:
    """A level of the target's normal mesh as an object where the target is.

    An earlier one of that name is replaced; its materials stay.
    """
    before, kept = bpy.data.objects.get(name), []
    if before is not None and before.type == "MESH":
        kept = list(before.data.materials)
        bpy.data.meshes.remove(before.data)
    made = new_object(name, from_face_space(target, surface.mesh.vertices), surface.counts, surface.corners)
    made.data.shade_smooth()
    made.data.uv_layers.new(name=UV_NAME).uv.foreach_set("vector", np.ravel(surface.uvs).astype(np.float32))
    made.matrix_world = target.matrix_world
    for material in kept:
        made.data.materials.append(material)
    return made
