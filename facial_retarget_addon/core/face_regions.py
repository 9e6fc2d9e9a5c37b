"""Regions of a face, soft at their borders: brows, eyes, nose, cheeks, mouth and jaw.

A weight depends on where a place lies in space and on nothing else, so that the two lips of a closed mouth have the
same, and no border can tear what touches. Both lids of an eye lie in the core of theirs, and both lips too: there the
weight is 1, whatever lies near.
"""

from __future__ import annotations

from dataclasses import fields

import numpy as np
from scipy.spatial import cKDTree

from .arrays import FloatArray
from .methods.settings import RegionGains
from .mpeg4.mean_face import place_missing
from .parts.kinds import BOTH, EYEBALL, LOWER, OTHER, TONGUE, UPPER
from .parts.known_head import KnownHead, know_head
from .problem import Face

REGIONS = tuple(field.name for field in fields(RegionGains))
"""Their names, in the order of the columns of `region_weights`."""

LINES: dict[str, tuple[tuple[str, ...], ...]] = {
    "brows": (("4.5", "4.3", "4.1", "4.2", "4.4", "4.6"), ("4.3", "11.3"), ("11.1",), ("4.4", "11.2")),
    "nose": (("9.12", "9.3", "9.15"), ("9.1", "9.3", "9.2")),
    "cheeks": (("5.1", "5.3"), ("5.2", "5.4")),
    "jaw": (("2.13", "2.1", "2.14"), ("2.10", "2.1")),
}
"""Region -> lines through FDPs along which it lies."""
OPENINGS: dict[str, tuple[tuple[str, ...], ...]] = {
    "eyes": (("3.7", "3.1", "3.11", "3.3"), ("3.8", "3.2", "3.12", "3.4")),
    "mouth": (("8.3", "8.5", "8.10", "8.1", "8.9", "8.6", "8.4", "8.8", "8.2", "8.7"),),
}
"""Region -> the FDPs around what opens in it."""

# In eye separations.
CORES = {"eyes": (0.10, 0.22), "mouth": (0.12, 0.26)}
"""Up to the first distance from its opening a region has all the weight, from the second on it shares it."""
BORDER = 0.22
"""Distances by which one region is nearer than another, over which the weight goes from one to the other."""
REACH = (0.6, 1.4)
"""Up to the first distance from all regions they have the whole weight, from the second on none."""
SAMPLES = 6
"""Places along a line from point to point, and from the middle of an opening to its border."""

WITH_JAW = (LOWER, TONGUE, BOTH)
"""Kinds of parts that are moved as the jaw is."""
APART = (EYEBALL, UPPER, OTHER)
"""Kinds of parts that belong to no region: they turn with the eyes or sit on the skull."""


def region_weights(face: Face) -> FloatArray:
    """(V, 6) weights of `REGIONS` at the vertices of a neutral face, at most 1 together.

    Parts that are as stiff as bone have one weight all over.

    Raises
    ------
    RetargetError : if the face has too few points with MPEG-4 names to tell where its regions lie.
    """
    head = know_head(face)
    distances = _distances(head) / head.unit
    nearer = np.exp(-((distances / BORDER) ** 2) + (distances.min(axis=1, keepdims=True) / BORDER) ** 2)
    weights = nearer / nearer.sum(axis=1, keepdims=True)
    for region, (inside, outside) in CORES.items():
        column = REGIONS.index(region)
        core = 1 - _step((distances[:, column] - inside) / (outside - inside))
        weights *= 1 - core[:, None]
        weights[:, column] += core
    weights *= 1 - _step((distances.min(axis=1) - REACH[0]) / (REACH[1] - REACH[0]))[:, None]
    weights[head.vertices(WITH_JAW)] = np.eye(len(REGIONS))[REGIONS.index("jaw")]
    weights[head.vertices(APART)] = 0.0
    return weights


def _distances(head: KnownHead) -> FloatArray:
    """(V, 6) from each vertex to the regions, in the face's units."""
    wanted = {name for shapes in (LINES, OPENINGS) for lines in shapes.values() for line in lines for name in line}
    names = head.points.names
    where = place_missing(names, head.points.positions(head.mesh.vertices), sorted(wanted))
    found = np.empty((len(head.mesh.vertices), len(REGIONS)))
    for column, region in enumerate(REGIONS):
        lines = [np.array([where[name] for name in line]) for line in LINES.get(region, ())]
        openings = [np.array([where[name] for name in ring]) for ring in OPENINGS.get(region, ())]
        places = [*(_along(line) for line in lines), *(_across(ring) for ring in openings)]
        found[:, column] = cKDTree(np.concatenate(places)).query(head.mesh.vertices)[0]
    return found


def _along(line: FloatArray) -> FloatArray:
    """(N, 3) places along a line through points (P, 3)."""
    share = np.arange(SAMPLES)[:, None, None] / SAMPLES
    between = (1 - share) * line[:-1] + share * line[1:]
    return np.concatenate([between.reshape(-1, 3), line[-1:]])


def _across(ring: FloatArray) -> FloatArray:
    """(N, 3) places on the surface that is spanned by a closed line through points (P, 3) and their middle."""
    border, middle = _along(np.concatenate([ring, ring[:1]])), ring.mean(axis=0)
    share = np.arange(SAMPLES + 1)[:, None, None] / SAMPLES
    return (middle + share * (border - middle)).reshape(-1, 3)


def _step(share: FloatArray) -> FloatArray:
    """From 0 up to share (n,) 0 to 1 from share 1 on, smoothly."""
    step = np.clip(share, 0.0, 1.0)
    smooth: FloatArray = step * step * (3 - 2 * step)
    return smooth
