"""Which feature point each marker sits on: read off the marker's name, or proposed by its place."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from ..arrays import FloatArray
from ..errors import RetargetError
from ..mpeg4.fdps import FDPS
from ..rigid import fit_similarity

NEAREST = 0.05
"""A marker may lie this far from the point that is proposed for it, as a share of the assigned markers' extent."""
UNMARKABLE = frozenset(
    [f"2.{k}" for k in range(2, 10)] + ["3.5", "3.6", "6.1", "6.2", "6.3", "6.4", "7.1", "9.8", "9.9", "9.10", "9.11"]
)
"""Points that no marker can sit on: the lips' inner edges, pupils, tongue, spine, teeth."""
LONGEST_NAME = 40
"""Letters in one run of a marker's name; a longer run is no word."""
FEWEST_FITTED = 4
"""Assigned markers that are needed to lay a face over the others."""

_WORDS = {
    spelling: meaning
    for meaning, spellings in {
        "left": "left l lt",
        "right": "right r rt",
        "up": "up upper top above",
        "down": "down dn lo low lower lwr bottom bot below",
        "inner": "in inn inner inside int",
        "outer": "out outer outside ext",
        "middle": "mid middle mdl m c ctr cent center centre",
        "corner": "corner crnr crn end",
        "tip": "tip head",
        "1": "1 01",
        "forehead": "forehead foreh frhd",
        "brow": "brow brows bro eyebrow",
        "glabella": "glabella glab",
        "bridge": "bridge bridg brdg",
        "eye": "eye eyes",
        "lid": "lid eyelid",
        "pupil": "pupil",
        "nose": "nose nos",
        "nostril": "nostril nostrl nstrl",
        "cheek": "cheek chek chk",
        "mouth": "mouth mth",
        "lip": "lip lips",
        "chin": "chin chn",
        "jaw": "jaw",
        "ear": "ear",
    }.items()
    for spelling in spellings.split()
}
"""Spelling -> the word that it stands for."""

_MIDLINE = {
    "forehead": "11.1",
    "forehead middle": "11.1",
    "brow middle": "glabella",
    "glabella": "glabella",
    "nose up": "nose_bridge",
    "nose bridge": "nose_bridge",
    "nose": "9.3",
    "nose tip": "9.3",
    "nose down": "9.15",
    "mouth up": "8.1",
    "mouth up middle": "8.1",
    "lip up": "8.1",
    "lip up middle": "8.1",
    "mouth down": "8.2",
    "mouth down middle": "8.2",
    "lip down": "8.2",
    "lip down middle": "8.2",
    "chin": "2.1",
    "chin middle": "2.1",
}
"""Words of a name without a side -> point."""

_LEFT = {
    "forehead": "11.3",
    "brow": "4.3",
    "brow inner": "4.1",
    "brow middle": "4.3",
    "brow outer": "4.5",
    "eye up": "3.1",
    "lid up": "3.1",
    "eye down": "3.3",
    "lid down": "3.3",
    "eye inner": "3.11",
    "eye outer": "3.7",
    "pupil": "3.5",
    "nose": "9.1",
    "nose tip": "9.1",
    "nostril": "9.1",
    "cheek": "5.1",
    "cheek middle": "5.1",
    "cheek down": "5.1",
    "cheek up": "5.3",
    "mouth": "8.3",
    "mouth corner": "8.3",
    "lip corner": "8.3",
    "mouth up": "8.5",
    "mouth up 1": "8.5",
    "lip up": "8.5",
    "lip up 1": "8.5",
    "mouth down": "8.7",
    "mouth down 1": "8.7",
    "lip down": "8.7",
    "lip down 1": "8.7",
    "chin": "2.11",
    "chin 1": "2.11",
    "jaw": "2.13",
    "ear up": "10.1",
    "ear down": "10.5",
}
"""Words of a name of the subject's left side -> point; the right side's is its partner."""

_FDP_NAME = re.compile(r"(?:(?:fdp|ffp|fp)[\s._-]*(\d{1,2})[._-]|(\d{1,2})\.)(\d{1,2})", re.IGNORECASE)
_RULES = (
    {frozenset(words.split()): point for words, point in _MIDLINE.items()}
    | {frozenset(["left", *words.split()]): point for words, point in _LEFT.items()}
    | {frozenset(["right", *words.split()]): FDPS[point].partner for words, point in _LEFT.items()}
)
"""Words of a name -> point."""


@dataclass(frozen=True)
class MarkerMap:
    """What an artist settled about a set of markers, for all of its takes.

    Attributes
    ----------
    points : marker -> the feature point that it sits on; no point twice.
    rigid : markers that move with the head alone; empty to find them in the take.
    neutral_frames : first and last of the frames, counted from 1, in which the actor's face is neutral.
    gains : FAP -> what its values are multiplied by, where a marker moves less or more than the point that it stands
        for, such as one above the edge of an eyelid.
    """

    points: dict[str, str]
    rigid: tuple[str, ...] = ()
    neutral_frames: tuple[int, int] = (1, 1)
    gains: dict[int, float] = field(default_factory=dict)


@dataclass(frozen=True)
class NamedMarkers:
    """What the names of markers say.

    Attributes
    ----------
    points : marker -> the point that its name means, no point twice.
    unknown : markers whose names mean no point.
    doubtful : point -> the markers, two or more, whose names all mean it; none of them is assigned.
    """

    points: dict[str, str]
    unknown: tuple[str, ...]
    doubtful: dict[str, tuple[str, ...]]


def by_name(markers: Iterable[str], points: Collection[str] = ()) -> NamedMarkers:
    """Feature points of markers, by what the markers are called.

    Recognised are, after a subject's name and a colon is taken off: the names of `points`; MPEG-4 names ("2.1",
    "fdp_2_1", "FDP2.1"); and English words in any order, in capitals or not, run together or not ("Leyebrow_Inside",
    "LBRO", "UpperLip_R", "r_mouth_corner"): a region, the subject's side, and the place within the region. Nothing is
    guessed: any word or number that is not known makes the name unknown.

    Parameters
    ----------
    points : names of a face's points, free ones included, that markers may bear as they are.
    """
    claims: dict[str, list[str]] = {}
    unknown: list[str] = []
    for marker in markers:
        point = _point_of(marker, points)
        if point is None:
            unknown.append(marker)
        else:
            claims.setdefault(point, []).append(marker)
    return NamedMarkers(
        {claimants[0]: point for point, claimants in claims.items() if len(claimants) == 1},
        tuple(unknown),
        {point: tuple(claimants) for point, claimants in claims.items() if len(claimants) > 1},
    )


def by_position(
    markers: Sequence[str],
    marker_positions: FloatArray,
    assigned: Mapping[str, str],
    points: Sequence[str],
    point_positions: FloatArray,
    nearest: float = NEAREST,
) -> dict[str, str]:
    """Points proposed for the markers that have none yet, by where they lie. A help for the artist, who checks it.

    A face's points are laid over the assigned markers by the similarity that fits best. A free marker and a free point
    are proposed to one another where each is the other's nearest and they are close, lips' inner edges and other points
    that no marker can sit on left aside.

    Parameters
    ----------
    markers : (M,) names.
    marker_positions : (M, 3) in the neutral frame.
    assigned : marker -> point, of at least four markers that are not on one line.
    points : (P,) names of the face's points.
    point_positions : (P, 3) on its neutral.
    nearest : how far apart they may be, as a share of the longest side of the box around the assigned markers.

    Returns
    -------
    Marker -> point, of free markers and free points alone.

    Raises
    ------
    RetargetError : if fewer than four assigned markers have points on the face.
    """
    marker_positions, point_positions = np.asarray(marker_positions), np.asarray(point_positions)
    marker_row, point_row = ({name: row for row, name in enumerate(names)} for names in (markers, points))
    pairs = [(marker_row[m], point_row[p]) for m, p in assigned.items() if m in marker_row and p in point_row]
    if len(pairs) < FEWEST_FITTED:
        raise RetargetError(
            f"marker assignment: {len(pairs)} assigned markers have points on the face, "
            f"expected at least {FEWEST_FITTED} to propose others by their places"
        )
    fitted_markers, fitted_points = (list(rows) for rows in zip(*pairs, strict=True))
    onto_markers = fit_similarity(point_positions[fitted_points], marker_positions[fitted_markers])
    limit = nearest * float(np.ptp(marker_positions[fitted_markers], axis=0).max())
    free_markers = [name for name in markers if name not in assigned]
    free_points = [name for name in points if name not in UNMARKABLE.union(assigned.values())]
    if not free_markers or not free_points:
        return {}
    laid = onto_markers.apply(point_positions[[point_row[name] for name in free_points]])
    places = marker_positions[[marker_row[name] for name in free_markers]]
    distances = np.linalg.norm(places[:, None] - laid, axis=2)
    closest_point, closest_marker = distances.argmin(axis=1), distances.argmin(axis=0)
    return {
        name: free_points[point]
        for row, (name, point) in enumerate(zip(free_markers, closest_point, strict=True))
        if closest_marker[point] == row and distances[row, point] <= limit
    }


def _point_of(marker: str, points: Collection[str]) -> str | None:
    name = marker.rpartition(":")[2].strip()
    if name in points:
        return name
    numbered = _FDP_NAME.fullmatch(name)
    if numbered:
        point = f"{int(numbered[1] or numbered[2])}.{int(numbered[3])}"
        return point if point in FDPS else None
    words: list[str] = []
    for chunk in re.findall(r"[a-z]+|\d+", name.lower()):
        spelled = _spelled(chunk)
        if spelled is None:
            return None
        words += spelled
    return _RULES.get(frozenset(words)) if len(set(words)) == len(words) else None


@lru_cache(maxsize=1024)
def _spelled(chunk: str) -> tuple[str, ...] | None:
    """The fewest known words that spell a run of letters or digits; None where none do."""
    if chunk in _WORDS:
        return (_WORDS[chunk],)
    if len(chunk) > LONGEST_NAME:
        return None
    ways = []
    for cut in range(1, len(chunk)):
        rest = _spelled(chunk[cut:]) if chunk[:cut] in _WORDS else None
        if rest is not None:
            ways.append((_WORDS[chunk[:cut]], *rest))
    return min(ways, key=len, default=None)
