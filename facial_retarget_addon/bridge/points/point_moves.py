"""Points placed, moved and removed by hand, with their partners on the other half of the face."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from bpy.types import Depsgraph, Object

from ...core.errors import RetargetError
from ...core.point_sets import POINT_INFOS
from ...core.sliding import Place
from .point_prediction import accept_proposals, predictor_of, update_predictions
from .point_preparation import wait_until_prepared
from .points import place_point, place_points, read_points, remove_point, skip_point, want_point
from .shown_surface import ShownSurface


def partner(name: str) -> str:
    """The name of a point's partner on the other half; "" for one on the middle line or with a name of its own."""
    return POINT_INFOS[name].partner if name in POINT_INFOS else ""


def put_point(thing: Object, name: str, place: Place, mirrored: bool) -> None:
    """Place or move a point, and its partner if `mirrored`; the point becomes the active one.

    Raises
    ------
    RetargetError : as for `place_points`.
    """
    place_point(thing, name, place.vertices.tolist(), place.weights.tolist())
    if mirrored and partner(name):
        wait_until_prepared(thing)
        place_points(thing, predictor_of(thing).mirrored(read_points(thing), [name]))


def put_point_near(
    thing: Object, depsgraph: Depsgraph, name: str, position: Sequence[float], mirrored: bool = False
) -> str:
    """Place or move a point where the shown surface is closest to a position (3,) in world space; returns its name.

    Parameters
    ----------
    name : "" for the point whose turn it is.

    Raises
    ------
    RetargetError : if no point is left to place, or the surface cannot be read.
    """
    wanted = name or thing.facial_retarget.turn
    if not wanted:
        raise RetargetError(f"all points of the set are placed on object {thing.name!r} or skipped, expected a name")
    place = ShownSurface(thing, depsgraph).closest(np.array(position, np.float64))
    put_point(thing, wanted, place, mirrored)
    update_predictions(thing)
    return wanted


def drop_point(thing: Object, name: str, mirrored: bool) -> None:
    """Remove a point, and its partner if `mirrored`; RetargetError if there is none of this name."""
    remove_point(thing, name)
    if mirrored and partner(name) in thing.facial_retarget.points:
        remove_point(thing, partner(name))
    update_predictions(thing)


def skip_turn(thing: Object) -> None:
    """Skip the point whose turn it is; RetargetError if there is none."""
    name = thing.facial_retarget.turn
    if not name:
        raise RetargetError(f"all points of the set are placed on object {thing.name!r} or skipped already")
    skip_point(thing, name)
    update_predictions(thing)


def go_back(thing: Object) -> None:
    """Take the last skip back; RetargetError if there is none."""
    skipped = thing.facial_retarget.skipped
    if not len(skipped):
        raise RetargetError(f"no point of object {thing.name!r} is skipped, expected one to go back to")
    want_point(thing, skipped[-1].name)
    update_predictions(thing)


def accept_point(thing: Object, name: str) -> None:
    """Place a proposed point where it is proposed; RetargetError if it is not.

    Parameters
    ----------
    name : "" for the point whose turn it is.
    """
    face = thing.facial_retarget
    wanted = name or face.turn
    if wanted not in face.proposals:
        raise RetargetError(f"feature point {wanted!r} of object {thing.name!r} is not proposed")
    accept_proposals(thing, [wanted])
