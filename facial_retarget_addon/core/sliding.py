"""A place that slides along a surface under the mouse: never through it, and onto no other sheet of it.

A ray through the mouse alone jumps: from a nostril's wing to the cheek behind it, from the upper lip to the throat,
from one closed lip to the other. Here the way of the mouse is gone in short steps. A step is a slide if the surface is
seen without a gap between its ends and leads from one to the other. Where it is not, the place stays on its sheet, as
near to the mouse as it can, until the mouse has gone at least half as far as the way along the surface: then the
artist means the other sheet.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import dijkstra

from .arrays import FloatArray, IntArray
from .view_rays import View

STEP = 6.0
"""Longest step of the mouse, in pixels."""

STEEP = 4.0
"""Surface that goes this many times as far as the pixels do may be a gap: it is looked at more closely."""

SHALLOW = 1.0
"""A gap that is less deep than this many pixels is none."""

CLOSEST = 1.0 / 64.0
"""Pixels between which what is steep is a gap."""

DETOUR = 2.0
"""How many times as far as the straight line a way along the surface may be."""

FINEST = 0.25
"""How near, in pixels, a place that cannot follow the mouse comes to where it could be."""

_ANGLE = np.arange(32) * (np.pi / 16.0)
_COMPASS = np.stack([np.cos(_ANGLE), np.sin(_ANGLE)], axis=1)


class Place(NamedTuple):
    """A place on a surface: vertices (3,) that hold it, weights (3,), position (3,) as it is shown, in world space."""

    vertices: IntArray
    weights: FloatArray
    position: FloatArray


Hit = Callable[[FloatArray], Place | None]
"""What is seen of the surface at a pixel (2,)."""


class Slide:
    """A place on its way."""

    def __init__(self, view: View, hit: Hit, graph: sp.csr_matrix, place: Place) -> None:
        """Begin to slide.

        Parameters
        ----------
        view : in which the mouse moves.
        hit : what is seen of the surface at a pixel.
        graph : (V, V) lengths of the surface's edges as it is shown, in world space.
        place : where the slide begins.
        """
        self._view, self._hit, self._graph = view, hit, graph
        self.place = place
        self._at: FloatArray = view.pixels(place.position[None])[0]

    def to(self, goal: FloatArray) -> Place:
        """Slide towards a pixel (2,); returns the place that was reached."""
        way = goal - self._at
        start, count = self._at, max(int(np.ceil(np.linalg.norm(way) / STEP)), 1)
        for step in range(1, count + 1):
            at = start + way * (step / count)
            found = self._hit(at)
            if found is None or not self._leads(found, at):
                self._stay_near(goal)
                break
            self.place, self._at = found, at
        return self.place

    def _leads(self, found: Place, at: FloatArray) -> bool:
        """Whether the surface goes from the place to another, without a gap that could be seen."""
        if not self._seen_whole(self._at, self.place, at, found):
            return False
        corners = np.concatenate([self.place.vertices, found.vertices])
        edge = self._graph[corners].max()
        chord = float(np.linalg.norm(found.position - self.place.position))
        return bool(self._distances(DETOUR * chord + edge)[found.vertices].min() < np.inf)

    def _seen_whole(self, a: FloatArray, at_a: Place, b: FloatArray, at_b: Place) -> bool:
        """Whether no gap is seen between two pixels (2,) and the places there."""
        while True:
            apart = float(np.linalg.norm(b - a))
            chord = float(np.linalg.norm(at_b.position - at_a.position))
            if chord <= max(STEEP * apart, SHALLOW) * self._view.pixel_length(at_a.position):
                return True
            if apart < CLOSEST:
                return False
            middle = 0.5 * (a + b)
            between = self._hit(middle)
            if between is None:
                return False
            # The steeper half has the gap, if there is one.
            first = np.linalg.norm(between.position - at_a.position)
            if first > np.linalg.norm(at_b.position - between.position):
                b, at_b = middle, between
            else:
                a, at_a = middle, between

    def _stay_near(self, goal: FloatArray) -> None:
        """Go to another sheet where the mouse has gone far enough, else as near to the mouse as the sheet is seen."""
        length = self._view.pixel_length(self.place.position)
        start, far = self._at, float(np.linalg.norm(goal - self._at))
        edge = float(self._graph[self.place.vertices].max())
        distances = self._distances(DETOUR * far * length + edge)

        def reached(at: FloatArray) -> Place | None:
            found = self._hit(at)
            allowed = DETOUR * float(np.linalg.norm(at - start)) * length + edge
            return found if found is not None and distances[found.vertices].min() <= allowed else None

        found = reached(goal)
        if found is not None:
            self.place, self._at = found, goal
            return
        step = 0.5 * far
        while step >= FINEST:
            around = self._at + step * _COMPASS
            gap = np.linalg.norm(around - goal, axis=1)
            nearer = np.flatnonzero(gap < np.linalg.norm(self._at - goal) - 1e-9)
            for at in around[nearer[gap[nearer].argsort()]]:
                found = reached(at)
                if found is not None:
                    self.place, self._at = found, at
                    break
            else:
                step *= 0.5

    def _distances(self, limit: float) -> FloatArray:
        """(V,) along edges from the place's corners; inf beyond the limit."""
        distances: FloatArray = dijkstra(self._graph, indices=self.place.vertices, limit=limit, min_only=True)
        return distances
