"""The head's axes, out of its feature points."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray, cross, unit_vectors
from ..errors import RetargetError
from .fdps import FDPS
from .mean_face import LEAST, MEAN_FACE, place_missing

LEAN = np.radians(1.9)
"""The line from the chin's bottom to the middle of the brows leans backwards by this on an upright head: the mean
of eight heads by different artists, from 0.7 to 3.0 degrees, an ape's and a skull's among them."""


def head_axes(names: Sequence[str], positions: FloatArray) -> FloatArray:
    """Axes of a head in its neutral pose, as MPEG-4 wants them.

    Left comes from the pairs of points, up from the line between chin (2.1) and brows (4.3, 4.4). A turned, moved
    or scaled head gives axes that are turned with it.

    Parameters
    ----------
    names : (P,) FDPs, and other names that do not count.
    positions : (P, 3).

    Returns
    -------
    (3, 3) rows: the subject's left, up, and forward, orthonormal.

    Raises
    ------
    RetargetError : if there is no pair of points, or chin and brows are missing and cannot be placed.
    """
    where = {name: np.asarray(position, np.float64) for name, position in zip(names, positions, strict=True)}
    pairs = [(name, FDPS[name].partner) for name in where if name in LEFT]
    across = [where[left] - where[right] for left, right in pairs if right in where]
    if not across:
        raise RetargetError(
            f"no left and right MPEG-4 points that belong together are among the {len(where)} given, "
            "expected at least one pair such as 8.3 and 8.4"
        )
    left = unit_vectors(np.sum(across, axis=0))
    chin, *brows = place_missing(names, positions, ("2.1", "4.3", "4.4")).values()
    rise = np.mean(brows, axis=0) - chin
    rise = unit_vectors(rise - (rise @ left) * left)
    back_to_front = cross(left, rise)
    up = np.cos(LEAN) * rise + np.sin(LEAN) * back_to_front
    return np.stack([left, up, cross(left, up)])


def gives_axes(names: Sequence[str]) -> bool:
    """Whether points of these names can give `head_axes`: a pair, and chin and brows or enough to place them."""
    there = set(names)
    paired = any(name in LEFT and FDPS[name].partner in there for name in there)
    return paired and (there >= {"2.1", "4.3", "4.4"} or len(there & MEAN_FACE.keys()) >= LEAST)


LEFT = frozenset(
    ("2.4", "2.6", "2.8", "2.11", "2.13", "3.1", "3.3", "3.5", "3.7", "3.9", "3.11", "3.13", "4.1", "4.3", "4.5")
    + ("5.1", "5.3", "6.3", "8.3", "8.5", "8.7", "8.10", "9.1", "9.5", "9.7", "9.13", "10.1", "10.3", "10.5", "10.7")
    + ("10.9", "11.3")
)
"""FDPs of the subject's left half; their partners are the right half's."""
