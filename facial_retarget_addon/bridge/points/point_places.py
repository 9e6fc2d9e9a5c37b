"""Where the feature points of an object are in the world, as it looks now."""

from __future__ import annotations

import numpy as np
from bpy.types import Depsgraph, Object

from ...core.arrays import FloatArray
from ..meshes import read_positions
from .points import read_proposals, settled_points

LOSES_ORDER = {
    *("BEVEL", "BOOLEAN", "BUILD", "DECIMATE", "EXPLODE", "FLUID", "MASK", "NODES", "OCEAN", "REMESH", "SKIN"),
    *("VOLUME_TO_MESH", "WELD", "WIREFRAME"),
}
"""Modifiers that may renumber the vertices. Others that add some, as subdivision does, put them behind the old ones."""


def world_places(thing: Object, depsgraph: Depsgraph, which: str = "points") -> tuple[tuple[str, ...], FloatArray]:
    """Names and places (P, 3), in world space, of the points on the evaluated surface.

    Points that have lost their surface are where it was. In Edit Mode, where Blender shows no evaluated surface, there
    are none. Where a modifier has renumbered the vertices, a point lies where the surface is closest to its place
    before all modifiers.

    Parameters
    ----------
    which : "points" for those that are placed, "proposals" for those that are predicted.

    Raises
    ------
    RetargetError : as for `settled_points`.
    """
    if thing.data.is_editmode:
        return (), np.empty((0, 3))
    points = settled_points(thing).points if which == "points" else read_proposals(thing)
    if not len(points):
        return (), np.empty((0, 3))
    vertices = shown_vertices(thing, depsgraph)
    if vertices is not None:
        return points.names, points.positions(vertices)
    before = points.positions(read_positions(thing.data).astype(np.float64))
    shown = thing.evaluated_get(depsgraph)
    own = np.array([shown.closest_point_on_mesh(place)[1] for place in before.tolist()])
    return points.names, _in_world(thing, own)


def shown_vertices(thing: Object, depsgraph: Depsgraph) -> FloatArray | None:
    """(V, 3) places in world space where modifiers and shape keys have put the vertices of an object's own mesh.

    None where a modifier has renumbered them.
    """
    shown, count = thing.evaluated_get(depsgraph).data, len(thing.data.vertices)
    if not _order_kept(thing, len(shown.vertices)):
        return None
    flat = np.empty(3 * len(shown.vertices), np.float32)
    shown.attributes["position"].data.foreach_get("vector", flat)
    return _in_world(thing, flat.reshape(-1, 3)[:count].astype(np.float64))


def _in_world(thing: Object, own: FloatArray) -> FloatArray:
    matrix = np.array(thing.matrix_world, np.float64)
    return own @ matrix[:3, :3].T + matrix[:3, 3]


def world_normals(thing: Object, depsgraph: Depsgraph, which: str = "points") -> FloatArray:
    """(P, 3) normals of the evaluated surface at the points, in world space and of no particular length; 0 where a
    modifier has renumbered the vertices. The parameters and errors are those of `world_places`.
    """
    if thing.data.is_editmode:
        return np.empty((0, 3))
    points = settled_points(thing).points if which == "points" else read_proposals(thing)
    shown = thing.evaluated_get(depsgraph).data
    if not len(points) or not _order_kept(thing, len(shown.vertices)):
        return np.zeros((len(points), 3))
    flat = np.empty(3 * len(shown.vertices), np.float32)
    shown.vertex_normals.foreach_get("vector", flat)
    normals = points.positions(flat.reshape(-1, 3).astype(np.float64))
    # What is mirrored keeps its outside: a normal goes through the inverse, transposed.
    return normals @ np.linalg.inv(np.array(thing.matrix_world, np.float64)[:3, :3])


def _order_kept(thing: Object, shown: int) -> bool:
    count = len(thing.data.vertices)
    active = {modifier.type for modifier in thing.modifiers if modifier.show_viewport}
    return shown == count or (shown > count and not active & LOSES_ORDER)
