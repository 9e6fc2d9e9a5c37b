"""Where cloned shapes come from: a head of the scene, or the built-in actor."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from math import pi
from typing import Protocol

from bpy.types import Context, Object, PropertyGroup

from ...core.arrays import Progress
from ...core.errors import RetargetError
from ...core.problem import Face
from ...core.shapes.shape_set import ShapeSet
from ...demo import DemoFace, donor
from ...demo.shape_sets import face_shapes
from ...files.mesh_file import MeshFile
from ..background import Steps, in_thread
from ..heads import Head, read_head, write_named_parts
from ..key_sets import KeyTraits, check_relative, read_traits, write_keys
from ..meshes import new_face
from ..points.points import write_points
from ..shape_keys import find_key

STANDING = 0.5 * pi
"""The built-in faces stand along Y, Blender's along Z: a turn around X, in radians."""


class Donor(Protocol):
    """A face and its shapes."""

    @property
    def face(self) -> Face:
        """Mesh, points and named parts."""
        ...

    @property
    def names(self) -> Sequence[str]:
        """Names of all its shapes."""
        ...

    @property
    def things(self) -> Collection[Object]:
        """Its objects in the scene."""
        ...

    def shapes(self, names: Sequence[str], unmasked: Collection[str]) -> ShapeSet:
        """Some of its shapes; vertex groups in `unmasked` do not mask them."""
        ...

    def traits(self, name: str) -> KeyTraits:
        """What a shape is beside its displacements."""
        ...

    def owner(self, name: str) -> Object | None:
        """The object whose drivers and animation a shape has."""
        ...


class HeadDonor:
    """A head of the scene."""

    def __init__(self, head: Head) -> None:
        self.face, self.things = head.face, head.things
        self.names = head.key_names()
        self.owner = head.owner
        self._head = head

    def shapes(self, names: Sequence[str], unmasked: Collection[str]) -> ShapeSet:
        """Some of its shapes; vertex groups in `unmasked` do not mask them."""
        return ShapeSet(tuple(names), self._head.displacements(names, unmasked))

    def traits(self, name: str) -> KeyTraits:
        """What a shape key is beside its shape."""
        return read_traits(find_key(self.owner(name), name))


@dataclass(frozen=True, eq=False)
class ActorDonor:
    """The built-in actor, which is no object.

    built : its mesh and how it acts.
    all_shapes : of the sets that were asked for.
    """

    built: DemoFace
    all_shapes: ShapeSet
    things: tuple[Object, ...] = ()

    @property
    def face(self) -> Face:
        """Mesh, points and named parts; its examples are other things than shapes to clone."""
        return replace(self.built.face, examples={})

    @property
    def names(self) -> Sequence[str]:
        """Names of all its shapes."""
        return self.all_shapes.names

    def shapes(self, names: Sequence[str], unmasked: Collection[str]) -> ShapeSet:
        """Some of its shapes."""
        return self.all_shapes.subset(names)

    def traits(self, name: str) -> KeyTraits:
        """As a new shape key has them."""
        return KeyTraits()

    def owner(self, name: str) -> None:
        """It has neither drivers nor animation."""
        return None


def donor_steps(task: PropertyGroup) -> Steps[Donor]:
    """The task's donor.

    Raises
    ------
    RetargetError : as `read_source_head`, or if no set of the actor is chosen.
    """
    if task.cloning.donor == "ACTOR":
        return (yield from actor_steps(task.cloning.actor_sets))
    return HeadDonor(read_source_head(task))


def read_source_head(task: PropertyGroup) -> Head:
    """The head whose shape keys are cloned.

    Raises
    ------
    RetargetError : if no source is chosen, or it has no shape keys, or absolute ones.
    """
    if task.source is None:
        raise RetargetError("no source is chosen, expected a mesh object under Faces, or the built-in actor")
    head = read_head(task.source)
    for thing in head.things:
        check_relative(thing)
    if not head.key_names():
        raise RetargetError(f"object {head.name!r} has no shape keys beside its Basis, expected some to clone")
    return head


def actor_steps(sets: Collection[str]) -> Steps[ActorDonor]:
    """The built-in actor with some of the standard's sets; RetargetError without any."""
    if not sets:
        raise RetargetError("no set of the built-in actor is chosen, expected ARKit, visemes or expressions")

    def make(progress: Progress) -> ActorDonor:
        progress(0.0, "making the built-in actor")
        built = donor()
        progress(0.5, "acting its shapes")
        return ActorDonor(built, ShapeSet.of_positions(built.face.mesh.vertices, face_shapes(built, sorted(sets))))

    return (yield from in_thread(make))


def add_actor_steps(context: Context, sets: Collection[str]) -> Steps[Object]:
    """Put the built-in actor into the scene, with its shape keys and feature points, and make it the source.

    Raises
    ------
    RetargetError : as `actor_steps`.
    """
    donor = yield from actor_steps(sets)
    built = donor.built
    made = new_face("Actor", MeshFile(built.face.mesh, built.counts, built.corners, built.uvs[built.corners]))
    made.rotation_euler.x = STANDING
    write_points(made, built.face.points)
    write_named_parts(made, built.face.named_parts)
    write_keys(made, dict(zip(donor.names, donor.all_shapes.displacements, strict=True)), {})
    context.scene.facial_retarget.source = made
    return made
