"""Which features of a head a shape acts on, and which of them another head lacks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.spatial import cKDTree

from ..arrays import FloatArray
from ..mpeg4.head import LEFT
from ..mpeg4.regions import OWN_PARTS, TEETH
from ..parts.kinds import ACROSS, BOTH, LOWER, TONGUE, UPPER, eyeball_name
from ..parts.known_head import know_head
from ..problem import Face

MOSTLY = 0.5
"""Share of a shape's motion, squared and by area, that lies on features from which the shape acts on them."""
SLIGHTLY = 0.01
"""A smaller share does not count."""
TOLD = 0.3
"""A feature is told of if its share is this part of the largest one's."""
AREAS = ("cheek", "forehead", "ear", "neck")
"""Features that a head has with or without points there."""
EYEBALLS = (eyeball_name("left"), eyeball_name("right"))
_IN_MOUTH = {LOWER: "mouth", UPPER: "mouth", BOTH: "mouth", ACROSS: "mouth", TONGUE: "tongue"}
_JAW = ("2.1", "2.10", "2.11", "2.12", "2.13", "2.14")
_FEATURES = {2: "mouth", 5: "cheek", 6: "tongue", 7: "neck", 8: "mouth", 9: "nose", 10: "ear", 11: "forehead"}


def feature_of(name: str) -> str:
    """The feature of a face that an FDP belongs to: mouth, jaw, left eye, left eyeball, right brow, tongue, ..."""
    group = int(name.split(".")[0])
    if name in _JAW:
        return "jaw"
    if name in TEETH:
        return "teeth"
    if name in ("3.5", "3.6"):
        return eyeball_name("left" if name in LEFT else "right")
    if group in (3, 4):
        return f"{'left' if name in LEFT else 'right'} {'eye' if group == 3 else 'brow'}"
    return _FEATURES[group]


class Features:
    """The features of a head, vertex by vertex: eyeballs, the inside of the mouth, elsewhere the nearest point's.

    Parameters
    ----------
    face : its points with MPEG-4 names count.
    """

    def __init__(self, face: Face) -> None:
        head = know_head(face)
        self._names: list[str] = []
        self._label = np.zeros(len(face.mesh.vertices), np.int64)
        self._areas = face.mesh.vertex_areas
        skin = head.points.subset([name for name in head.points.names if name not in OWN_PARTS])
        if len(skin):
            rows = np.array([self._row(feature_of(name)) for name in skin.names])
            self._label = rows[cKDTree(skin.positions(face.mesh.vertices)).query(face.mesh.vertices)[1]]
        has = {feature_of(name) for name in head.points.names}
        parts = [(_IN_MOUTH[part.kind], part.vertices) for part in head.parts if part.kind in _IN_MOUTH]
        parts += [(eyeball_name(side), eye.vertices) for side, eye in head.eyeballs.items() if len(eye.vertices)]
        for feature, vertices in parts:
            self._label[vertices] = self._row(feature)
            has.add(feature)
        self.has = frozenset(has)
        """Features that the head has."""

    def _row(self, feature: str) -> int:
        if feature not in self._names:
            self._names.append(feature)
        return self._names.index(feature)

    def shares(self, displacements: FloatArray) -> dict[str, float]:
        """How much of the motion (V, 3), squared and by area, lies on each feature; the most first.

        Empty where nothing moves.
        """
        energy = np.square(displacements, dtype=np.float64).sum(axis=1) * self._areas
        total = energy.sum()
        if not total > 0 or not self._names:
            return {}
        share = np.bincount(self._label, energy, len(self._names)) / total
        return {self._names[k]: float(share[k]) for k in np.argsort(-share, kind="stable") if share[k] > 0}


def missing(shares: Mapping[str, float], has: frozenset[str]) -> list[str]:
    """The features that a shape acts on mostly and that a head lacks; none where the head has enough of them.

    Eyeballs that it lacks count only for a shape that acts on nothing else: lids go with a gaze on a head without
    eyeballs too. An eyeball that it has is enough: it turns on a head without lids. `AREAS` are on every head: they
    count only for a shape that acts on nothing else.
    """
    slight = {feature: share for feature, share in shares.items() if share >= SLIGHTLY}
    if any(feature in EYEBALLS and feature in has for feature in slight):
        return []
    around = {feature: share for feature, share in slight.items() if feature not in EYEBALLS} or slight
    counted = {feature: share for feature, share in around.items() if feature not in AREAS} or around
    lacking = [feature for feature in counted if feature not in has]
    enough = sum(counted[feature] for feature in lacking) >= MOSTLY * sum(counted.values())
    return lacking if lacking and enough else []


def listed_features(shares: Mapping[str, float], among: Sequence[str]) -> str:
    """Those of some features that a shape acts on the most, for a sentence: 'left eye and mouth'."""
    most = max(shares[feature] for feature in among)
    features = sorted(feature for feature in among if shares[feature] >= TOLD * most)
    return " and ".join(features) if len(features) < 3 else f"{', '.join(features[:-1])} and {features[-1]}"
