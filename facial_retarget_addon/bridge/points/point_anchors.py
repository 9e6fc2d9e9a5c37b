"""Feature points hold to the surface, not to vertex numbers: what becomes of them when a mesh is cut or renumbered.

A point is three vertices and their weights. Beside these it keeps its *anchor*: its place and normal on the mesh as it
was at rest. The mesh keeps that rest position of each vertex as an attribute, which Blender carries along when vertices
are deleted, merged or added between others. So a point is found again by its anchor on the rest positions, even where
the mesh was sculpted in between. Without the attribute (a mesh made anew) the vertices' own positions stand in for it.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple
from zlib import crc32

import numpy as np
from bpy.types import Mesh, Object, PropertyGroup

from ...core.arrays import BoolArray, FloatArray, IntArray
from ...core.closest_point import Nearest, SurfaceFinder
from ...core.errors import RetargetError
from ...core.mesh import TriMesh
from ...core.points import FeaturePoints
from ..meshes import read_polygons, read_positions
from .topology import topology_of

REST = ".facial_retarget_rest"
"""The attribute of the rest positions; the dot keeps it out of the artist's lists."""
FARTHEST = 0.02
"""A place farther from the anchor than this, as a share of the mesh's size, is not the point's."""
AT_BORDER = 0.002
"""The same for a place on the border of the surface: there the surface below the point may have been deleted."""
SAME = 1e-5
"""Places nearer than this, as a share of the mesh's size, are the same."""


class Settled(NamedTuple):
    """Where points are on a mesh that has changed.

    Attributes
    ----------
    points : all of them; those that are lost at the place nearest to their anchor.
    moved : name -> distance from the anchor, in the object's units, of those that did not stay exactly where they were.
    lost : names of those whose surface is gone.
    """

    points: FeaturePoints
    moved: dict[str, float]
    lost: tuple[str, ...]


def anchor_points(thing: Object, stored: Iterable[PropertyGroup]) -> None:
    """Note where points are on the mesh, so that they are found again.

    In Edit Mode Blender shows no attributes: there only the topology is noted, and the anchor the next time.
    """
    topology = topology_of(thing.data)
    rest = None if thing.data.is_editmode else _rest_data(thing.data)
    for point in stored:
        point.topology = topology
        point.anchored = rest is not None
        if rest is not None:
            corners = [rest[vertex].vector for vertex in point.vertices]
            normals = [thing.data.vertices[vertex].normal for vertex in point.vertices]
            point.anchor = _mean(corners, point.weights)
            point.anchor_normal = _mean(normals, point.weights)


def settle(thing: Object, points: FeaturePoints, stored: list[PropertyGroup], stale: list[bool]) -> Settled:
    """Where stale points are on the mesh as it is now. Nothing is written.

    Parameters
    ----------
    points : as they are stored, (P,).
    stored : (P) the stored points themselves.
    stale : (P) which of them are.

    Raises
    ------
    RetargetError : in Edit Mode, where Blender shows no rest positions, and where no surface is left.
    """
    if thing.data.is_editmode:
        raise RetargetError(f"the mesh of object {thing.name!r} is being changed, expected it out of Edit Mode")
    rows = np.flatnonzero(stale)
    anchors = np.array([stored[row].anchor[:] for row in rows], np.float64).reshape(-1, 3)
    normals = np.array([stored[row].anchor_normal[:] for row in rows], np.float64).reshape(-1, 3)
    known = np.array([stored[row].anchored for row in rows], bool)
    mesh, (places, gone) = _found_before(thing, anchors, normals)
    vertices, weights = _tidy(mesh, places)
    all_vertices, all_weights = points.vertices.copy(), points.weights.copy()
    all_vertices[rows], all_weights[rows] = vertices, weights
    lost = tuple(points.names[row] for row, bad in zip(rows, gone | ~known, strict=True) if bad)
    moved = {
        points.names[row]: float(distance)
        for row, distance in zip(rows, places.distance, strict=True)
        if distance > SAME * mesh.size and points.names[row] not in lost
    }
    return Settled(FeaturePoints(points.names, all_vertices, all_weights), moved, lost)


def renew_rest(mesh: Mesh) -> None:
    """Note the vertices' positions as the rest positions, unless other objects' points are anchored on the old ones."""
    if mesh.users == 1 and REST in mesh.attributes:
        mesh.attributes.remove(mesh.attributes[REST])


def _rest_data(mesh: Mesh) -> object:
    """The data of the attribute, which is made of the vertices' positions if there is none yet."""
    rest = mesh.attributes.get(REST)
    if rest is None:
        rest = mesh.attributes.new(REST, "FLOAT_VECTOR", "POINT")
        rest.data.foreach_set("vector", read_positions(mesh).ravel())
    return rest.data


def _mean(vectors: list[object], weights: Iterable[float]) -> FloatArray:
    total = np.average(np.array(vectors, np.float64), axis=0, weights=np.array(weights[:], np.float64))
    return total.tolist()


_found: dict[tuple[object, ...], tuple[TriMesh, tuple[Nearest, BoolArray]]] = {}
"""What was searched last -> what was found: the 3D view asks at every redraw."""


def _found_before(thing: Object, anchors: FloatArray, normals: FloatArray) -> tuple[TriMesh, tuple[Nearest, BoolArray]]:
    """The mesh at rest, in the object's own coordinates, and what `_find` finds on it."""
    mesh = thing.data
    positions = read_positions(mesh)
    rest = mesh.attributes.get(REST)
    if rest is not None:
        rest.data.foreach_get("vector", positions.ravel())
    search = positions.tobytes() + anchors.tobytes() + normals.tobytes()
    key = (mesh.session_uid, topology_of(mesh), crc32(search))
    if key not in _found:
        at_rest = TriMesh.from_polygons(positions.astype(np.float64), *read_polygons(mesh))
        at_rest.checked(f"object {thing.name!r}")
        _found.clear()
        _found[key] = at_rest, _find(at_rest, anchors, normals)
    return _found[key]


def _find(mesh: TriMesh, anchors: FloatArray, normals: FloatArray) -> tuple[Nearest, BoolArray]:
    """Places (N,) of anchors, where the normals agree if there is such a place; (N,) true where there is none."""
    finder = SurfaceFinder(mesh)
    places = finder.closest(anchors, normals, 0.0, FARTHEST * mesh.size)
    gone = places.face < 0
    if gone.any():
        for all_places, some in zip(places, finder.closest(anchors[gone]), strict=True):
            all_places[gone] = some
    at_border = _on_border(mesh, places) & (places.distance > AT_BORDER * mesh.size)
    return places, gone | at_border


def _on_border(mesh: TriMesh, places: Nearest) -> BoolArray:
    """(N,) true for places that lie on a vertex or an edge of the border."""
    corners = mesh.faces[places.face]
    holds = places.weights > SAME
    border: BoolArray = ~holds.all(axis=1) & (~holds | mesh.boundary_vertices[corners]).all(axis=1)
    return border


def _tidy(mesh: TriMesh, places: Nearest) -> tuple[IntArray, FloatArray]:
    """Vertices and weights (N, 3) of places; a place on a vertex is that vertex alone, as when it was placed."""
    vertices = mesh.faces[places.face]
    weights = np.where(places.weights > SAME, places.weights, 0.0)
    holder = np.take_along_axis(vertices, weights.argmax(axis=1)[:, None], axis=1)
    alone = np.linalg.norm(mesh.vertices[holder[:, 0]] - places.point, axis=1) <= SAME * mesh.size
    vertices[alone], weights[alone] = holder[alone], (1.0, 0.0, 0.0)
    return vertices, weights / weights.sum(axis=1, keepdims=True)
