"""Points placed, moved and removed by hand, with their partners on the other half of the face."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from bpy.types import Depsgraph, Object

from ..core.arrays import unit_vectors
from ..core.closest_point import SurfaceFinder, closest_agreeing
from ..core.errors import RetargetError
from ..core.point_sets import POINT_INFOS
from ..core.sliding import Place
from .meshes import neutral_mesh
from .point_prediction import update_predictions
from .points import place_point, remove_point, skip_point
from .shown_surface import ShownSurface


class PointMirror:
    """Takes places of an object's neutral to its other half: mirrored in X, then onto the surface that faces alike."""

    def __init__(self, thing: Object) -> None:
        """Read the object; RetargetError if it is no surface."""
        self._mesh = neutral_mesh(thing)
        self._finder = SurfaceFinder(self._mesh)

    def mirrored(self, place: Place) -> tuple[list[int], list[float]]:
        """Vertices (3,) and weights (3,) of the place on the other half."""
        across = np.array([-1.0, 1.0, 1.0])
        position = across * (place.weights @ self._mesh.vertices[place.vertices])
        normal = across * unit_vectors((place.weights @ self._mesh.vertex_normals[place.vertices])[None])
        found = closest_agreeing(self._finder, position[None], normal, 0.0)
        return self._mesh.faces[found.face[0]].tolist(), found.weights[0].tolist()


def partner(name: str) -> str:
    """The name of a point's partner on the other half; "" for one on the middle line or with a name of its own."""
    return POINT_INFOS[name].partner if name in POINT_INFOS else ""


def put_point(thing: Object, name: str, place: Place, mirror: PointMirror | None) -> None:
    """Place or move a point, and its partner if there is a mirror; the point becomes the active one."""
    if mirror is not None and partner(name):
        place_point(thing, partner(name), *mirror.mirrored(place))
    place_point(thing, name, place.vertices.tolist(), place.weights.tolist())


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
    put_point(thing, wanted, place, PointMirror(thing) if mirrored else None)
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
    skipped.remove(len(skipped) - 1)
    update_predictions(thing)
