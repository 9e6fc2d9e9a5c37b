"""Feature points on objects and as arrays."""

from __future__ import annotations

import numpy as np
from bpy.types import Object

from ..core.arrays import FloatArray, IntArray
from ..core.closest_point import SurfaceFinder
from ..core.errors import RetargetError
from ..core.points import FeaturePoints
from .meshes import from_face_space, neutral_mesh, to_face_space


def read_points(thing: Object) -> FeaturePoints:
    """The feature points of an object.

    Raises
    ------
    RetargetError : if a name appears twice, a vertex is not there, or weights do not add up to anything.
    """
    stored = thing.facial_retarget.points
    names = tuple(point.name for point in stored)
    vertices = np.array([point.vertices[:] for point in stored], np.int64).reshape(-1, 3)
    weights = np.array([point.weights[:] for point in stored], np.float64).reshape(-1, 3)
    count = len(thing.data.vertices)
    for name, corners, parts in zip(names, vertices, weights, strict=True):
        if corners.max() >= count:
            raise RetargetError(
                f"feature point {name!r} of object {thing.name!r} lies on vertex {corners.max()}, "
                f"expected 0 to {count - 1}"
            )
        if parts.sum() <= 0:
            raise RetargetError(f"feature point {name!r} of object {thing.name!r} has weights that add up to nothing")
    # Blender keeps float32: the sums are made exact again.
    return FeaturePoints(names, vertices, weights / weights.sum(axis=1, keepdims=True))


def write_points(thing: Object, points: FeaturePoints) -> None:
    """Replace the feature points of an object."""
    stored = thing.facial_retarget.points
    stored.clear()
    for name, vertices, weights in zip(points.names, points.vertices, points.weights, strict=True):
        _append(thing, name, vertices, weights)


def add_point_at_vertex(thing: Object, name: str, vertex: int) -> None:
    """Add a feature point on a vertex; RetargetError if the name is taken."""
    _append_new(thing, name, np.array([vertex] * 3), np.array([1.0, 0.0, 0.0]))


def add_point_near(thing: Object, name: str, place: FloatArray) -> None:
    """Add a feature point at the place of the neutral surface that is closest to `place` (3,) in world space."""
    mesh = neutral_mesh(thing)
    own = np.linalg.solve(np.array(thing.matrix_world, np.float64), [*place, 1.0])[:3]
    found = SurfaceFinder(mesh).closest(to_face_space(thing, own)[None])
    _append_new(thing, name, mesh.faces[found.face[0]], found.weights[0])


def selected_vertex(thing: Object) -> int:
    """The one selected vertex, in Edit Mode too; RetargetError if there is not exactly one."""
    thing.update_from_editmode()
    selected = np.empty(len(thing.data.vertices), bool)
    thing.data.vertices.foreach_get("select", selected)
    if selected.sum() != 1:
        raise RetargetError(f"object {thing.name!r} has {selected.sum()} selected vertices, expected exactly one")
    return int(np.flatnonzero(selected)[0])


def point_positions(thing: Object) -> FloatArray:
    """(P, 3) feature points on the neutral, in the object's own coordinates."""
    points = read_points(thing)
    return from_face_space(thing, points.positions(neutral_mesh(thing).vertices))


def _append_new(thing: Object, name: str, vertices: IntArray, weights: FloatArray) -> None:
    if not name:
        raise RetargetError("the new feature point has no name, expected an FDP number or a free name")
    if name in thing.facial_retarget.points:
        raise RetargetError(f"object {thing.name!r} has a feature point {name!r} already, expected a new name")
    _append(thing, name, vertices, weights)
    thing.facial_retarget.active_point = len(thing.facial_retarget.points) - 1


def _append(thing: Object, name: str, vertices: IntArray, weights: FloatArray) -> None:
    point = thing.facial_retarget.points.add()
    point.name = name
    point.vertices = vertices.tolist()
    point.weights = weights.tolist()
