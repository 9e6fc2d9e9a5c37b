"""Which part of a head each component without feature points is, by where it lies."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from ..acting.eyeballs import EYES, Eyeball
from ..arrays import BoolArray, FloatArray, IntArray
from ..base.regions import eye_separation
from ..mesh import TriMesh
from ..mpeg4.mean_face import place_missing
from ..mpeg4.regions import OWN_PARTS
from ..points import FeaturePoints
from .kinds import (
    ACROSS,
    AROUND_EYE,
    BEARD,
    BOTH,
    BROW,
    EYEBALL,
    LOWER,
    MOUSTACHE,
    NAMED_KINDS,
    NO_NAMES,
    OTHER,
    TONGUE,
    UPPER,
    NamedParts,
    eyeball_name,
)

HAIRS = {BROW: ("4.1", "4.2", "4.3", "4.4", "4.5", "4.6"), MOUSTACHE: ("8.1", "9.15"), BEARD: ("2.1", "2.10", "8.2")}
"""Hair on the face -> FDPs that it grows around."""

NEEDED = frozenset(("2.1", "4.3", "4.4", "8.3", "8.4"))
"""FDPs without which nothing says where eyes and mouth are."""
IN_MOUTH = {
    **dict.fromkeys(("9.8", "9.10"), UPPER),
    **dict.fromkeys(("9.9", "9.11"), LOWER),
    **dict.fromkeys(("6.1", "6.2", "6.3", "6.4"), TONGUE),
}
"""FDP in the mouth -> what it lies on."""

# In eye separations.
MOUTH_WIDTH = 0.8
"""What lies in the mouth is at most this far from its middle sideways."""
MOUTH_DEPTH = 2.0
"""And at most this far behind the lips."""
BEFORE_LIPS = 0.05
"""And at most this far before the middle of their inner edges."""
BITE = 0.025
"""The middle of a lower tooth lies farther below the lips' line than this; upper teeth reach below that line too."""
SPANS = 0.25
"""What reaches farther than this both above and below the lips' line holds gums of both rows, or lies behind them."""
TONGUE_DEPTH = 0.3
"""A tongue reaches at least this far from its tip to its root."""
TONGUE_MIDDLE = 0.3
"""And its rear half is this near to its middle line somewhere, as a share of half its width: a row of teeth is not."""
HAIR_NEAR = 0.45
"""The middle of hair on the face is at most this far from a point that it grows around."""
HAIR_SIZE = 2.2
"""Its box has no longer side than this."""
HAIR_RISES = 0.25
"""And none of it is farther from the skin than this."""

# In widths of the eye.
EYE_REACH = 1.3
"""What belongs around an eye is nowhere farther from the lids' middle than this."""
EYE_TOUCH = 0.35
"""And comes at least this near to a lid's middle or a corner."""
EYE_BEHIND = 0.1
"""What is this far behind the lids, and above or below their opening, belongs into the socket."""
OPENING = 0.25
"""How far beyond the opening of the lids, as a share of it."""
SOCKET_SHARE = 0.2
"""A component of which more than this share belongs into the socket is none around an eye."""

NAMED = "named {}"
"""The reason of a part that the artist named."""
SPANNING = "behind the lips, far above and below their line"
"""The reason of a part across both halves; it is `ACROSS` where no teeth of both rows show where it parts."""


class Part(NamedTuple):
    """A component, or the components of one eyeball: what it is, its vertices (n,), and how it was known."""

    kind: str
    vertices: IntArray
    reason: str


def find_parts(
    mesh: TriMesh,
    points: FeaturePoints,
    axes: FloatArray,
    eyeballs: Mapping[str, Eyeball],
    named: NamedParts = NO_NAMES,
) -> tuple[Part, ...]:
    """Every component that holds no feature point of the skin, with what it is; in order of first vertices.

    Vertices without faces are one part, which is `OTHER`.

    Parameters
    ----------
    points : at least one on the skin. Without chin, brows and corners of the mouth every part is `OTHER`.
    axes : (3, 3) of the head.
    eyeballs : by side.
    named : parts that the artist named; they are what their names say.
    """
    order = np.argsort(mesh.components, kind="stable")
    starts = np.unique(mesh.components[order], return_index=True)[1]
    groups = np.split(order, starts[1:])
    skin = np.flatnonzero(np.isin(np.arange(len(groups)), mesh.components[_on_skin(points).vertices[:, 0]]))
    loose = np.setdiff1d(np.arange(len(mesh.vertices)), mesh.faces)
    labels = np.setdiff1d(np.arange(len(groups)), np.concatenate([skin, mesh.components[loose]])).tolist()
    called = {int(k): name for name, held in named.items() for k in np.unique(mesh.components[held])}
    labels = [k for k in labels if k not in called]
    parts = [Part(OTHER, loose[~np.isin(mesh.components[loose], list(called))], "vertices without faces")]
    parts += [Part(NAMED_KINDS[name], groups[k], NAMED.format(name)) for k, name in called.items()]
    if not set(points.names) >= NEEDED:
        reason = "the points do not show where eyes and mouth are"
        return _in_order(parts + [Part(OTHER, groups[k], reason) for k in labels])
    places = mesh.vertices @ axes.T
    corners = tuple(op.reduceat(places[order], starts, axis=0) for op in (np.minimum, np.maximum))
    head = _Head.measured(mesh, points, axes, skin)
    balls = {k: eye for eye in eyeballs.values() for k in np.unique(mesh.components[eye.vertices]).tolist()}
    parts += [
        Part(EYEBALL, eye.vertices, f"round, behind the {eye.side} lids")
        for eye in eyeballs.values()
        if eyeball_name(eye.side) not in named
    ]
    held = _held_in_mouth(mesh, points)
    for k in labels:
        if k not in balls:
            kind, reason = head.kind(places[groups[k]], corners[0][k], corners[1][k], held.get(k, set()))
            parts.append(Part(kind, groups[k], reason))
    if not {UPPER, LOWER} <= {part.kind for part in parts}:
        parts = [part._replace(kind=ACROSS) if part.reason == SPANNING else part for part in parts]
    return _in_order(parts)


def _in_order(parts: list[Part]) -> tuple[Part, ...]:
    return tuple(sorted((part for part in parts if len(part.vertices)), key=lambda part: int(part.vertices.min())))


def _on_skin(points: FeaturePoints) -> FeaturePoints:
    return points.subset([name for name in points.names if name not in OWN_PARTS])


def _held_in_mouth(mesh: TriMesh, points: FeaturePoints) -> dict[int, set[str]]:
    """Component -> the parts of the mouth that points say it holds."""
    held: dict[int, set[str]] = {}
    for name, vertices in zip(points.names, points.vertices, strict=True):
        if name in IN_MOUTH:
            held.setdefault(int(mesh.components[vertices[0]]), set()).add(IN_MOUTH[name])
    return held


class _Eye(NamedTuple):
    """The lids of an eye: places (3,) of its middle and (4, 3) of lids and corners in the head's axes, its width."""

    side: str
    middle: FloatArray
    lids: FloatArray
    width: float

    def holds(self, places: FloatArray) -> bool:
        """Whether places (n, 3) lie around the lids, and not in the socket."""
        if np.linalg.norm(places - self.middle, axis=1).max() > EYE_REACH * self.width:
            return False
        if cKDTree(self.lids).query(places)[0].min() > EYE_TOUCH * self.width:
            return False
        upper, lower = self.lids[0], self.lids[1]
        margin = OPENING * (upper[1] - lower[1])
        beyond = (places[:, 1] > upper[1] + margin) | (places[:, 1] < lower[1] - margin)
        behind = places[:, 2] < min(upper[2], lower[2]) - EYE_BEHIND * self.width
        return bool((beyond & behind).mean() <= SOCKET_SHARE)


@dataclass(frozen=True, eq=False)
class _Head:
    """Where a head's eyes, mouth and hair are, in its axes.

    Attributes
    ----------
    unit : distance of the eyes.
    lips, chin, nose : (3,) middle of the lips' inner edges, bottom of the chin, tip of the nose.
    hairs : hair on the face -> (n, 3) places that it grows around.
    skin : the skin's vertices.
    """

    unit: float
    lips: FloatArray
    chin: FloatArray
    nose: FloatArray
    eyes: tuple[_Eye, ...]
    hairs: Mapping[str, FloatArray]
    skin: cKDTree

    @classmethod
    def measured(cls, mesh: TriMesh, points: FeaturePoints, axes: FloatArray, skin: IntArray) -> _Head:
        """Of a head whose points are placed; skin (n,) are its skin's components."""
        places = mesh.vertices @ axes.T
        positions = points.positions(places)
        there = dict(zip(points.names, positions, strict=True))
        where = place_missing(points.names, positions, ("2.1", "2.2", "2.3", "9.3"))
        eyes = []
        for side, names in EYES.items():
            if set(names[:4]) <= there.keys():
                lids = np.stack([there[name] for name in names[:4]])
                width = float(np.linalg.norm(lids[2] - lids[3]))
                eyes.append(_Eye(side, lids[:2].mean(axis=0), lids, width))
        hairs = {kind: [there[name] for name in names if name in there] for kind, names in HAIRS.items()}
        return cls(
            eye_separation(mesh, points),
            0.5 * (where["2.2"] + where["2.3"]),
            where["2.1"],
            where["9.3"],
            tuple(eyes),
            {kind: np.stack(around) for kind, around in hairs.items() if around},
            cKDTree(places[np.isin(mesh.components, skin)]),
        )

    def kind(self, places: FloatArray, low: FloatArray, high: FloatArray, held: set[str]) -> tuple[str, str]:
        """What a component at places (n, 3), in a box from low (3,) to high (3,), is, and how that is known.

        held : parts of the mouth of which points say that it holds them.
        """
        if len(held) == 1:
            return held.copy().pop(), "points lie on it"
        if held:
            return (BOTH if UPPER in held else LOWER), "points lie on it"
        for eye in self.eyes:
            if eye.holds(places):
                return AROUND_EYE, f"along the {eye.side} lids"
        if self._in_mouth(low, high):
            above, below = high[1] - self.lips[1], self.lips[1] - low[1]
            if min(above, below) > SPANS * self.unit:
                return BOTH, SPANNING
            if above - below < -2 * BITE * self.unit:
                if self._is_tongue(places, low, high):
                    return TONGUE, "behind the lips, below their line, from its tip to its root in the middle"
                return LOWER, "behind the lips, mostly below their line"
            return UPPER, "behind the lips, mostly above their line"
        for kind, around in self.hairs.items():
            if self._grows(places, low, high, around):
                return kind, f"on the skin around points {', '.join(HAIRS[kind])}"
        return OTHER, "neither at the eyes, nor in the mouth, nor hair on the face"

    def _in_mouth(self, low: FloatArray, high: FloatArray) -> bool:
        sideways = max(high[0] - self.lips[0], self.lips[0] - low[0]) < MOUTH_WIDTH * self.unit
        height = low[1] > self.chin[1] and high[1] < self.nose[1]
        depth = high[2] < self.lips[2] + BEFORE_LIPS * self.unit and low[2] > self.lips[2] - MOUTH_DEPTH * self.unit
        return bool(sideways and height and depth)

    def _is_tongue(self, places: FloatArray, low: FloatArray, high: FloatArray) -> bool:
        rear = places[places[:, 2] <= 0.5 * (low[2] + high[2])]
        middle = np.abs(rear[:, 0] - 0.5 * (low[0] + high[0])).min() < TONGUE_MIDDLE * 0.5 * (high[0] - low[0])
        return bool(middle and high[2] - low[2] > TONGUE_DEPTH * self.unit)

    def _grows(self, places: FloatArray, low: FloatArray, high: FloatArray, around: FloatArray) -> bool:
        near = np.linalg.norm(around - 0.5 * (low + high), axis=1).min() < HAIR_NEAR * self.unit
        small = (high - low).max() < HAIR_SIZE * self.unit
        return bool(near and small and self._on_skin(places).all())

    def _on_skin(self, places: FloatArray) -> BoolArray:
        close: BoolArray = self.skin.query(places)[0] < HAIR_RISES * self.unit
        return close
