"""Feature points of one object on others: exactly where these have the same topology, through the fit where not."""

from __future__ import annotations

from typing import NamedTuple

from bpy.types import Object

from ...core.arrays import Progress
from ...core.errors import RetargetError
from ...core.matching.correspondence import predict_points
from ...core.mpeg4.regions import OWN_PARTS
from ...core.points import FeaturePoints, common_names
from ..background import Steps, in_thread, part
from ..meshes import neutral_mesh
from .point_prediction import update_predictions
from .points import place_points, read_points
from .topology import topology_of

LEAST = 5
"""Points that a face of another topology must have, so that the other face can be fitted onto it."""


class Copied(NamedTuple):
    """Points for one object, and whether they are exact: the topology is the same."""

    thing: Object
    points: FeaturePoints
    exact: bool


def copy_steps(source: Object, targets: list[Object]) -> Steps[list[Copied]]:
    """Copy the feature points of an object to others; nothing is placed before all are found.

    On the same topology (vertices, polygons, and which polygon has which vertex) all points are the source's, with the
    same vertices and weights. Elsewhere the source's surface is fitted onto the target's by the points that both have,
    and the others are placed where they come to lie; points that the target has stay.

    Raises
    ------
    RetargetError : if the source has no points, there is no target, or a target of another topology has too few points
        in common with the source.
    """
    points = read_points(source)
    if not len(points):
        raise RetargetError(f"object {source.name!r} has no feature points to copy")
    if not targets:
        raise RetargetError(
            f"no other mesh object is selected, expected one that shall get the points of {source.name!r}"
        )
    found = []
    for i, thing in enumerate(targets):
        if topology_of(thing.data) == topology_of(source.data):
            found.append(Copied(thing, points, True))
        else:
            steps = part(_fitted(source, points, thing), i / len(targets), 1 / len(targets))
            found.append(Copied(thing, (yield from steps), False))
    for copied in found:
        place_points(copied.thing, copied.points)
        update_predictions(copied.thing)
    return found


def _fitted(source: Object, points: FeaturePoints, thing: Object) -> Steps[FeaturePoints]:
    """The points that a target of another topology lacks."""
    on_skin = points.subset([name for name in points.names if name not in OWN_PARTS])
    own = read_points(thing)
    common = common_names(own, on_skin)
    if len(common) < LEAST:
        raise RetargetError(
            f"object {thing.name!r} has another topology than {source.name!r}, and {len(common)} feature points in "
            f"common with it, expected at least {LEAST}: place them, or guess and accept them, then copy the others"
        )
    meshes = neutral_mesh(source), neutral_mesh(thing)

    def fit(progress: Progress) -> FeaturePoints:
        progress(0.0, f"fitting {source.name} onto {thing.name}")
        complete = predict_points(meshes[0], on_skin, meshes[1], own.subset(common))
        return complete.subset([name for name in complete.names if name not in own.names])

    return in_thread(fit)
