"""A point in the artist's hand: taken at the press of the mouse, slid, put down or put back."""

from __future__ import annotations

from time import perf_counter
from typing import Any

import numpy as np
from bpy.types import Context, Event, Object

from ..bridge.points.point_memory import put_back_points, remember_points
from ..bridge.points.point_moves import put_point
from ..bridge.points.point_preparation import prepare_predictions, update_when_prepared
from ..bridge.points.shown_surface import ShownSurface, view_of
from ..bridge.scene.redraw import redraw_views
from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from ..core.mpeg4.regions import OWN_PARTS
from ..core.point_sets import POINT_INFOS
from ..core.sliding import Place, Slide
from .hover import point_under
from .state import needed_face

TREMBLE = 3.0
"""How far the mouse goes, in pixels, before a click becomes a drag."""

QUICK = 0.03
"""Seconds within which the partner is found if it follows on the way; a slower one comes when the mouse lets go."""


NOW_ACTIVE = "{} is the active face now: the next click places a point on it"
"""What a click says that only chooses a face, so that none places a point by mistake."""


class Pointed:
    """A face as a view shows it, and what the mouse points at.

    Attributes
    ----------
    thing : the face of the point under the mouse, or else the active one; it becomes the active object.
    name : the point under the mouse, placed or proposed; "" for none.
    mouse : (2,) in pixels.
    on_skin : whether lashes and shells close before the skin are looked through.
    """

    on_skin = False

    def __init__(self, context: Context, event: Event) -> None:
        """Look.

        Raises
        ------
        RetargetError : if no face is active, or it is not seen in this view, or its surface cannot be read.
        """
        if context.region_data is None:
            raise RetargetError("the mouse is not over a 3D view: choose the Feature Points tool and click on the face")
        self.mouse = mouse_of(event)
        thing, self.name = point_under(context, self.mouse)
        self.thing = thing or needed_face(context)
        context.view_layer.objects.active = self.thing
        if not self.thing.visible_get(viewport=context.space_data):
            raise RetargetError(_shown_instead(context, self.thing))
        self.view = view_of(context.region, context.region_data)
        self._surface = ShownSurface(self.thing, context.evaluated_depsgraph_get())

    @property
    def graph(self) -> Any:
        """(V, V) lengths of the edges, as they are shown."""
        return self._surface.mesh.graph

    def seen(self, pixel: FloatArray) -> Place | None:
        """What of the face is seen at a pixel (2,)."""
        return self._surface.under(self.view, pixel, self.on_skin)

    def place(self) -> Place | None:
        """The place of the point under the mouse, or else what is seen of the face there."""
        face = self.thing.facial_retarget
        stored = face.points.get(self.name) or face.proposals.get(self.name)
        return self._surface.place(stored.vertices[:], stored.weights[:]) if stored else self.seen(self.mouse)


class PointDrag:
    """One point on its way; `changed` says whether it is new or has moved."""

    def __init__(self, context: Context, event: Event) -> None:
        """Take the point under the mouse, or place the one whose turn it is.

        Raises
        ------
        RetargetError : as `Pointed`; or if there is no point to place, or no face under the mouse.
        """
        self._at = Pointed(context, event)
        self._thing = self._at.thing
        self._slide: Slide | None = None
        self._mirror_time = 0.0
        self._name = self._at.name or self._thing.facial_retarget.turn
        self._at.on_skin = self._name in POINT_INFOS and self._name not in OWN_PARTS
        place = self._at.place()
        if place is None:
            raise RetargetError(_beside(context, self._at))
        if not self._name:
            raise RetargetError("All points of the set are placed or skipped: drag them, or choose a larger set")
        self._place = place
        self.changed = self._name not in self._thing.facial_retarget.points
        self._grip = self._at.view.pixels(place.position[None])[0] - self._at.mouse
        prepare_predictions(self._thing)
        self._memory = remember_points(self._thing)
        self._mirrored = context.scene.facial_retarget.mirror_points
        self._put(self._mirrored)

    def move(self, event: Event) -> None:
        """Slide to the mouse, once it has gone farther than a hand trembles."""
        mouse = mouse_of(event)
        if self._slide is None:
            if np.linalg.norm(mouse - self._at.mouse) < TREMBLE:
                return
            self._slide = Slide(self._at.view, self._at.seen, self._at.graph, self._place)
        self._place = self._slide.to(mouse + self._grip)
        self.changed = True
        self._put(self._mirrored and self._mirror_time < QUICK)

    def put_down(self) -> tuple[str, FloatArray]:
        """Leave the point where it is; returns its name and its position (3,) in world space."""
        if self.changed:
            self._put(self._mirrored)
            update_when_prepared(self._thing)
        return self._name, self._place.position

    def put_back(self) -> None:
        """Everything is as before the press."""
        put_back_points(self._thing, self._memory)
        redraw_views()

    def _put(self, mirrored: bool) -> None:
        redraw_views()
        if self.changed:
            before = perf_counter()
            put_point(self._thing, self._name, self._place, mirrored)
            if mirrored:
                self._mirror_time = perf_counter() - before
        else:
            face = self._thing.facial_retarget
            face.active_point = face.points.find(self._name)


def _shown_instead(context: Context, thing: Object) -> str:
    """What a click means in a view without the active face: the other one of source and target, if that is there."""
    task = context.scene.facial_retarget
    for other in (task.source, task.target):
        if other not in (None, thing) and other.visible_get(viewport=context.space_data):
            context.view_layer.objects.active = other
            return NOW_ACTIVE.format(other.name)
    return f"{thing.name} is not shown in this view: unhide it, or leave local view"


def _beside(context: Context, at: Pointed) -> str:
    """What a click beside the active face means: the other one of source and target, which becomes the active one."""
    task = context.scene.facial_retarget
    for other in (task.source, task.target):
        if other not in (None, at.thing) and other.visible_get(viewport=context.space_data):
            surface = ShownSurface(other, context.evaluated_depsgraph_get())
            if surface.under(at.view, at.mouse) is not None:
                context.view_layer.objects.active = other
                return NOW_ACTIVE.format(other.name)
    return f"{at.thing.name} is not under the mouse"


def placed_point(context: Context, event: Event) -> str:
    """The name of the placed point under the mouse, whose face becomes the active object; RetargetError without one."""
    thing, name = point_under(context, mouse_of(event))
    if thing is None or name not in thing.facial_retarget.points:
        raise RetargetError("no placed point is under the mouse")
    context.view_layer.objects.active = thing
    return name


def proposed_point(context: Context, event: Event) -> str:
    """The name of the proposed point under the mouse, or of that whose turn it is; its face becomes the active object.

    Raises
    ------
    RetargetError : if neither is there.
    """
    thing, name = point_under(context, mouse_of(event), clicked=False)
    if thing is not None and name in thing.facial_retarget.proposals:
        context.view_layer.objects.active = thing
        return name
    face = needed_face(context).facial_retarget
    if face.turn not in face.proposals:
        raise RetargetError("no proposed point is under the mouse, and the one whose turn it is is not proposed")
    return str(face.turn)


def mouse_of(event: Event) -> FloatArray:
    """(2,) where the mouse is, in pixels from the region's lower left corner."""
    return np.array([event.mouse_region_x, event.mouse_region_y], np.float64)
