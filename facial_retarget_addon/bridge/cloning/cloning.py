"""A whole set of shape keys from one head onto one or several others: read, compute, then write once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from glob import escape
from itertools import chain
from typing import Any, NamedTuple

from bpy.types import Context, Object, PropertyGroup

from ...core.arrays import Progress
from ...core.errors import RetargetError
from ...core.methods.settings import Settings
from ...core.problem import Problem
from ...core.shapes.clone import ClonedShapes, clone_shapes
from ...core.shapes.combinations import find_correctives
from ...core.shapes.prepare import PreparedShapes, prepare_shapes
from ...core.shapes.sides import left_share
from ..background import Steps, in_thread, part
from ..heads import Head, head_parts, read_head
from ..key_sets import check_targets
from ..raycast import available_caster
from ..settings import read_method_settings
from .clone_report import write_report
from .clone_wishes import origins, preparation, wanted_names
from .clones import Clones, Copying, write_clones
from .donors import Donor, donor_steps
from .head_shapes import plan_names

MAKING, COMPUTING = 0.05, 0.9
"""Shares of the time that making the donor and computing take."""


class Outcome(NamedTuple):
    """How many shape keys were cloned, and kept as they were, on how many heads, and what is to be said."""

    cloned: int
    kept: int
    heads: int
    warnings: list[str]


def clone_steps(context: Context) -> Steps[Outcome]:
    """Clone the shape keys that the panel asks for onto the heads that it names.

    Closing the steps at any time leaves the scene as it was: everything is written at the very end.

    Raises
    ------
    RetargetError : for bad input; says what, and on which object.
    """
    task = context.scene.facial_retarget
    cloning = task.cloning
    settings = read_method_settings(task, cloning.method)
    faces = target_faces(context)
    donor = yield from part(donor_steps(task), 0.0, MAKING)
    names = wanted_names(donor.names, cloning)
    heads = [read_head(face) for face in faces]
    check_targets(donor.things, [thing for head in heads for thing in head.things])
    works = [cloner(donor, head, names, cloning.method, settings, cloning) for head in heads]
    made = yield from part(computed(heads, works), MAKING, COMPUTING)
    yield MAKING + COMPUTING, "Writing"
    plans = [plan_names(clones.head, clones.shapes.names, cloning.existing) for clones in made]
    copying = Copying(cloning.copy_drivers, cloning.copy_animation)
    unable = [write_clones(clones, plan, donor, copying) for clones, plan in zip(made, plans, strict=True)]
    write_report({clones.head.name: clones.report for clones in made})
    cloned = sum(len(plan) for plan in plans)
    kept = sum(len(clones.shapes) for clones in made) - cloned
    return Outcome(cloned, kept, len(heads), [*named_warnings(made), *dict.fromkeys(chain(*unable))])


def computed(heads: Sequence[Head], works: Sequence[Callable[[Progress], Clones]]) -> Steps[list[Clones]]:
    """What each head's work makes, one after the other on a thread.

    Raises
    ------
    RetargetError : as the works; it says which head it means if there are several.
    """
    made: list[Clones] = []
    for i, (head, work) in enumerate(zip(heads, works, strict=True)):
        try:
            made.append((yield from part(in_thread(work), i / len(heads), 1 / len(heads))))
        except RetargetError as error:
            if len(heads) == 1:
                raise
            raise RetargetError(f"{head.name}: {error}") from error
    return made


def named_warnings(made: Sequence[Clones]) -> list[str]:
    """The warnings of all heads; each says which head it means if there are several."""
    if len(made) == 1:
        return made[0].warnings
    return [f"{clones.head.name}: {warning}" for clones in made for warning in clones.warnings]


def cloner(
    donor: Donor, head: Head, names: Sequence[str], method: str, settings: Settings, cloning: PropertyGroup
) -> Callable[[Progress], Clones]:
    """What clones some of a donor's shapes onto a head, on a thread: all Blender data is read here, before it runs.

    Correctives are cloned together with the shapes that they need, whether these are wanted or not.
    """
    prepare = preparer(donor, head, names, cloning)
    made_of = origins(names, preparation(cloning))
    problem = Problem(donor.face, head.face, make_caster=available_caster())

    def clone(progress: Progress) -> Clones:
        ready = prepare()
        cloned = clone_shapes(method, problem, settings, ready.shapes, ready.correctives, progress).only(ready.wanted)
        return Clones(head, cloned.shapes, made_of, row_of(cloned), cloned.spots, cloned.report)

    return clone


def preparer(donor: Donor, head: Head, names: Sequence[str], cloning: PropertyGroup) -> Callable[[], PreparedShapes]:
    """What makes some of a donor's shapes ready for a head, on a thread: all Blender data is read here."""
    needed = {need for one in find_correctives(donor.names) if one.name in names for need in one.needs}
    shapes = donor.shapes([name for name in donor.names if name in names or name in needed], head.groups)
    how = replace(preparation(cloning), keep=tuple(escape(name) for name in names), drop=())

    def prepare() -> PreparedShapes:
        share = left_share(donor.face.mesh, donor.face.points, how.feather) if how.split else None
        return prepare_shapes(shapes, how, share)

    return prepare


def row_of(cloned: ClonedShapes) -> dict[str, dict[str, Any]]:
    """Name of a shape -> its row."""
    return {row["name"]: row for row in cloned.rows}


def target_faces(context: Context) -> list[Object]:
    """The face objects that the panel wants shapes cloned onto.

    Raises
    ------
    RetargetError : if there are none, or the target is the source.
    """
    task = context.scene.facial_retarget
    source = task.source if task.cloning.donor == "SOURCE" else None
    if task.cloning.targets == "TARGET":
        if task.target is None:
            raise RetargetError("no target is chosen, expected a mesh object under Faces")
        if task.target == source:
            raise RetargetError(f"source and target are both object {source.name!r}, expected two objects")
        return [task.target]
    selected = [thing for thing in context.selected_objects if thing.type == "MESH" and thing != source]
    faces = [thing for thing in selected if len(thing.facial_retarget.points)]
    parts = {piece for face in faces for piece in head_parts(face)} | set(head_parts(source) if source else ())
    faces = [face for face in faces if face not in parts]
    if not faces:
        raise RetargetError(
            f"none of the {len(selected)} selected mesh objects beside the source has feature points, expected faces"
        )
    return sorted(faces, key=lambda face: face.name)
