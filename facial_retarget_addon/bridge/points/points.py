"""Feature points on objects and as arrays."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from bpy.types import Object, PropertyGroup, bpy_prop_collection

from ...core.arrays import FloatArray, IntArray
from ...core.closest_point import SurfaceFinder
from ...core.errors import RetargetError
from ...core.points import FeaturePoints
from ..meshes import from_face_space, neutral_mesh, to_face_space
from ..scene.redraw import redraw_views
from .point_anchors import Settled, anchor_points, renew_rest, settle
from .topology import has_stale_points, is_stale, topology_of


def read_points(thing: Object) -> FeaturePoints:
    """The feature points of an object, on its mesh as it is now.

    Raises
    ------
    RetargetError : if a name appears twice, a vertex is not there, weights do not add up to anything, or the surface
        below a point is gone since it was placed.
    """
    settled = settled_points(thing)
    if settled.lost:
        raise RetargetError(
            f"the mesh of object {thing.name!r} has changed, and the surface below feature points "
            f"{', '.join(map(repr, settled.lost))} is gone; press Refresh Points, then place them anew or skip them"
        )
    return settled.points


def settled_points(thing: Object) -> Settled:
    """The feature points of an object on its mesh as it is now, and what became of them if it has changed.

    Nothing is written. RetargetError as for `read_points`, but for points that are lost.
    """
    stored = list(thing.facial_retarget.points)
    topology = topology_of(thing.data)
    stale = [is_stale(point, topology) for point in stored]
    points = _read(thing, stored, stale)
    return settle(thing, points, stored, stale) if any(stale) else Settled(points, {}, ())


def read_proposals(thing: Object) -> FeaturePoints:
    """The proposed points of an object, but for those of a topology that it no longer has."""
    topology = topology_of(thing.data)
    stored = [point for point in thing.facial_retarget.proposals if not is_stale(point, topology)]
    return _read(thing, stored, [False] * len(stored))


def _read(thing: Object, stored: list[PropertyGroup], stale: list[bool]) -> FeaturePoints:
    names = tuple(point.name for point in stored)
    vertices = np.array([point.vertices[:] for point in stored], np.int64).reshape(-1, 3)
    weights = np.array([point.weights[:] for point in stored], np.float64).reshape(-1, 3)
    count = len(thing.data.vertices)
    for name, corners, parts, old in zip(names, vertices, weights, stale, strict=True):
        if corners.max() >= count and not old:
            raise RetargetError(
                f"feature point {name!r} of object {thing.name!r} lies on vertex {corners.max()}, "
                f"expected 0 to {count - 1}"
            )
        if parts.sum() <= 0:
            raise RetargetError(f"feature point {name!r} of object {thing.name!r} has weights that add up to nothing")
    # Blender keeps float32: the sums are made exact again.
    return FeaturePoints(names, vertices, weights / weights.sum(axis=1, keepdims=True))


def refresh_points(thing: Object) -> Settled:
    """Put the feature points of an object on its mesh as it is now, and note their anchors anew.

    Points that are lost become proposals at the nearest place.
    """
    settled = settled_points(thing)
    kept = settled.points.subset([name for name in settled.points.names if name not in settled.lost])
    face = thing.facial_retarget
    renew_rest(thing.data)
    for name in settled.lost:
        face.points.remove(face.points.find(name))
    for point, vertices, weights in zip(face.points, kept.vertices, kept.weights, strict=True):
        _put(point, vertices, weights)
    anchor_points(thing, face.points)
    fresh = read_proposals(thing)
    lost = settled.points.subset([name for name in settled.lost if name not in fresh.names])
    write_proposals(thing, fresh.joined(lost))
    face.active_point = max(min(face.active_point, len(face.points) - 1), 0)
    return settled


def write_points(thing: Object, points: FeaturePoints) -> None:
    """Replace the feature points of an object; what was proposed or skipped of these names no longer is."""
    face = thing.facial_retarget
    face.points.clear()
    for name, vertices, weights in zip(points.names, points.vertices, points.weights, strict=True):
        _append(face.points, name, vertices, weights)
        _drop(face.proposals, name)
        _drop(face.skipped, name)
    anchor_points(thing, face.points)


def write_proposals(thing: Object, proposals: FeaturePoints) -> None:
    """Replace the proposed points of an object; names that are placed are left out."""
    face = thing.facial_retarget
    topology = topology_of(thing.data)
    placed = set(face.points.keys())
    face.proposals.clear()
    for name, vertices, weights in zip(proposals.names, proposals.vertices, proposals.weights, strict=True):
        if name not in placed:
            _append(face.proposals, name, vertices, weights)
            face.proposals[-1].topology = topology
    redraw_views()


def place_point(thing: Object, name: str, vertices: Sequence[int], weights: Sequence[float]) -> None:
    """Add a feature point, or move the one of this name, and make it the active one; see `place_points`.

    Parameters
    ----------
    vertices : (3,) that hold it.
    weights : (3,) of these, adding up to 1.
    """
    place_points(thing, FeaturePoints((name,), np.array([vertices]), np.array([weights])))
    thing.facial_retarget.active_point = thing.facial_retarget.points.find(name)


def place_points(thing: Object, points: FeaturePoints) -> None:
    """Add feature points, or move those of these names.

    What was proposed or skipped of these names no longer is. The others are put on the mesh as it is now.

    Raises
    ------
    RetargetError : if a name is empty, or the mesh has changed and other points are lost; nothing is placed then.
    """
    face = thing.facial_retarget
    if "" in points.names:
        raise RetargetError("the new feature point has no name, expected an FDP number or a free name")
    if not thing.data.is_editmode:
        _refresh_others(thing, set(points.names))
    for name, vertices, weights in zip(points.names, points.vertices, points.weights, strict=True):
        row = face.points.find(name)
        if row < 0:
            _append(face.points, name, vertices, weights)
        else:
            _put(face.points[row], vertices, weights)
        _drop(face.proposals, name)
        _drop(face.skipped, name)
    unknown = [point.name for point in face.points if not point.topology]
    anchor_points(thing, [face.points[name] for name in dict.fromkeys((*points.names, *unknown))])


def _refresh_others(thing: Object, placed: set[str]) -> None:
    """Bring the points that are not about to be placed onto the mesh as it is now, if it has changed."""
    if not has_stale_points(thing):
        return
    lost = [name for name in settled_points(thing).lost if name not in placed]
    if lost:
        raise RetargetError(
            f"the mesh of object {thing.name!r} has changed, and the surface below feature points "
            f"{', '.join(map(repr, lost))} is gone; press Refresh Points first"
        )
    refresh_points(thing)


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


def want_point(thing: Object, name: str) -> None:
    """Take back that a face does without a point; RetargetError if it was not skipped."""
    if name not in thing.facial_retarget.skipped:
        raise RetargetError(f"object {thing.name!r} has not skipped the feature point {name!r}")
    _drop(thing.facial_retarget.skipped, name)


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
