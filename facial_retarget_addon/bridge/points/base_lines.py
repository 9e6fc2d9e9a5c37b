"""The base mesh of source and target as lines on both faces, worked out on a thread."""

from __future__ import annotations

from collections.abc import Callable
from zlib import crc32

import numpy as np
from bpy.types import Object, PropertyGroup

from ...core.arrays import Progress
from ...core.base.base_mesh import base_mesh
from ...core.base.surface_lines import SurfaceLines, surface_lines
from ..meshes import neutral_mesh, read_positions, stretch
from ..raycast import available_caster
from .base_object import read_base
from .points import read_points

Lines = dict[int, SurfaceLines]
"""Lines of each face, by the object's session."""


def shape_stamp(thing: Object) -> int:
    """Tells whether an object's Basis, as we see it, has been changed."""
    mesh = thing.data
    corners = np.empty(len(mesh.loops), np.int32)
    if len(corners):
        # The attribute is copied as a block; mesh.loops is read one by one, 20 times slower.
        mesh.attributes[".corner_vert"].data.foreach_get("value", corners)
    stamp = crc32(read_positions(mesh).tobytes(), len(mesh.polygons))
    for values in (corners, stretch(thing).round(4)):
        stamp = crc32(values.tobytes(), stamp)
    return stamp


def base_lines_work(task: PropertyGroup) -> Callable[[Progress], Lines]:
    """What makes the lines of the task's faces on a thread: all Blender data is read here, before it runs.

    Source and target are taken at their Basis.

    Raises
    ------
    RetargetError : for bad points or triangles; the work raises it where no base mesh can be made.
    """
    things = (task.source, task.target)
    (source, source_points), (target, target_points) = ((neutral_mesh(thing), read_points(thing)) for thing in things)
    own = None if task.base is None else read_base(task.base)
    sessions = [thing.session_uid for thing in things]
    caster = available_caster()

    def work(_: Progress) -> Lines:
        base = base_mesh(source, source_points, target, target_points, own, caster)
        return {
            session: surface_lines(mesh, points.subset(base.names), base.faces)
            for session, mesh, points in zip(sessions, (source, target), (source_points, target_points), strict=True)
        }

    return work
