"""Tells whether vertex numbers of a mesh still mean what they did. Loads no SciPy: panels ask."""

from __future__ import annotations

from zlib import crc32

import numpy as np
from bpy.types import Mesh, Object, PropertyGroup


def topology_of(mesh: Mesh) -> str:
    """Vertices, polygons, and which polygon has which vertex."""
    corners = np.empty(len(mesh.loops), np.int32)
    if mesh.is_editmode:
        mesh.loops.foreach_get("vertex_index", corners)
    elif len(corners):
        # As a block, 20 times faster than loop after loop.
        mesh.attributes[".corner_vert"].data.foreach_get("value", corners)
    return f"{len(mesh.vertices)} {len(mesh.polygons)} {crc32(corners.tobytes()):08x}"


def is_stale(point: PropertyGroup, topology: str) -> bool:
    """Whether a stored point was placed on another topology; files of before anchors have none and count as fresh."""
    return point.topology not in ("", topology)


def has_stale_points(thing: Object) -> bool:
    """Whether the mesh of an object has changed below its feature points."""
    stored = thing.facial_retarget.points
    topology = topology_of(thing.data) if len(stored) else ""
    return any(is_stale(point, topology) for point in stored)
