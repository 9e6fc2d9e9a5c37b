"""Feature points on objects and as arrays."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from bpy.types import Object, PropertyGroup, bpy_prop_collection

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
    return _read(thing, thing.facial_retarget.points)


def read_proposals(thing: Object) -> FeaturePoints:
    """The proposed points of an object; RetargetError as for `read_points`."""
    return _read(thing, thing.facial_retarget.proposals)


def _read(thing: Object, stored: bpy_prop_collection) -> FeaturePoints:
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
    """Replace the feature points of an object; what was proposed or skipped of these names no longer is."""
    face = thing.facial_retarget
    face.points.clear()
    for name, vertices, weights in zip(points.names, points.vertices, points.weights, strict=True):
        _append(face.points, name, vertices, weights)
        _drop(face.proposals, name)
        _drop(face.skipped, name)


def write_proposals(thing: Object, proposals: FeaturePoints) -> None:
    """Replace the proposed points of an object; names that are placed are left out."""
    face = thing.facial_retarget
    placed = set(face.points.keys())
    face.proposals.clear()
    for name, vertices, weights in zip(proposals.names, proposals.vertices, proposals.weights, strict=True):
        if name not in placed:
            _append(face.proposals, name, vertices, weights)


def place_point(thing: Object, name: str, vertices: Sequence[int], weights: Sequence[float]) -> None:
    """Add a feature point, or move the one of this name, and make it the active one.

    What was proposed or skipped of this name no longer is.

    Parameters
    ----------
    vertices : (3,) that hold it.
    weights : (3,) of these, adding up to 1.

    Raises
    ------
    RetargetError : if the name is empty.
    """
    face = thing.facial_retarget
    if not name:
        raise RetargetError("the new feature point has no name, expected an FDP number or a free name")
    row = face.points.find(name)
    if row < 0:
        _append(face.points, name, vertices, weights)
        row = len(face.points) - 1
    else:
        _put(face.points[row], vertices, weights)
    _drop(face.proposals, name)
    _drop(face.skipped, name)
    face.active_point = row


def remove_point(thing: Object, name: str) -> None:
    """Remove a feature point; RetargetError if there is none of this name."""
    face = thing.facial_retarget
    row = face.points.find(name)
    if row < 0:
        raise RetargetError(f"object {thing.name!r} has no feature point {name!r} to remove")
    face.points.remove(row)
    if face.active_point >= row:
        face.active_point = max(face.active_point - 1, 0)


def skip_point(thing: Object, name: str) -> None:
    """Note that a face shall do without a point: it is no longer proposed, and its turn does not come."""
    face = thing.facial_retarget
    _drop(face.proposals, name)
    if name not in face.skipped:
        face.skipped.add().name = name


def add_point_at_vertex(thing: Object, name: str, vertex: int) -> None:
    """Add a feature point on a vertex; RetargetError if the name is taken."""
    _place_new(thing, name, np.array([vertex] * 3), np.array([1.0, 0.0, 0.0]))


def add_point_near(thing: Object, name: str, place: FloatArray) -> None:
    """Add a feature point at the place of the neutral surface that is closest to `place` (3,) in world space."""
    mesh = neutral_mesh(thing)
    own = np.linalg.solve(np.array(thing.matrix_world, np.float64), [*place, 1.0])[:3]
    found = SurfaceFinder(mesh).closest(to_face_space(thing, own)[None])
    _place_new(thing, name, mesh.faces[found.face[0]], found.weights[0])


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


def _place_new(thing: Object, name: str, vertices: IntArray, weights: FloatArray) -> None:
    if name in thing.facial_retarget.points:
        raise RetargetError(f"object {thing.name!r} has a feature point {name!r} already, expected a new name")
    place_point(thing, name, vertices, weights)


def _append(stored: bpy_prop_collection, name: str, vertices: Sequence[int], weights: Sequence[float]) -> None:
    point = stored.add()
    point.name = name
    _put(point, vertices, weights)


def _put(point: PropertyGroup, vertices: Sequence[int], weights: Sequence[float]) -> None:
    # Blender takes no NumPy integers.
    point.vertices = [int(vertex) for vertex in vertices]
    point.weights = [float(weight) for weight in weights]


def _drop(stored: bpy_prop_collection, name: str) -> None:
    row = stored.find(name)
    if row >= 0:
        stored.remove(row)
