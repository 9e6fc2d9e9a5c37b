"""A head of several objects: the face, and the parts that the artist lists, as one mesh for the core."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from bpy.types import Depsgraph, Object

from ..core.arrays import BoolArray, FloatArray, IntArray
from ..core.errors import RetargetError
from ..core.mesh import TriMesh
from ..core.parts.kinds import NAMED_KINDS, NamedParts, skin_components
from ..core.points import FeaturePoints
from ..core.problem import Face
from ..files.mesh_file import MeshFile
from .key_sets import group_weights, key_names
from .meshes import evaluated_positions, from_face_space, read_positions, read_surface, stretch
from .points.points import read_points
from .shape_keys import find_key, key_displacement

BY_PLACE = "AUTO"
"""The role of a part that is told by where it lies."""
FLAT = 1e-6
"""A part is scaled to nothing if its least scale is below this share of its greatest."""


@dataclass(frozen=True, eq=False)
class Head:
    """The objects of a head, and what they are together.

    Attributes
    ----------
    things : the face object, then its parts.
    starts : (n + 1,) the first vertex of each object among the head's, and how many there are.
    linear : (n, 3, 3) displacements in an object's own coordinates to the head's, which are the face space of the face.
    file : the artist's polygons of all objects, on their vertices one after the other.
    face : mesh, points and named parts for the core.
    untold : parts whose role is to be told by where they lie.
    """

    things: tuple[Object, ...]
    starts: IntArray
    linear: FloatArray
    file: MeshFile
    face: Face
    untold: tuple[Object, ...] = ()

    @property
    def name(self) -> str:
        """The face object's name."""
        return self.things[0].name

    def slices(self) -> Iterator[tuple[Object, slice, FloatArray]]:
        """Each object, its vertices among the head's, and the matrix of its displacements."""
        for thing, first, last, matrix in zip(self.things, self.starts, self.starts[1:], self.linear, strict=False):
            yield thing, slice(first, last), matrix

    @property
    def groups(self) -> set[str]:
        """Names of the face object's vertex groups."""
        return set(self.things[0].vertex_groups.keys())

    def positions(self, thing: Object, moves: FloatArray) -> FloatArray:
        """(..., v, 3) in own coordinates: an object whose vertices move by `moves` (..., v, 3) of the head's."""
        inverse = np.linalg.inv(self.linear[self.things.index(thing)]).T
        return read_positions(thing.data) + (moves @ inverse).astype(np.float32)

    def key_names(self) -> list[str]:
        """Names of all shape keys that the objects have, each once."""
        return list(dict.fromkeys(name for thing in self.things for name in key_names(thing)))

    def owner(self, name: str) -> Object:
        """The first object that has a shape key of this name."""
        return next(thing for thing in self.things if find_key(thing, name) is not None)

    def displacements(self, names: Sequence[str], unmasked: Collection[str] = ()) -> FloatArray:
        """(E, V, 3) float32 what shape keys do at 1, in the head's coordinates; an object without the key is still.

        Parameters
        ----------
        unmasked : vertex groups that shall not mask their keys.

        Raises
        ------
        RetargetError : for a shape key with NaN.
        """
        moves = np.zeros((len(names), self.starts[-1], 3), np.float32)
        for thing, own, matrix in self.slices():
            masks: dict[str, FloatArray] = {}
            for row, name in enumerate(names):
                key = find_key(thing, name)
                if key is not None:
                    moved = key_displacement(key)
                    if key.vertex_group in thing.vertex_groups and key.vertex_group not in unmasked:
                        if key.vertex_group not in masks:
                            masks[key.vertex_group] = group_weights(thing, key.vertex_group)
                        moved *= masks[key.vertex_group][:, None]
                    moves[row, own] = moved @ matrix.T
                    if not np.isfinite(moves[row, own]).all():
                        raise RetargetError(f"shape key {name!r} of object {thing.name!r} has vertices that are NaN")
        return moves


def read_head(face: Object, neutral: FloatArray | None = None) -> Head:
    """A face object and its parts, each where it stands.

    Parameters
    ----------
    neutral : (V, 3) positions of all vertices in the head's coordinates; None for each object's Basis.

    Raises
    ------
    RetargetError : if one is no surface, is scaled to nothing, or is listed twice.
    """
    things = (face, *head_parts(face))
    matrices = [own_to_head(face, thing) for thing in things]
    starts = np.cumsum([0, *(len(thing.data.vertices) for thing in things)])
    files = []
    for thing, matrix, first, last in zip(things, matrices, starts, starts[1:], strict=False):
        places = (
            _moved(read_positions(thing.data).astype(np.float64), matrix) if neutral is None else neutral[first:last]
        )
        files.append(read_surface(thing, places, bool(np.linalg.det(matrix[:3, :3]) < 0)))
    file = _joined(files, starts)
    points = _points(things, starts)
    skin = np.isin(file.mesh.components, skin_components(file.mesh, points))
    return Head(
        things,
        starts,
        np.stack([matrix[:3, :3] for matrix in matrices]),
        file,
        Face(file.mesh, points, named_parts=_named_parts(things, starts, skin)),
        tuple(part.thing for part in face.facial_retarget.parts if part.role == BY_PLACE and part.thing in things),
    )


def head_parts(face: Object) -> list[Object]:
    """The objects listed as parts of a face's head; those that the artist has deleted since are none.

    Raises
    ------
    RetargetError : if the face itself is listed, or an object is listed twice.
    """
    things = [part.thing for part in face.facial_retarget.parts if part.thing is not None and part.thing.users_scene]
    for thing in things:
        if thing == face:
            raise RetargetError(f"object {face.name!r} is listed as a part of its own head, expected other objects")
        if things.count(thing) > 1:
            raise RetargetError(f"object {thing.name!r} is listed twice as a part of {face.name!r}, expected it once")
    return things


def own_to_head(face: Object, thing: Object) -> FloatArray:
    """(4, 4) an object's own coordinates to face space of the head's face, as both stand now.

    Raises
    ------
    RetargetError : if one of them is scaled to nothing.
    """
    to_face = np.eye(4)
    to_face[:3, :3] = stretch(face)
    if thing == face:
        return to_face
    world, own = (np.array(one.matrix_world, np.float64) for one in (face, thing))
    scales = np.linalg.svd(own[:3, :3], compute_uv=False)
    if scales[2] <= FLAT * scales[0]:
        raise RetargetError(f"object {thing.name!r} is scaled to nothing along an axis, expected a scale that is not 0")
    return to_face @ np.linalg.solve(world, own)


def head_now(things: Sequence[Object], depsgraph: Depsgraph) -> FloatArray:
    """(V, 3) float32 positions of a face and its parts as they look now, in face space of the face.

    Raises
    ------
    RetargetError : as `evaluated_positions` and `own_to_head`.
    """
    face = things[0]
    places = [evaluated_positions(face, depsgraph)]
    for part in things[1:]:
        own = from_face_space(part, evaluated_positions(part, depsgraph))
        places.append(_moved(own.astype(np.float64), own_to_head(face, part)).astype(np.float32))
    return places[0] if len(places) == 1 else np.concatenate(places)


def _moved(places: FloatArray, matrix: FloatArray) -> FloatArray:
    return places @ matrix[:3, :3].T + matrix[:3, 3]


def _joined(files: Sequence[MeshFile], starts: IntArray) -> MeshFile:
    """Several meshes as one, with UVs if all have them."""
    if len(files) == 1:
        return files[0]
    polygons = np.cumsum([0, *(len(file.counts) for file in files)])
    mesh = TriMesh(
        np.concatenate([file.mesh.vertices for file in files]),
        np.concatenate([file.mesh.faces + first for file, first in zip(files, starts, strict=False)]),
        np.concatenate([file.mesh.polygons + first for file, first in zip(files, polygons, strict=False)]),
    )
    counts = np.concatenate([file.counts for file in files])
    corners = np.concatenate([file.corners + first for file, first in zip(files, starts, strict=False)])
    uvs = [file.uvs for file in files if file.uvs is not None]
    return MeshFile(mesh, counts, corners, np.concatenate(uvs) if len(uvs) == len(files) else None)


def _named_parts(things: Sequence[Object], starts: IntArray, skin: BoolArray) -> dict[str, IntArray]:
    """What the artist calls a part -> vertices (n,): objects by their roles, others by vertex groups of such a name.

    skin : (V,) the face's skin; a group that reaches it is something else, such as a bone's weights.
    """
    roles = {part.thing: part.role for part in things[0].facial_retarget.parts if part.role != BY_PLACE}
    named: dict[str, list[IntArray]] = {}
    for thing, first, last in zip(things, starts, starts[1:], strict=False):
        if thing in roles:
            named.setdefault(roles[thing], []).append(np.arange(first, last))
            continue
        for name in (name for name in NAMED_KINDS if name in thing.vertex_groups):
            held = first + np.flatnonzero(group_weights(thing, name) > 0)
            if len(held) and not skin[held].any():
                named.setdefault(name, []).append(held)
    return {name: np.concatenate(held) for name, held in named.items()}


def write_named_parts(thing: Object, named: NamedParts) -> None:
    """Name parts of an object by vertex groups."""
    for name, vertices in named.items():
        thing.vertex_groups.new(name=name).add(vertices.tolist(), 1.0, "REPLACE")


def _points(things: Sequence[Object], starts: IntArray) -> FeaturePoints:
    """The points of all objects; a name that several have is the first one's."""
    points = read_points(things[0])
    for thing, first in zip(things[1:], starts[1:], strict=False):
        own = read_points(thing)
        new = own.subset([name for name in own.names if name not in points.names])
        points = points.joined(FeaturePoints(new.names, new.vertices + first, new.weights))
    return points
