"""Cloned shapes of one head: named, written with all that belongs to them, and remembered."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256
from typing import Any, NamedTuple

from bpy.types import Object

from ...core.quality import Spots
from ...core.shapes.shape_set import ShapeSet
from ..heads import Head
from ..key_sets import KeyTraits
from ..reports.findings import Finding, write_key_findings
from ..shape_keys import find_key, key_displacement
from .clone_report import figures_note, worst_first
from .clone_wishes import Origin
from .donors import Donor
from .head_shapes import Plan, put_shapes
from .key_animation import copy_animation
from .key_drivers import copy_drivers


class Copying(NamedTuple):
    """What is copied with the keys."""

    drivers: bool
    animation: bool


@dataclass(frozen=True, eq=False)
class Clones:
    """Shapes for a head, before they are written.

    origins : name of a shape -> where it comes from.
    rows, spots : name of a shape -> its figures, and where it is in trouble.
    report : of all, as `core.shapes.clone` gives it.
    """

    head: Head
    shapes: ShapeSet
    origins: Mapping[str, Origin]
    rows: Mapping[str, Mapping[str, Any]]
    spots: Mapping[str, Spots]
    report: dict[str, Any]

    @property
    def warnings(self) -> list[str]:
        """What the report says, and the objects that no method can move because nothing tells what they are."""
        still = [
            f"object {thing.name!r} of head {self.head.name!r} stays still; give it a role if it shall move"
            for thing, own, _ in self.head.slices()
            if thing in self.head.untold and self._is_still(own)
        ]
        return [*self.report["warnings"], *still]

    def _is_still(self, own: slice) -> bool:
        """Whether some vertices belong to parts that never move."""
        found = [row for row in self.report["still_components"] if own.start <= row["first_vertex"] < own.stop]
        return sum(row["vertices"] for row in found) == own.stop - own.start


def write_clones(clones: Clones, plan: Plan, donor: Donor, copying: Copying) -> list[str]:
    """Write shapes as `write_shapes`, with the traits, drivers and animation of the keys that they come from.

    Returns
    -------
    What could not be copied, a clause each.
    """
    origin = {name: clones.origins[shape].names[0] for name, shape in plan.items()}
    there = {old: new for new, old in reversed(origin.items())}
    traits = {name: _renamed(donor.traits(old), there) for name, old in origin.items()}
    unable: list[str] = []
    for thing, names in write_shapes(clones, plan, traits).items():
        own = {name: origin[name] for name in names}
        unable += _copy_motion(thing, own, donor, clones.head.things[0], copying)
    return unable


def write_shapes(clones: Clones, plan: Plan, traits: Mapping[str, KeyTraits]) -> dict[Object, list[str]]:
    """Put shapes on their head as `put_shapes`, and list them."""
    written = put_shapes(clones.head, clones.shapes, plan, traits)
    _remember(clones, plan)
    found = {name: Finding(clones.rows[shape], clones.spots[shape]) for name, shape in plan.items()}
    write_key_findings(clones.head.things[0], found)
    return written


def _renamed(traits: KeyTraits, there: Mapping[str, str]) -> KeyTraits:
    return traits._replace(relative=there.get(traits.relative, traits.relative))


def _copy_motion(thing: Object, origin: Mapping[str, str], donor: Donor, face: Object, copying: Copying) -> list[str]:
    """Copy drivers and animation of the donor's keys that an object's keys come from; returns what could not be."""
    unable: list[str] = []
    owners = {name: donor.owner(old) for name, old in origin.items()}
    for owner in dict.fromkeys(owner for owner in owners.values() if owner is not None):
        own = {name: old for name, old in origin.items() if owners[name] == owner}
        if copying.drivers:
            copy_drivers(owner, thing, own, donor.things, face)
        if copying.animation:
            unable += copy_animation(owner, thing, own, face)
    return unable


def _remember(clones: Clones, plan: Plan) -> None:
    """List the written keys on the face object, the worst ones first, before those of earlier clones."""
    face = clones.head.things[0]
    cloned = face.facial_retarget.cloned
    for row in reversed(range(len(cloned))):
        if cloned[row].name in plan or find_key(face, cloned[row].name) is None:
            cloned.remove(row)
    for place, name in enumerate(worst_first({name: clones.rows[shape] for name, shape in plan.items()})):
        origin = clones.origins[plan[name]]
        entry = cloned.add()
        entry.name, entry.side, entry.note = name, origin.side, figures_note(clones.rows[plan[name]])
        for old in origin.names:
            entry.origins.add().name = old
        entry.shape = fingerprint(clones.head, name)
        cloned.move(len(cloned) - 1, place)
    face.facial_retarget.active_cloned = 0


def fingerprint(head: Head, name: str) -> str:
    """Tells whether a shape key of a head has been changed: it stays while what the key moves stays."""
    found = sha256()
    for thing in head.things:
        key = find_key(thing, name)
        if key is not None:
            found.update(key_displacement(key).tobytes())
    return found.hexdigest()
