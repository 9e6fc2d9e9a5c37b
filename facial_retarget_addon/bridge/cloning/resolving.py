"""Re-solve: cloned shape keys that the artist has corrected teach the others, and stay as they are."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from bpy.types import Context, PropertyGroup

from ...core.arrays import Progress
from ...core.errors import RetargetError
from ...core.methods.settings import Settings
from ...core.problem import Problem
from ...core.shapes.choose import listed
from ...core.shapes.combinations import Corrective, find_correctives
from ...core.shapes.resolve import resolve_shapes
from ...core.shapes.shape_set import ShapeSet
from ...core.shapes.sides import left_share
from ..background import Steps, part
from ..heads import Head, read_head
from ..key_sets import check_targets
from ..raycast import available_caster
from ..settings import read_method_settings
from ..shape_keys import find_key
from .clone_report import write_report
from .clone_wishes import Origin
from .clones import Clones, fingerprint, write_shapes
from .cloning import COMPUTING, MAKING, computed, named_warnings, row_of, target_faces
from .donors import Donor, donor_steps


class Solved(NamedTuple):
    """How many shape keys were solved again, how many taught them, and what is to be said."""

    solved: int
    corrected: int
    warnings: list[str]


def find_corrected(head: Head) -> list[str]:
    """Names of a head's cloned shape keys that are marked as corrected, or are not what was cloned any more."""
    return [
        entry.name
        for entry in _entries(head)
        if entry.corrected or (entry.shape and fingerprint(head, entry.name) != entry.shape)
    ]


def cloned_origins(head: Head) -> dict[str, Origin]:
    """Name of each cloned shape key of a head -> where it comes from."""
    return {entry.name: Origin(tuple(one.name for one in entry.origins), entry.side) for entry in _entries(head)}


def mark_corrected(context: Context) -> int:
    """Mark the changed keys of the heads that the panel names as corrected; returns how many are marked now."""
    heads = [read_head(face) for face in target_faces(context)]
    found = [(head, name) for head in heads for name in find_corrected(head)]
    for head, name in found:
        head.things[0].facial_retarget.cloned[name].corrected = True
    return len(found)


def resolve_steps(context: Context) -> Steps[Solved]:
    """Solve the cloned shape keys of the heads that the panel names again, but for those that the artist has corrected.

    Closing the steps at any time leaves the scene as it was: everything is written at the very end.

    Raises
    ------
    RetargetError : for bad input, or if no key has been corrected, or all of them.
    """
    task = context.scene.facial_retarget
    cloning = task.cloning
    settings = read_method_settings(task, cloning.method)
    faces = target_faces(context)
    donor = yield from part(donor_steps(task), 0.0, MAKING)
    heads = [read_head(face) for face in faces]
    check_targets(donor.things, [thing for head in heads for thing in head.things])
    lessons = [_lesson(donor, head) for head in heads]
    works = [solver(donor, lesson, cloning.method, settings, cloning.feather) for lesson in lessons]
    made = yield from part(computed(heads, works), MAKING, COMPUTING)
    yield MAKING + COMPUTING, "Writing"
    for clones, lesson in zip(made, lessons, strict=True):
        write_shapes(clones, {name: name for name in clones.shapes.names}, {})
        for name in lesson.corrected.names:
            clones.head.things[0].facial_retarget.cloned[name].corrected = True
    write_report({clones.head.name: clones.report for clones in made})
    return Solved(
        sum(len(clones.shapes) for clones in made),
        sum(len(lesson.corrected) for lesson in lessons),
        named_warnings(made),
    )


class Lesson(NamedTuple):
    """What a head has to learn from: its corrected shapes, and where each of its cloned keys comes from."""

    head: Head
    origins: Mapping[str, Origin]
    corrected: ShapeSet


def _lesson(donor: Donor, head: Head) -> Lesson:
    """A head's corrections.

    Raises
    ------
    RetargetError : if it has none, nothing else, or keys of which the donor does not know where they come from.
    """
    origins = cloned_origins(head)
    corrected = find_corrected(head)
    if not origins:
        raise RetargetError(f"object {head.name!r} has no cloned shape keys, expected some of which one is corrected")
    if not corrected:
        raise RetargetError(
            f"none of the {len(origins)} cloned shape keys of object {head.name!r} is corrected, "
            "expected one that you have sculpted on or marked"
        )
    if len(corrected) == len(origins):
        raise RetargetError(f"all {len(origins)} cloned shape keys of object {head.name!r} are corrected: none is left")
    lost = {old for origin in origins.values() for old in origin.names} - set(donor.names)
    if lost:
        raise RetargetError(
            f"the source has no shape {listed(sorted(lost))}, from which keys of object {head.name!r} were cloned"
        )
    groups = {group.name for thing in head.things for group in thing.vertex_groups}
    return Lesson(head, origins, ShapeSet(tuple(corrected), head.displacements(corrected, groups)))


def _entries(head: Head) -> list[PropertyGroup]:
    """The cloned keys that the face object still has."""
    face = head.things[0]
    return [entry for entry in face.facial_retarget.cloned if find_key(face, entry.name) is not None]


def solver(
    donor: Donor, lesson: Lesson, method: str, settings: Settings, feather: float
) -> Callable[[Progress], Clones]:
    """What solves a head's uncorrected keys again, on a thread: all Blender data is read here, before it runs."""
    head, origins, corrected = lesson
    correctives, extra = _correctives(origins, donor.names)
    wanted = {**origins, **{name: Origin((name,)) for name in extra}}
    known = list(dict.fromkeys(old for origin in wanted.values() for old in origin.names))
    donated = donor.shapes(known, head.groups)
    problem = Problem(donor.face, head.face, make_caster=available_caster())

    def solve(progress: Progress) -> Clones:
        moves = np.stack([np.sum([donated[old] for old in origin.names], axis=0) for origin in wanted.values()])
        if any(origin.side != "WHOLE" for origin in wanted.values()):
            left = left_share(donor.face.mesh, donor.face.points, feather)
            shares = {"WHOLE": np.ones_like(left), "LEFT": left, "RIGHT": 1 - left}
            moves *= np.stack([shares[origin.side] for origin in wanted.values()])[..., None]
        shapes = ShapeSet(tuple(wanted), moves)
        solved = resolve_shapes(method, problem, settings, shapes, corrected, correctives, progress)
        solved = solved.only([name for name in origins if name not in corrected.names])
        return Clones(head, solved.shapes, origins, row_of(solved), solved.spots, solved.report)

    return solve


def _correctives(origins: Mapping[str, Origin], names: Sequence[str]) -> tuple[list[Corrective], list[str]]:
    """The correctives among a head's cloned keys, with its own keys for what they need; and needs that it lacks."""
    own: dict[str, str] = {}
    for name, origin in origins.items():
        if origin.side == "WHOLE" and len(origin.names) == 1:
            own.setdefault(origin.names[0], name)
    found = [one for one in find_correctives(names) if one.name in own]
    extra = {need for one in found for need in one.needs if need not in own and need in names}
    return [Corrective(own[one.name], tuple(own.get(need, need) for need in one.needs)) for one in found], sorted(extra)
