"""Which vertex is the mirror image of which, on meshes whose polygons mirror themselves, whatever their shape."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..arrays import FloatArray, IntArray

_SEEDS = 48
"""Half-edges of a component from which a walk may start."""
_CHOICES = 6
"""Nearest mirror images that each of them may have."""
_TRIES = 60
"""Walks, at most; nearly all that fail do so within a few steps."""


class PolygonWalk:
    """The half-edges of polygons: half-edge c goes from corner c to the next corner of the same polygon.

    Attributes
    ----------
    start, end : (C,) vertices.
    after, before : (C,) the next half-edge of the same polygon, and the one before.
    twin : (C,) the same edge in the other polygon; -1 at a border, and where more than two polygons meet.
    """

    def __init__(self, counts: IntArray, corners: IntArray) -> None:
        last = np.cumsum(counts)
        own = np.arange(len(corners))
        self.after = own + 1
        self.after[last - 1] = last - counts
        self.before = own - 1
        self.before[last - counts] = last - 1
        self.start, self.end = corners, corners[self.after]
        self.degree = np.repeat(counts, counts)
        self.twin = self._twins(int(corners.max(initial=-1)) + 1)

    def _twins(self, vertex_count: int) -> IntArray:
        key = self.start * vertex_count + self.end
        order = np.argsort(key, kind="stable")
        ordered = key[order]
        back = self.end * vertex_count + self.start
        first = np.searchsorted(ordered, back)
        alone = (np.searchsorted(ordered, back, "right") - first == 1) & (
            np.searchsorted(ordered, key, "right") - np.searchsorted(ordered, key) == 1
        )
        twin = np.full(len(key), -1, np.int64)
        twin[alone] = order[first[alone]]
        return twin

    def mirrored_from(self, half: int, image: int) -> IntArray:
        """(C,) the mirror image of every half-edge that can be walked to from one whose image is given; -1 elsewhere.

        The image of a half-edge goes from the image of its end to that of its start, for mirroring turns polygons
        around. All -1 if the two surroundings differ anywhere, or two half-edges would have one image.
        """
        images = np.full(len(self.start), -1, np.int64)
        none = images.copy()
        images[half] = image
        front = np.array([half])
        while len(front):
            there = images[front]
            if (self.degree[front] != self.degree[there]).any():
                return none
            over, over_there = self.twin[front], self.twin[there]
            if ((over < 0) != (over_there < 0)).any():
                return none
            inside = over >= 0
            reached = np.concatenate([self.after[front], over[inside]])
            wanted = np.concatenate([self.before[there], over_there[inside]])
            new = images[reached] < 0
            images[reached[new]] = wanted[new]
            if (images[reached] != wanted).any():
                return none
            front = np.unique(reached[new])
        walked = images[images >= 0]
        return images if len(np.unique(walked)) == len(walked) else none


def mirror_twins(
    walk: PolygonWalk, components: IntArray, vertices: FloatArray, reflected: FloatArray, reach: float
) -> IntArray:
    """(V,) the vertex that is each vertex's mirror image, -1 on components whose polygons do not mirror themselves.

    A component is walked together with its mirror image, which may be another one, as the other eye is. The walk
    starts where places and reflected places are nearest; the shape may be as asymmetric as it likes elsewhere.

    Parameters
    ----------
    components : (V,) label of each vertex's connected component.
    vertices, reflected : (V, 3) places, and the same reflected in the plane of the middle.
    reach : mean distance from the images' places to the reflected ones above which a walk is not believed.
    """
    images = np.full(len(vertices), -1, np.int64)
    ends = cKDTree(np.hstack([vertices[walk.start], vertices[walk.end]]))
    label = components[walk.start]
    for component in np.unique(label):
        own = np.flatnonzero(label == component)
        if (images[walk.start[own]] >= 0).any():
            continue
        for half, image in _seeds(walk, own, ends, reflected):
            found = walk.mirrored_from(half, image)
            if found[own].min() < 0:
                continue
            to = np.full(len(vertices), -1, np.int64)
            to[walk.start[own]] = walk.end[found[own]]
            moved = walk.start[own]
            if (components[to[moved]] == component).all() and (to[to[moved]] != moved).any():
                continue  # it turns the component as well, as a ball can be turned
            if np.linalg.norm(vertices[to[moved]] - reflected[moved], axis=1).mean() > reach:
                continue
            images[moved] = to[moved]
            images[to[moved]] = moved
            break
    return images


def _seeds(walk: PolygonWalk, own: IntArray, ends: cKDTree, reflected: FloatArray) -> list[tuple[int, int]]:
    """Half-edges of a component and possible images of them, the nearest ones first."""
    some = own[np.linspace(0, len(own) - 1, min(_SEEDS, len(own))).astype(np.int64)]
    turned = np.hstack([reflected[walk.end[some]], reflected[walk.start[some]]])
    distance, image = ends.query(turned, k=min(_CHOICES, ends.n))
    distance, image = distance.reshape(len(some), -1), image.reshape(len(some), -1)
    half = np.repeat(some, image.shape[1])
    order = np.argsort(distance.ravel(), kind="stable")[:_TRIES]
    return [(int(half[k]), int(image.ravel()[k])) for k in order]
