"""Tracked markers as motion of feature points on a still head."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import RetargetError
from ..mpeg4.faps import FAPS
from .assignment import MarkerMap
from .head_motion import FEWEST_CHOSEN, HeadMotion, head_motion, rigid_markers
from .take import MarkerTake

ACTING_POINTS = frozenset(point for fap in FAPS if fap.kind == "translation" for point in fap.points)
"""Points that FAPs move: markers on them are no first choice for the motion of the head."""


@dataclass(frozen=True, eq=False)
class PointMotion:
    """What an actor's markers say about feature points, the head's motion taken out.

    Attributes
    ----------
    names : (P,) of the points, in the order of the map.
    neutral : (P, 3) their places on the neutral face, in the take's axes and units.
    displacements : (F, P, 3) from there, as if the head had kept its neutral place; the same axes and units.
    head : the motion that was taken out.
    rigid : the markers that gave it.
    """

    names: tuple[str, ...]
    neutral: FloatArray
    displacements: FloatArray
    head: HeadMotion
    rigid: tuple[str, ...]


def marker_displacements(
    take: MarkerTake, marker_map: MarkerMap, head: str = "kabsch", trim: bool = False
) -> PointMotion:
    """Motion of the feature points that markers sit on, in the neutral head's place.

    Parameters
    ----------
    take : with every mapped marker in every frame, see `marker_gaps.fill_gaps`; rigid markers may have gaps.
    marker_map : markers that are not in it do not count. The neutral is the mean of its neutral frames, brought to the
        head's place in the first of them. Without rigid markers in it, `head_motion.rigid_markers` finds them, among
        those that sit on no point that a FAP moves if there are six, otherwise among all.
    head, trim : how the head's motion is found, see `head_motion.head_motion`.

    Raises
    ------
    RetargetError : if a marker is not in the take or has a gap, if two markers sit on one point, if the take has no
        such neutral frames, or if the head's motion cannot be found.

    References
    ----------
    Kshirsagar et al., section 4.1.
    """
    rows = take.index(marker_map.points)
    _check(take, marker_map, rows)
    first, last = marker_map.neutral_frames
    resting = np.asarray(take.positions[first - 1 : last], np.float64)
    rigid = take.index(marker_map.rigid) if marker_map.rigid else _found_rigid(take, marker_map, resting[0])
    neutral = head_motion(resting[0, rigid], resting[:, rigid], head, trim).removed(resting).mean(axis=0)
    motion = head_motion(neutral[rigid], take.positions[:, rigid], head, trim)
    return PointMotion(
        tuple(marker_map.points.values()),
        neutral[rows],
        motion.removed(take.positions[:, rows]) - neutral[rows],
        motion,
        tuple(take.names[row] for row in rigid),
    )


def _check(take: MarkerTake, marker_map: MarkerMap, rows: IntArray) -> None:
    points = list(marker_map.points.values())
    twice = sorted({point for point in points if points.count(point) > 1})
    if twice:
        raise RetargetError(f"markers: more than one sits on {', '.join(twice)}, expected one marker to a point")
    first, last = marker_map.neutral_frames
    if not 1 <= first <= last <= len(take):
        raise RetargetError(
            f"markers of {take.name!r}: the neutral frames are {first} to {last}, expected frames from 1 to {len(take)}"
        )
    hidden = np.argwhere(~np.isfinite(take.positions[:, rows]).all(axis=2))
    if len(hidden):
        frame, row = hidden[0]
        raise RetargetError(
            f"markers of {take.name!r}: {take.names[rows[row]]!r} is not seen in frame {frame + 1}, "
            "expected a take whose gaps are filled"
        )


def _found_rigid(take: MarkerTake, marker_map: MarkerMap, neutral: FloatArray) -> IntArray:
    still = [row for row, marker in enumerate(take.names) if marker_map.points.get(marker) not in ACTING_POINTS]
    candidates = np.array(still if len(still) >= FEWEST_CHOSEN else range(len(take.names)), np.int64)
    return candidates[rigid_markers(neutral[candidates], take.positions[:, candidates])]
