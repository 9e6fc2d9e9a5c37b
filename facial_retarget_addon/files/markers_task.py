"""The beginning of a marker map: what names say and places suggest. For the command line and scripts."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from ..core.errors import RetargetError
from ..core.markers.assignment import MarkerMap, NamedMarkers, by_name, by_position
from .meshes import read_mesh
from .motion.marker_map import write_marker_map
from .motion.markers import read_markers
from .mpeg4_face import FapFaceFiles
from .points import read_points
from .whole import overwritten


class BegunMap(NamedTuple):
    """What was found: by name, and of the other markers by place; and the map that was written."""

    named: NamedMarkers
    placed: dict[str, str]
    marker_map: MarkerMap


def run_markers_task(take: Path, out: Path, face: FapFaceFiles | None = None) -> BegunMap:
    """Write a marker map of a take, for the artist to check and complete.

    Parameters
    ----------
    take : markers (.trc .c3d .bvh .csv); in its first frame the actor is neutral.
    out : the map (.json).
    face : a face whose points are laid over the markers, so that places suggest what names do not say.

    Raises
    ------
    RetargetError : for files that cannot be used, an output that would replace an input, or too few markers that say by
        their names where they sit for the places to be compared.
    """
    inputs = {"take": take, **(face.inputs() if face is not None else {})}
    if wrong := overwritten(inputs, {"out": out}):
        raise RetargetError("; ".join(wrong))
    markers = read_markers(take)
    if face is None:
        named, placed = by_name(markers.names), {}
    else:
        mesh = read_mesh(face.neutral).mesh
        points = read_points(face.points, mesh)
        named = by_name(markers.names, points.names)
        neutral, places = markers.positions[0], points.positions(mesh.vertices)
        placed = by_position(markers.names, neutral, named.points, points.names, places)
    marker_map = MarkerMap({**named.points, **placed})
    write_marker_map(marker_map, out)
    return BegunMap(named, placed, marker_map)
