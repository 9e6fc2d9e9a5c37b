"""The faces of which something is drawn in a view, and the marks of their points."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from bpy.types import Context, Object
from gpu.types import GPUBatch

from ..core.arrays import BoolArray, FloatArray
from ..core.doubts import doubts
from ..core.errors import RetargetError
from .base import folded_names
from .changes import look, stored_points
from .marks import DOUBTFUL, NEXT, PLACED, PROPOSED, SELECTED, mark_batch
from .projection import pixels_across, toward_viewer
from .state import tool_is_active

MODES = ("OBJECT", "EDIT_MESH", "POSE", "PAINT_WEIGHT")
"""Where points are drawn: a sculptor sees the surface, and a mesh in Edit Mode has no evaluated one."""
SHARE, SMALLEST, LARGEST = 0.014, 2.2, 4.5
"""Radius of a mark as a share of the face's height in pixels, and its limits in pixels at a UI scale of 1."""
FOLDED = "a triangle of the base mesh folds over here"


@dataclass(frozen=True, eq=False)
class FaceMarks:
    """The marks of one face.

    Attributes
    ----------
    state : of what they were made.
    names : (P,) of the points, the placed ones first.
    placed : how many are placed.
    shapes : (P,) of their marks.
    places, normals : (P, 3) in the world; a normal is 0 where it is not known.
    doubts : name of a point -> what is wrong with it.
    trouble : why there are no marks; "" where all is well.
    """

    state: tuple[Any, ...]
    names: tuple[str, ...]
    placed: int
    shapes: tuple[int, ...]
    places: FloatArray
    normals: FloatArray
    batch: GPUBatch | None
    doubts: Mapping[str, str]
    trouble: str

    def facing(self, context: Context) -> BoolArray:
        """(P,) whether the surface looks at the viewer there."""
        dots = np.einsum("pc,pc->p", self.normals, toward_viewer(context.region_data, self.places))
        return dots >= 0

    def mark_size(self, context: Context, height: float) -> float:
        """Radius of the marks in pixels, on a face of this height in the world."""
        across = pixels_across(context, self.places.mean(axis=0), height)
        scale = context.preferences.system.ui_scale
        return min(max(SHARE * across, SMALLEST * scale), LARGEST * scale)


_made: dict[int, FaceMarks] = {}


def forget() -> None:
    """Drop all marks: another file is open."""
    _made.clear()


def shown_faces(context: Context) -> Iterator[Object]:
    """Source, target and the active object, as far as they are faces and visible in the context's view."""
    if context.mode not in MODES:
        return
    task = context.scene.facial_retarget
    for thing in dict.fromkeys((task.source, task.target, context.active_object)):
        if thing is None or thing.type != "MESH" or thing.data.is_editmode:
            continue
        face = thing.facial_retarget
        if (len(face.points) or len(face.proposals)) and thing.visible_get(viewport=context.space_data):
            yield thing


def face_marks(context: Context, thing: Object) -> FaceMarks:
    """The marks of a face, made anew only where something has changed."""
    face = thing.facial_retarget
    active = face.active_point if thing == context.active_object else -1
    noted = tuple(point.doubt for point in face.points)
    stored = stored_points(face.points), stored_points(face.proposals), noted
    turn = face.turn if thing == context.active_object and tool_is_active(context) else ""
    state = (look(thing), active, turn, folded_names(thing), *stored)
    made = _made.get(thing.session_uid)
    if made is None or made.state != state:
        made = _made[thing.session_uid] = _make(thing, context.view_layer.depsgraph, active, turn, state)
    return made


def _make(thing: Object, depsgraph: Any, active: int, turn: str, state: tuple[Any, ...]) -> FaceMarks:
    from ..bridge.points.point_places import world_normals, world_places  # loads SciPy, which enabling does not

    try:
        placed, at = world_places(thing, depsgraph)
        proposed, there = world_places(thing, depsgraph, "proposals")
    except RetargetError as error:
        none = np.empty((0, 3))
        return FaceMarks(state, (), 0, (), none, none, None, {}, str(error))
    noted = {point.name: point.doubt for point in thing.facial_retarget.points if point.doubt}
    doubtful = noted | dict.fromkeys(folded_names(thing), FOLDED) | doubts(placed, at)
    shapes = [DOUBTFUL if name in doubtful else PLACED for name in placed]
    shapes += [NEXT if name == turn else PROPOSED for name in proposed]
    if 0 <= active < len(placed):
        shapes[active] = SELECTED
    places = np.concatenate([at, there])
    normals = np.concatenate([world_normals(thing, depsgraph, which) for which in ("points", "proposals")])
    batch = mark_batch(places, shapes) if len(places) else None
    return FaceMarks(state, placed + proposed, len(placed), tuple(shapes), places, normals, batch, doubtful, "")
