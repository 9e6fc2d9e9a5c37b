"""The lips' inner edges, where no marker can sit: they follow the markers on the outer edges."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ..arrays import FloatArray
from .motion import PointMotion

OUTER = {
    "2.2": "8.1",
    "2.3": "8.2",
    "2.4": "8.3",
    "2.5": "8.4",
    "2.6": "8.5",
    "2.7": "8.6",
    "2.8": "8.7",
    "2.9": "8.8",
}
"""Inner point of the lips -> the outer point that it follows."""
CHIN = "2.1"
SWING = 0.85
"""How far the middle of the lower lip goes back as the jaw swings open, per way of the chin: the slope in a real take
of jaw motion, correlation 0.997."""
_MEETING = (("2.2", "2.3"), ("2.6", "2.8"), ("2.7", "2.9"))
"""Upper and lower inner points that touch on the neutral face."""


def with_inner_lips(motion: PointMotion, up: FloatArray) -> tuple[PointMotion, dict[str, str]]:
    """Add the inner points of the lips that have no marker.

    Each one moves as its outer point does. Lips that are pressed together would cross so; there upper and lower meet
    halfway. The added points are taken where their outer ones are.

    Parameters
    ----------
    motion : from a neutral face whose lips touch.
    up : (3,) unit vector, the head's.

    Returns
    -------
    The motion with these points behind its own, and inner point -> outer point.
    """
    row = {name: at for at, name in enumerate(motion.names)}
    followed = {inner: outer for inner, outer in OUTER.items() if outer in row and inner not in row}
    rows = [row[outer] for outer in followed.values()]
    added = motion.displacements[:, rows]
    place = {inner: at for at, inner in enumerate(followed)}
    for upper, lower in _MEETING:
        if upper in place and lower in place:
            crossing = np.maximum((added[:, place[lower]] - added[:, place[upper]]) @ up, 0)[:, None]
            added[:, place[upper]] += crossing / 2 * up
            added[:, place[lower]] -= crossing / 2 * up
    full = replace(
        motion,
        names=(*motion.names, *followed),
        neutral=np.concatenate([motion.neutral, motion.neutral[rows]]),
        displacements=np.concatenate([motion.displacements, added], axis=1),
    )
    return full, followed


def without_swing(motion: PointMotion, followed: Mapping[str, str], forward: FloatArray) -> PointMotion:
    """The motion with the jaw's swing backwards taken from the inner lower lip (2.3), if it follows the outer one.

    FAP 14 cannot say that the chin goes back, but FAP 16 can say it of the lip, which would end behind the teeth of a
    face whose chin stays in front.

    Parameters
    ----------
    motion, followed : from `with_inner_lips`.
    forward : (3,) unit vector, the head's.
    """
    if "2.3" not in followed or CHIN not in motion.names:
        return motion
    back = np.minimum(motion.displacements[:, motion.names.index(CHIN)] @ forward, 0)
    displacements = motion.displacements.copy()
    displacements[:, motion.names.index("2.3")] -= SWING * back[:, None] * forward
    return replace(motion, displacements=displacements)
